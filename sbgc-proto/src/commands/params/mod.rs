//! Parameters of the board: four blocks for each of five profiles, and commands that name, reset and store profiles.
//!
//! The parameters of a profile are divided into four blocks of fixed size: [`Params3`], [`ParamsExt`], [`ParamsExt2`]
//! and [`ParamsExt3`]. Each block is requested by profile, and written back as a whole with a separate command.
//! Reserved bytes and unknown values are preserved, so reading, changing and writing a block does not disturb values
//! that newer firmware stores there.
//!
//! Many parameters have no unit: they are slider positions in the vendor's GUI.

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
