//! Bytes that the board keeps for the programs that use it.

use sbgc_proto::commands::{ExternalData, ReadExternalData, WriteExternalData};

use crate::{Error, Gimbal, Result};

impl Gimbal {
    /// Reads the user's data.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn user_data(&self) -> Result<[u8; 128]> {
        Ok(self.request(&ReadExternalData {}).await?.data.0)
    }

    /// Stores the user's data and reads it back.
    ///
    /// # Errors
    /// If the board refuses it, does not answer, or has other bytes afterwards.
    pub async fn set_user_data(&self, data: [u8; 128]) -> Result<()> {
        self.confirm(&WriteExternalData(ExternalData { data: data.into() })).await?;
        let there = self.user_data().await?;
        match there.iter().zip(&data).position(|(one, other)| one != other) {
            None => Ok(()),
            Some(at) => {
                Err(Error::NotVerified { what: "user data", at: u32::try_from(at).unwrap_or_default() })
            }
        }
    }
}
