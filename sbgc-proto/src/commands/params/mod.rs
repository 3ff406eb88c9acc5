//! The parameters of the board: four blocks for each of five profiles, and what stores, resets and names them.
//!
//! A profile's parameters come in four blocks of fixed size: [`Params3`], [`ParamsExt`], [`ParamsExt2`] and
//! [`ParamsExt3`]. Each is asked for by profile and written back as a whole under another command. Bytes that are
//! reserved, and values that are not known here, go back as they came, so that a block that was read, changed and
//! written disturbs nothing that newer firmware keeps there.
//!
//! Many parameters have no unit: they are the positions of sliders in the vendor's program.

mod automation;
mod block3;
mod curves;
mod encoders;
mod ext;
mod ext2;
mod ext3;
mod external;
mod flags;
mod hardware;
mod legacy;
mod menu;
mod orientation;
mod profiles;
mod rc;
#[cfg(test)]
mod tests;

pub use automation::*;
pub use block3::*;
pub use curves::*;
pub use encoders::*;
pub use ext::*;
pub use ext2::*;
pub use ext3::*;
pub use external::*;
pub use flags::*;
pub use hardware::*;
pub use legacy::*;
pub use menu::*;
pub use orientation::*;
pub use profiles::*;
pub use rc::*;
