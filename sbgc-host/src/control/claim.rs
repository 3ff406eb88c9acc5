//! Who owns the motion of a gimbal: one session or one calibration at a time on a connection.

use std::sync::atomic::Ordering;

use crate::{Error, Gimbal, Result};

/// The right to move the gimbal, until it is dropped.
#[derive(Debug)]
pub(crate) struct Claim(Gimbal);

impl Claim {
    /// Takes the right.
    ///
    /// # Errors
    /// If somebody else has it.
    pub(crate) fn take(gimbal: &Gimbal) -> Result<Self> {
        if gimbal.link().motion_owned.swap(true, Ordering::AcqRel) {
            return Err(Error::ControlInUse);
        }
        Ok(Self(gimbal.clone()))
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        self.0.link().motion_owned.store(false, Ordering::Release);
    }
}
