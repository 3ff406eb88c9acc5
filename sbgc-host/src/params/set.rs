//! Parameters as they are held: blocks of bytes, values by name, and what differs between two.

use std::collections::BTreeMap;

use sbgc_proto::units::{BoardVersion, FirmwareVersion};

use super::block::{Block, Place, Profile, has};
use super::catalog::Catalog;
use super::parameter::{Parameter, Value, hex, parameters_of};

/// The blocks of a profile, or those that belong to no profile, as they are on the wire.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Blocks(BTreeMap<Block, Vec<u8>>);

impl Blocks {
    /// The payload of a block.
    pub fn get(&self, block: Block) -> Option<&[u8]> {
        self.0.get(&block).map(Vec::as_slice)
    }

    /// Adds a block, or takes the place of what it was.
    pub fn insert(&mut self, block: Block, payload: Vec<u8>) {
        self.0.insert(block, payload);
    }

    /// All of them, the oldest first.
    pub fn iter(&self) -> impl Iterator<Item = (Block, &[u8])> {
        self.0.iter().map(|(block, payload)| (*block, payload.as_slice()))
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The bytes of a parameter; none where its block is missing.
    pub fn bytes_of(&self, parameter: &Parameter) -> Option<&[u8]> {
        parameter.of(self.get(parameter.block)?)
    }

    /// Sets a parameter to the bytes of a value. What the board sets by itself stays as it is, and so does everything
    /// in a block that is missing.
    pub fn set(&mut self, parameter: &Parameter, bytes: &[u8]) {
        if !parameter.is_state()
            && let Some(payload) = self.0.get_mut(&parameter.block)
        {
            parameter.put(payload, bytes);
        }
    }

    /// The values of all parameters of `catalog` whose blocks are here.
    pub fn values(&self, catalog: &Catalog) -> Values {
        let value = |parameter: &Parameter| Some((parameter.clone(), self.bytes_of(parameter)?.to_vec()));
        Values(catalog.iter().filter_map(value).collect())
    }

    /// These blocks with all parameters of `other`; state of the board stays.
    #[must_use]
    pub fn copied_from(&self, other: &Self) -> Self {
        let mut copy = self.clone();
        for (block, payload) in &mut copy.0 {
            let (Some(source), before) = (other.get(*block), payload.clone()) else { continue };
            if source.len() != payload.len() {
                continue;
            }
            payload.copy_from_slice(source);
            for parameter in parameters_of(*block).iter().filter(|parameter| parameter.is_state()) {
                if let Some(bytes) = parameter.of(&before) {
                    parameter.put(payload, bytes);
                }
            }
        }
        copy
    }

    /// Takes those bytes of `raw` that no parameter of `firmware` covers.
    pub(super) fn take_unnamed(&mut self, block: Block, raw: &[u8], firmware: FirmwareVersion) {
        if let Some(payload) = self.0.get_mut(&block)
            && payload.len() == raw.len()
        {
            for at in unnamed(block, payload.len(), firmware) {
                if let (Some(place), Some(byte)) = (payload.get_mut(at), raw.get(at)) {
                    *place = *byte;
                }
            }
        }
    }
}

/// The places in a payload of `length` bytes that no parameter of `firmware` covers.
fn unnamed(block: Block, length: usize, firmware: FirmwareVersion) -> Vec<usize> {
    let mut covered = vec![false; length];
    for parameter in parameters_of(block) {
        if has(firmware, parameter.field.since) || parameter.is_state() {
            for place in covered.iter_mut().skip(parameter.offset).take(parameter.size) {
                *place = true;
            }
        }
    }
    covered.iter().enumerate().filter(|(_, covered)| !**covered).map(|(at, _)| at).collect()
}

/// Values of parameters by name, each as its bytes on the wire.
#[derive(Clone, Debug, Default)]
pub struct Values(Vec<(Parameter, Vec<u8>)>);

impl Values {
    /// All of them in wire order.
    pub fn iter(&self) -> impl Iterator<Item = (&Parameter, &[u8])> {
        self.0.iter().map(|(parameter, bytes)| (parameter, bytes.as_slice()))
    }

