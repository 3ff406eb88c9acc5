//! Answers that borrow from their payload.

use std::fmt;
use std::marker::PhantomData;

use bytes::Bytes;
use sbgc_proto::{Message, Request};

use crate::Result;

/// The answer to a request, with the payload that it borrows from.
pub struct Answer<Q> {
    payload: Bytes,
    request: PhantomData<fn() -> Q>,
}

impl<Q: Request> Answer<Q> {
    /// Takes a payload that can be read.
    pub(super) fn new(payload: Bytes) -> Result<Self> {
        <Q::Answer<'_> as Message>::decode(&payload)?;
        Ok(Self { payload, request: PhantomData })
    }

    /// The answer.
    pub fn get<'a>(&'a self) -> Q::Answer<'a>
    where
        Q::Answer<'a>: Default,
    {
        // It was read once, and what it is read from has not changed since.
        let answer = <Q::Answer<'a> as Message>::decode(&self.payload);
        debug_assert!(answer.is_ok(), "what was read once can be read again");
        answer.unwrap_or_default()
    }

    /// The payload.
    pub const fn payload(&self) -> &Bytes {
        &self.payload
    }
}

impl<Q> Clone for Answer<Q> {
    fn clone(&self) -> Self {
        Self { payload: self.payload.clone(), request: PhantomData }
    }
}

impl<Q> fmt::Debug for Answer<Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Answer").field(&self.payload).finish()
    }
}
