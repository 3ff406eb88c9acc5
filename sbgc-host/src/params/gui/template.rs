//! A board's values in a copy of a file that the GUI saved.

use sbgc_proto::units::FirmwareVersion;

use super::element::{Element, Form, Leaf, Scale};
use super::{GAINS, GuiFile, Number, Reading};
use crate::params::set::Blocks;

/// A file of the GUI with other values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filled {
    /// The file: all bytes but those of the numbers are as they were.
    pub text: String,
    /// Parameters whose values the format cannot express; the template's numbers stay.
    pub unsaid: Vec<String>,
}

impl GuiFile {
    /// Puts the values of a board into `text`, which this file was read from: `profiles` in the order of the file, and
    /// what belongs to no profile. Only numbers of which it is sure or likely what they mean are replaced.
    pub fn fill(
        &self,
        text: &str,
        profiles: &[Blocks],
        shared: &Blocks,
        firmware: FirmwareVersion,
    ) -> Filled {
        let mut filled = Filling { replacements: Vec::new(), unsaid: Vec::new() };
        let none = Blocks::default();
        let gains = self.gains_are_known(firmware);
        filled.fill(&self.board, profiles.first().unwrap_or(&none), shared, gains);
        for (reading, blocks) in self.profiles.iter().zip(profiles) {
            filled.fill(reading, blocks, shared, gains);
        }
        let Filling { mut replacements, mut unsaid } = filled;
        replacements.sort_by_key(|(content, _)| content.start);
        let mut result = String::with_capacity(text.len());
        let mut done = 0;
        for (content, number) in replacements {
            result.push_str(text.get(done..content.start).unwrap_or_default());
            result.push_str(&number);
            done = content.end;
        }
        result.push_str(text.get(done..).unwrap_or_default());
        unsaid.sort();
        unsaid.dedup();
        Filled { text: result, unsaid }
    }
}

struct Filling {
    replacements: Vec<(std::ops::Range<usize>, String)>,
    unsaid: Vec<String>,
}

impl Filling {
    fn fill(&mut self, reading: &Reading, own: &Blocks, shared: &Blocks, gains: bool) {
        for number in &reading.numbers {
            let parameter = &number.parameter;
            let blocks = if parameter.block.is_of_profile() { own } else { shared };
            let raw = blocks.bytes_of(parameter).and_then(|bytes| parameter.raw(bytes));
            let known = raw.filter(|_| gains || !GAINS.contains(&number.element.path));
            match known.map(|raw| (part_of(number, raw), written(number, raw))) {
                // What means the same stays as it is written.
                Some((part, _)) if part == number.raw => {}
                Some((_, Some(text))) => self.replacements.push((number.content.clone(), text)),
                _ => self.unsaid.push(parameter.path.clone()),
            }
            // Bits that no element of the file has.
            let covered = reading
                .numbers
                .iter()
                .filter(|other| other.parameter.path == parameter.path)
                .fold(0, |mask, other| mask | other.mask().0);
            if raw.is_some_and(|raw| raw & !covered & ((1 << (8 * parameter.size)) - 1) != 0) {
                self.unsaid.push(parameter.path.clone());
            }
        }
        self.step_signals(own);
    }

    /// Their settings are a byte of which the file has parts that are not understood.
    fn step_signals(&mut self, own: &Blocks) {
        for parameter in super::super::parameter::parameters_of(super::super::Block::Ext2) {
            if parameter.field.spec == "STEP_SIGNAL_CFG"
                && own.bytes_of(&parameter).is_some_and(|bytes| bytes.iter().any(|byte| *byte != 0))
            {
                self.unsaid.push(parameter.path);
            }
        }
    }
}

/// The part of a parameter that the number of the file is.
fn part_of(number: &Number, raw: i64) -> i64 {
    let (mask, low) = number.mask();
    if number.element.bits.is_some() { (raw & mask) >> low } else { raw }
}

/// The number as the GUI writes it; none if the format cannot express it.
fn written(number: &Number, raw: i64) -> Option<String> {
    let element: &Element = number.element;
    let part = part_of(number, raw);
    match element.form {
        Form::Boolean | Form::Items(Leaf::Boolean, _) => match part {
            0 => Some(String::from("false")),
            1 => Some(String::from("true")),
            _ => None,
        },
        Form::Float | Form::Items(Leaf::Float, _) => {
            let scale = if let Scale::Settled(scale) = element.scale { scale } else { 1.0 };
            // The offset of older firmware is a whole number.
            let scale = if number.parameter.path.starts_with("follow_offset.") { 1.0 } else { scale };
            #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "of 16 bits")]
            let value = (part as f64 * scale) as f32;
            Some(if value.fract() == 0.0 { format!("{value:.1}") } else { format!("{value}") })
        }
        _ => {
            let scale = if let Scale::Settled(scale) = element.scale { scale } else { 1.0 };
            #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "of 32 bits")]
            let value = (part as f64 * scale).round() as i64;
            // Java has no unsigned numbers of 32 bits.
            let value = if value > i64::from(i32::MAX) { value - (1 << 32) } else { value };
            Some(value.to_string())
        }
    }
}
