//! Parameters of a board by name: reading, comparing, writing by plan, profiles, files.
//!
//! - `block`: what carries parameters, and the five profiles.
//! - `parameter`, `quantity`: one parameter, its values as text, numbers and bytes, and their units.
//! - `catalog`: all parameters of a firmware by name.
//! - `set`, `plan`: what a board holds, what differs, and what is going to be written.
//! - `file`: parameters as a TOML document; `gui`: files of the vendor's GUI.
//! - `board`: doing it with a [`Gimbal`](crate::Gimbal); `adjustable`: variables that change while it works.
//!
//! What a parameter is called, its unit, range and names come from [`sbgc_proto::reflect`]; nothing of it is repeated
//! here.
//!
//! ```
//! use sbgc_host::params::{Parameters, Profile};
//! use sbgc_host::{Gimbal, Options, sim};
//!
//! # #[tokio::main(flavor = "current_thread", start_paused = true)]
//! # async fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let gimbal = Gimbal::spawn(sim::in_process(sim::Config::default()), Options::default());
//! let parameters = Parameters::new(gimbal.clone(), gimbal.handshake().await?);
//! let profile = parameters.active().await?;
//!
//! let before = parameters.read(profile).await?;
//! let catalog = parameters.catalog();
//! let memory = catalog.one("rc_memory.pitch")?;
//! let mut after = before.clone();
//! after.set(memory, &memory.parse("-30 deg")?);
//!
//! let mut plan = parameters.plan();
//! plan.change(Some(profile), &before, &after);
//! for change in plan.differences() {
//!     println!("{}: {} -> {}", change.path, change.show(&change.a), change.show(&change.b));
//! }
//! parameters.write(&plan, |_| {}).await?;
//! # assert_eq!(parameters.read(profile).await?, after);
//! # Ok(())
//! # }
//! ```

mod adjustable;
mod block;
mod board;
mod catalog;
mod error;
mod file;
mod gui;
mod parameter;
mod plan;
mod quantity;
mod set;

pub use adjustable::{Setting, Variable, VariableCommand, VariableError, variables_called};
pub use block::{Block, Place, Profile};
pub use board::{Parameters, activation, profile_set, use_defaults};
pub use catalog::{Catalog, NameError, nearest};
pub use error::{ParamsError, Result};
pub use file::{Applied, FileError, FileProblem, ParameterFile};
pub use gui::{Filled, GuiError, GuiFile, GuiProblem, Include};
pub use parameter::{Parameter, Value, ValueError};
pub use plan::{Plan, PlannedBlock, PlannedCommand};
pub use quantity::UnitError;
pub use set::{Blocks, Difference, Snapshot, Values};
