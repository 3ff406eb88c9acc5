//! Offsets of fields, for their documentation.
//!
//! How long a field's type is, a macro cannot see. So the offsets stand in a file that the tests of the crate make of
//! its declarations, and that they compare with them.

use std::collections::HashMap;
use std::sync::OnceLock;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::attributes::capitals;
use crate::structure::Structure;

/// The file, in the folder of the crate.
const FILE: &str = "src/commands/offsets.txt";

/// The offset of a field that stands at a fixed one.
pub(crate) fn offset(structure: &Ident, field: &Ident) -> Option<u16> {
    static TABLE: OnceLock<HashMap<(String, String), u16>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        let folder = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
        let text = std::fs::read_to_string(std::path::Path::new(&folder).join(FILE)).unwrap_or_default();
        text.lines().flat_map(read_line).collect()
    });
    table.get(&(structure.to_string(), field.to_string())).copied()
}

/// `Structure field=offset field=offset`.
fn read_line(line: &str) -> Vec<((String, String), u16)> {
    let (structure, fields) = line.split_once(' ').unwrap_or_default();
    let read = |entry: &str| {
        let (field, offset) = entry.split_once('=')?;
        Some(((structure.to_owned(), field.to_owned()), offset.parse().ok()?))
    };
    fields.split(' ').filter_map(read).collect()
}

/// The test that the file has the offsets of this declaration.
pub(crate) fn test(structure: &Structure) -> Option<TokenStream> {
    if structure.transparent {
        return None;
    }
    let name = structure.name.to_string();
    let ty = &structure.name;
    let test = format_ident!("offsets_of_{}", capitals(&name).to_lowercase());
    Some(quote! {
        #[cfg(test)]
        #[test]
        fn #test() {
            crate::offsets::check(#name, <#ty as crate::wire::Layout>::SLOTS);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_the_fields_of_a_structure() {
        let entry = |field: &str, offset| ((String::from("Name"), field.to_owned()), offset);
        assert_eq!(read_line("Name first=0 second=12"), [entry("first", 0), entry("second", 12)]);
        assert_eq!(read_line("Name first=x"), []);
        assert_eq!(read_line(""), []);
    }
}
