//! What carries parameters: the blocks that a board reads and writes as a whole, and the five profiles.

use std::fmt;
use std::ops::RangeInclusive;

use sbgc_proto::commands::{
    AdjVarsCfg, Params3, ParamsExt, ParamsExt2, ParamsExt3, ProfileId, ProfileNames, WriteAdjVarsCfg,
    WriteParams3, WriteParamsExt, WriteParamsExt2, WriteParamsExt3, WriteProfileNames,
};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, Message};

/// A message that carries parameters, read and written as a whole.
///
/// Four of them exist once for each profile, the others once for the board. Newer blocks come later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Block {
    /// `CMD_READ_PARAMS_3`: motors, remote control, follow mode, sensors, battery.
    Params3,
    /// `CMD_READ_PARAMS_EXT`: filters, encoders, magnetometer.
    Ext,
    /// `CMD_READ_PARAMS_EXT2`: MavLink, limits, automated motion, signals.
    Ext2,
    /// `CMD_READ_PARAMS_EXT3`: external IMU and newer settings.
    Ext3,
    /// `CMD_READ_PROFILE_NAMES`: the names of all profiles.
    ProfileNames,
    /// `CMD_READ_ADJ_VARS_CFG`: which signals run actions and change variables.
    AdjustableConfig,
}

/// What differs between the messages.
struct Facts {
    read: CommandId,
    write: CommandId,
    spec: &'static str,
    since: Option<FirmwareVersion>,
    form: &'static str,
    size: RangeInclusive<usize>,
}

const fn facts<R: Message, W: Message>() -> Facts {
    Facts { read: R::ID, write: W::ID, spec: R::SPEC, since: R::SINCE, form: R::FORM, size: R::SIZE }
}

impl Block {
    /// The blocks of a profile.
    pub const OF_PROFILE: [Block; 4] = [Block::Params3, Block::Ext, Block::Ext2, Block::Ext3];
    /// The blocks that belong to no profile.
    pub const OF_BOARD: [Block; 2] = [Block::ProfileNames, Block::AdjustableConfig];

    const fn facts(self) -> Facts {
        match self {
            Block::Params3 => facts::<Params3, WriteParams3>(),
            Block::Ext => facts::<ParamsExt, WriteParamsExt>(),
            Block::Ext2 => facts::<ParamsExt2, WriteParamsExt2>(),
            Block::Ext3 => facts::<ParamsExt3, WriteParamsExt3>(),
            Block::ProfileNames => facts::<ProfileNames, WriteProfileNames>(),
            Block::AdjustableConfig => facts::<AdjVarsCfg, WriteAdjVarsCfg>(),
        }
    }

    /// The command that reads it.
    pub const fn read_id(self) -> CommandId {
        self.facts().read
    }

    /// The command that writes it.
    pub const fn write_id(self) -> CommandId {
        self.facts().write
    }

    /// The specification's name of the command that reads it.
    pub const fn spec(self) -> &'static str {
        self.facts().spec
    }

    /// The block with this name in the specification.
    pub fn by_spec(spec: &str) -> Option<Self> {
        Self::OF_PROFILE.into_iter().chain(Self::OF_BOARD).find(|block| block.spec() == spec)
    }

    /// The name of its form.
    pub(super) const fn form(self) -> &'static str {
        self.facts().form
    }

    /// Bytes of its payload.
    pub const fn size(self) -> usize {
        *self.facts().size.end()
    }

    /// Whether each profile has one.
    pub const fn is_of_profile(self) -> bool {
        !matches!(self, Block::ProfileNames | Block::AdjustableConfig)
    }

    /// Whether this firmware has it.
    pub fn is_in(self, firmware: FirmwareVersion) -> bool {
        has(firmware, self.facts().since)
    }
}

/// The specification's name of the command that reads it.
impl fmt::Display for Block {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.spec())
    }
}

/// Whether `firmware` has what began with the version `since`, `None` where that is unknown.
pub(super) fn has(firmware: FirmwareVersion, since: Option<FirmwareVersion>) -> bool {
    since.is_none_or(|since| firmware >= since)
}

/// One of the five profiles.
///
/// ```
/// use sbgc_host::params::Profile;
///
/// let profile = Profile::from_number(2).ok_or("profiles count from 1 to 5")?;
/// assert_eq!((profile.number(), profile.to_string()), (2, "profile 2".into()));
/// assert_eq!(Profile::from_number(6), None);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Profile(u8);

impl Profile {
    /// How many profiles a board has.
    pub const COUNT: u8 = 5;

    /// The profile that users call by this number, 1 to 5.
    pub const fn from_number(number: u8) -> Option<Self> {
        if number >= 1 && number <= Self::COUNT { Some(Self(number - 1)) } else { None }
    }

    /// The profile with this number on the wire, 0 to 4.
    pub const fn from_id(id: ProfileId) -> Option<Self> {
        match id.raw().checked_add(1) {
            Some(number) => Self::from_number(number),
            None => None,
        }
    }

    /// The number by which users call it, 1 to 5.
    pub const fn number(self) -> u8 {
        self.0 + 1
    }

    /// The number on the wire.
    pub const fn id(self) -> ProfileId {
        ProfileId::from_raw(self.0)
    }

    /// All profiles in their order.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT).map(Self)
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "profile {}", self.number())
    }
}

/// A block of the board: of one profile, or of none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The profile; none for what belongs to the board.
    pub profile: Option<Profile>,
    /// The block.
    pub block: Block,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.profile {
            Some(profile) => write!(f, "{} of {profile}", self.block),
            None => write!(f, "{}", self.block),
        }
    }
}
