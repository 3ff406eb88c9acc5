//! Messages of one kind as lines under each other.

use sbgc_proto::reflect::{Leaf, Raw};

use crate::fields;

/// Least width of a column of numbers with digits after the point.
const WIDTH: usize = 8;

/// One field of a message.
pub(crate) struct Cell {
    /// What the field belongs to; empty for one by itself.
    group: String,
    name: String,
    unit: &'static str,
    value: String,
}

impl Cell {
    /// One field.
    pub(crate) fn of_leaf(leaf: &Leaf<'_>) -> Cell {
        let path = leaf.path.to_string();
        let (group, name) = match path.rfind(['.', '[']).and_then(|at| path.split_at_checked(at)) {
            Some((group, name)) => (group.to_owned(), name.trim_start_matches('.').to_owned()),
            None => (String::new(), path),
        };
        let value = match leaf.raw {
            Raw::Number(_) if leaf.label().is_none() => fields::number_text(leaf),
            _ => fields::label_text(leaf).replace(' ', ""),
        };
        let unit = if matches!(leaf.raw, Raw::Number(_)) { leaf.unit() } else { "" };
        Cell { group, name, unit, value }
    }

    /// A time in milliseconds.
    pub(crate) fn time(name: &str, milliseconds: u64) -> Cell {
        Cell { group: String::new(), name: name.to_owned(), unit: "ms", value: milliseconds.to_string() }
    }
}

/// The columns.
pub(crate) struct Table {
    /// Widths of the columns.
    widths: Vec<usize>,
    header: [String; 2],
}

impl Table {
    /// Columns that are wide enough for `cells` and their names.
    pub(crate) fn for_cells(cells: &[Cell]) -> Self {
        let (mut widths, mut titles, mut names) = (Vec::new(), Vec::new(), Vec::new());
        for group in cells.chunk_by(|one, other| !one.group.is_empty() && one.group == other.group) {
            let title = match group {
                [Cell { group, name, unit, .. }, ..] => {
                    let title = if group.is_empty() { name } else { group };
                    if unit.is_empty() { title.clone() } else { format!("{title} ({unit})") }
                }
                [] => String::new(),
            };
            let alone = group.len() == 1;
            let below: Vec<_> = group
                .iter()
                .map(|cell| if cell.group.is_empty() { String::new() } else { cell.name.clone() })
                .collect();
            let mut columns: Vec<_> = group
                .iter()
                .zip(&below)
                .map(|(cell, name)| name.len().max(cell.value.len()).max(if alone { 0 } else { WIDTH }))
                .collect();
            let width = columns.iter().sum::<usize>() + GAP.len() * (columns.len().saturating_sub(1));
            if let Some(first) = columns.first_mut() {
                *first += title.len().saturating_sub(width);
            }
            let width = width.max(title.len());
            titles.push(format!("{title:^width$}"));
            names.extend(below.iter().zip(&columns).map(|(name, &width)| format!("{name:>width$}")));
            widths.extend(columns);
        }
        let header = [titles, names].map(|parts| parts.join(GAP).trim_end().to_owned());
        Table { widths, header }
    }

    /// What the columns are, in two lines.
    pub(crate) fn header(&self) -> &[String; 2] {
        &self.header
    }

    /// One line.
    pub(crate) fn row(&self, cells: &[Cell]) -> String {
        let padded: Vec<_> =
            self.widths.iter().zip(cells).map(|(&width, cell)| format!("{:>width$}", cell.value)).collect();
        padded.join(GAP)
    }
}

/// Between two columns.
const GAP: &str = "  ";

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(group: &str, name: &str, unit: &'static str, value: &str) -> Cell {
        Cell { group: group.into(), name: name.into(), unit, value: value.into() }
    }

    #[test]
    fn values_stand_under_their_names() {
        let cells = [
            cell("", "timestamp_ms", "ms", "12"),
            cell("angles", "roll", "deg", "0.00"),
            cell("angles", "pitch", "deg", "-19.23"),
            cell("", "flags", "", "3(A|B)"),
        ];
        let table = Table::for_cells(&cells);
        assert_eq!(
            table.header(),
            &["timestamp_ms (ms)     angles (deg)     flags", "                       roll     pitch"]
        );
        assert_eq!(table.row(&cells), "               12      0.00    -19.23  3(A|B)");
    }
}
