//! Answers that borrow from their payload.

use std::fmt;

use bytes::Bytes;
use sbgc_proto::Request;

use crate::Result;

/// The answer to a request, with the payload that it borrows from.
#[derive(Clone)]
pub struct Answer<Q> {
    payload: Bytes,
    request: Q,
}

impl<Q: Request> Answer<Q> {
    /// Takes a payload that can be decoded as the answer to `request`.
    pub(super) fn new(request: Q, payload: Bytes) -> Result<Self> {
        request.decode_answer(&payload)?;
        Ok(Self { payload, request })
    }

    /// The answer.
    pub fn get<'a>(&'a self) -> Q::Answer<'a>
    where
        Q::Answer<'a>: Default,
    {
        // It was decoded once, and what it is decoded from has not changed since.
        let answer = self.request.decode_answer(&self.payload);
        debug_assert!(answer.is_ok(), "what was decoded once can be decoded again");
        answer.unwrap_or_default()
    }

    /// The payload.
    pub const fn payload(&self) -> &Bytes {
        &self.payload
    }
}

impl<Q> fmt::Debug for Answer<Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Answer").field(&self.payload).finish()
    }
}
