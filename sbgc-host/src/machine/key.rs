//! What will answer a request.
//!
//! The protocol has no sequence numbers. What tells one answer from another is its command id and, for some, a few
//! bytes in it that repeat what was asked for: the confirmed command, the profile, the address.

use sbgc_proto::CommandId;

/// The highest profile number that means just that profile.
const LAST_PROFILE: u8 = 4;

/// What the answer to a request looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Id of the answer.
    id: u8,
    /// Where in the answer the repeated bytes stand.
    at: usize,
    /// The repeated bytes.
    echo: [u8; 4],
    /// How many of them count.
    length: usize,
}

impl Key {
    /// Any answer with this id.
    pub const fn any(id: u8) -> Self {
        Self { id, at: 0, echo: [0; 4], length: 0 }
    }

    /// The confirmation of a command.
    pub const fn confirmation(command: u8) -> Self {
        Self { id: CommandId::CONFIRM.raw(), at: 0, echo: [command, 0, 0, 0], length: 1 }
    }

    /// The answer with id `answer` to a request.
    pub fn of_request(command: u8, payload: &[u8], answer: u8) -> Self {
        if answer == CommandId::CONFIRM.raw() {
            return Self::confirmation(command);
        }
        let any = Self::any(answer);
        match CommandId::from_raw(command) {
            CommandId::ReadParams
            | CommandId::ReadParams3
            | CommandId::ReadParamsExt
            | CommandId::ReadParamsExt2
            | CommandId::ReadParamsExt3 => match payload.first() {
                // Any other number means the current profile, and the answer says which that is.
                Some(&profile) if profile <= LAST_PROFILE => {
                    Self { echo: [profile, 0, 0, 0], length: 1, ..any }
                }
                _ => any,
            },
            CommandId::EepromRead => match payload.first_chunk::<4>() {
                Some(&address) => Self { echo: address, length: 4, ..any },
                None => any,
            },
            // The page, which stands at the same place in both.
            CommandId::ReadFile => match *payload {
                [_, _, low, high, ..] => Self { at: 2, echo: [low, high, 0, 0], length: 2, ..any },
                _ => any,
            },
            _ => any,
        }
    }

    /// Whether a frame is the answer.
    ///
    /// One that ends before the repeated bytes is taken for it: boards report some errors that way.
    pub fn matches(&self, id: u8, payload: &[u8]) -> bool {
        let there = payload.get(self.at..self.at.saturating_add(self.length));
        id == self.id && there.is_none_or(|there| Some(there) == self.echo())
    }

    /// Whether one frame could answer both.
    pub fn overlaps(&self, other: &Self) -> bool {
        let apart = self.at == other.at && self.length == other.length && self.echo != other.echo;
        self.id == other.id && !apart
    }

    fn echo(&self) -> Option<&[u8]> {
        self.echo.get(..self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn confirmations_are_told_apart_by_what_they_confirm() {
        let key = Key::of_request(77, &[], 67);
        assert!(key.matches(67, &[77]) && key.matches(67, &[77, 1, 2]));
        assert!(!key.matches(67, &[109, 0]) && !key.matches(77, &[77]));
        assert!(!key.overlaps(&Key::confirmation(109)));
        assert!(key.overlaps(&Key::confirmation(77)));
    }

    #[test]
    fn profiles_are_told_apart_except_the_current_one() {
        let second = Key::of_request(21, &[1], 21);
        assert!(second.matches(21, &[1, 9, 9]) && !second.matches(21, &[0, 9, 9]));
        for current in [5, 254, 255] {
            let key = Key::of_request(21, &[current], 21);
            assert!(key.matches(21, &[3, 9]) && key.overlaps(&second));
        }
        assert!(!second.overlaps(&Key::of_request(21, &[2], 21)));
    }

    #[test]
    fn addresses_and_pages_are_told_apart() {
        let eeprom = Key::of_request(48, &[64, 1, 0, 0, 64, 0], 48);
        assert!(eeprom.matches(48, &[64, 1, 0, 0, 5, 5]) && !eeprom.matches(48, &[128, 1, 0, 0, 5, 5]));
        let mut request = [0; 20];
        request[2] = 3;
        let file = Key::of_request(53, &request, 53);
        assert!(file.matches(53, &[0, 1, 3, 0, 7]) && !file.matches(53, &[0, 1, 4, 0, 7]));
        assert!(file.matches(53, &[2]), "the short form that reports an error");
    }

    #[test]
    fn others_need_the_id_only() {
        let key = Key::of_request(68, &[], 23);
        assert!(key.matches(23, &[1, 2, 3]) && key.matches(23, &[]) && !key.matches(68, &[]));
    }
}