    /// The bytes of the parameter with this path.
    pub fn get(&self, path: &str) -> Option<&[u8]> {
        let found = self.0.iter().find(|(parameter, _)| parameter.path == path);
        found.map(|(_, bytes)| bytes.as_slice())
    }

    /// Adds a value, or takes the place of what the parameter had.
    pub fn insert(&mut self, parameter: Parameter, bytes: Vec<u8>) {
        match self.0.iter_mut().find(|(held, _)| held.path == parameter.path) {
            Some(place) => *place = (parameter, bytes),
            None => self.0.push((parameter, bytes)),
        }
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What differs between the parameters that both have. What the board sets by itself does not count.
    pub fn differences(&self, other: &Self, profile: Option<Profile>) -> Vec<Difference> {
        let others: BTreeMap<&str, &[u8]> =
            other.iter().map(|(parameter, bytes)| (parameter.path.as_str(), bytes)).collect();
        self.iter()
            .filter(|(parameter, _)| !parameter.is_state())
            .filter_map(|(parameter, a)| Some((parameter, a, *others.get(parameter.path.as_str())?)))
            .filter(|(_, a, b)| a != b)
            .map(|(parameter, a, b)| Difference {
                profile,
                path: parameter.path.clone(),
                parameter: Some(parameter.clone()),
                a: a.to_vec(),
                b: b.to_vec(),
            })
            .collect()
    }
}

/// A parameter with two values, or bytes of a block that have no name.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The profile; none for what belongs to the board, or where two profiles are compared.
    pub profile: Option<Profile>,
    /// The parameter's path; for bytes without a name that of their block.
    pub path: String,
    /// The parameter; none for bytes without a name.
    pub parameter: Option<Parameter>,
    /// One value.
    pub a: Vec<u8>,
    /// The other.
    pub b: Vec<u8>,
}

impl Difference {
    /// One of the values for programs.
    pub fn value(&self, bytes: &[u8]) -> Value {
        match &self.parameter {
            Some(parameter) => parameter.value(bytes),
            None => Value::Bytes(bytes.to_vec()),
        }
    }

    /// One of the values for people.
    pub fn show(&self, bytes: &[u8]) -> String {
        match &self.parameter {
            Some(parameter) => parameter.show(bytes),
            None => hex(bytes),
        }
    }

    /// The unit of the values, empty when they have none.
    pub fn unit(&self) -> &'static str {
        self.parameter.as_ref().map_or("", Parameter::unit)
    }
}

/// What differs between two payloads of a block, bytes without a name included.
pub(super) fn differences(
    place: Place,
    firmware: FirmwareVersion,
    before: &[u8],
    after: &[u8],
) -> Vec<Difference> {
    let difference = |path: &str, parameter, a: Vec<u8>, b: Vec<u8>| Difference {
        profile: place.profile,
        path: path.to_owned(),
        parameter,
        a,
        b,
    };
    let mut differences: Vec<_> = parameters_of(place.block)
        .into_iter()
        .filter(|parameter| has(firmware, parameter.field.since) && !parameter.is_state())
        .filter_map(|parameter| {
            let (a, b) = (parameter.of(before)?.to_vec(), parameter.of(after)?.to_vec());
            let path = parameter.path.clone();
            (a != b).then(|| difference(&path, Some(parameter), a, b))
        })
        .collect();
    let pick = |payload: &[u8], at: &[usize]| at.iter().filter_map(|at| payload.get(*at).copied()).collect();
    let unnamed: Vec<usize> = unnamed(place.block, before.len(), firmware)
        .into_iter()
        .filter(|at| before.get(*at) != after.get(*at))
        .collect();
    if !unnamed.is_empty() {
        differences.push(difference(place.block.spec(), None, pick(before, &unnamed), pick(after, &unnamed)));
    }
    differences
}

/// The parameters of a board as they were at some time: of some profiles, and what belongs to none.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Version of the board.
    pub board: BoardVersion,
    /// Version of its firmware.
    pub firmware: FirmwareVersion,
    /// What belongs to no profile.
    pub shared: Blocks,
    /// The profiles.
    pub profiles: BTreeMap<Profile, Blocks>,
}
