//! The parameters of the board: four blocks for each of five profiles, and what stores, resets and names them.
//!
//! A profile's parameters come in four blocks of fixed size: [`Params3`], [`ParamsExt`], [`ParamsExt2`] and
//! [`ParamsExt3`]. Each is asked for by profile and written back as a whole under another command. Bytes that are
//! reserved, and values that are not known here, go back as they came, so that a block that was read, changed and
//! written disturbs nothing that newer firmware keeps there.
//!
//! Many parameters have no unit: they are the positions of sliders in the vendor's program.

mod automation;
mod encoders;
mod external_devices;
mod flags;
mod hardware;
mod menu;
mod orientation;
mod params3;
mod params_ext;
mod params_ext2;
mod params_ext3;
mod params_legacy;
mod profiles;
mod rc;
#[cfg(test)]
mod tests;

pub use automation::*;
pub use encoders::*;
pub use external_devices::*;
pub use flags::*;
pub use hardware::*;
pub use menu::*;
pub use orientation::*;
pub use params_ext::*;
pub use params_ext2::*;
pub use params_ext3::*;
pub use params_legacy::*;
pub use params3::*;
pub use profiles::*;
pub use rc::*;
