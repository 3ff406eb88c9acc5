//! Where the fields of a declared struct stand, for checks when compiling.

/// Position of a field within its struct.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// The field's name in the code.
    pub(crate) name: &'static str,
    /// Offset of its first byte, or of its count byte; `None` where earlier fields vary in length.
    pub(crate) at: Option<usize>,
    /// Number of bytes, of one element in lists; `None` where that varies.
    pub(crate) size: Option<usize>,
    /// Whether it begins with its own count byte.
    pub(crate) counted: bool,
    /// Fields of the elements of a list.
    pub(crate) elements: Option<&'static [Slot]>,
}

impl Slot {
    /// The field called `name`. For constants: one that is not among `slots` does not compile.
    #[expect(clippy::panic, reason = "it ends the compilation, not a program")]
    pub(crate) const fn find(mut slots: &'static [Slot], name: &str) -> Slot {
        while let Some((slot, rest)) = slots.split_first() {
            if crate::text::equal(slot.name, name) {
                return *slot;
            }
            slots = rest;
        }
        panic!("there is no field of this name")
    }

    /// Its offset. For constants: one that varies does not compile.
    #[expect(clippy::panic, reason = "it ends the compilation, not a program")]
    pub(crate) const fn offset(self) -> u8 {
        match self.at {
            Some(at) if at < 256 => {
                #[expect(clippy::cast_possible_truncation, reason = "checked before")]
                let at = at as u8;
                at
            }
            _ => panic!("the field has no fixed place"),
        }
    }

    /// Its number of bytes, 255 for one that reaches to the end of the payload.
    pub(crate) const fn width(self) -> u8 {
        match self.size {
            Some(size) if size < 255 => {
                #[expect(clippy::cast_possible_truncation, reason = "checked before")]
                let size = size as u8;
                size
            }
            _ => u8::MAX,
        }
    }
}

/// `Some(value)` where the two ends are the same.
pub(crate) const fn fixed(minimum: usize, maximum: usize) -> Option<usize> {
    if minimum == maximum { Some(minimum) } else { None }
}
