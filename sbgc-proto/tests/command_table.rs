//! Keeps the table of all commands in the documentation as the declarations are.

use std::fmt::Write as _;

use sbgc_proto::{CommandId, Direction, IncomingCommand, MessageInfo, OutgoingCommand};

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/commands/table.md");

fn forms(all: &[MessageInfo], id: CommandId) -> String {
    let forms: Vec<String> = all
        .iter()
        .filter(|info| info.id == id)
        .map(|info| {
            let (least, most) = (info.size.start(), info.size.end());
            let size = if least == most { least.to_string() } else { format!("{least} to {most}") };
            format!("[`{0}`](crate::commands::{0}): {size}", info.type_name)
        })
        .collect();
    forms.join("<br>")
}

fn table() -> String {
    let mut table = String::from(
        "# All commands\n\nWith the bytes of each payload. What the protocol's documents only name keeps its payload raw.\n\n\
         | id | spec | outgoing | incoming |\n| --- | --- | --- | --- |\n",
    );
    for raw in 1..=u8::MAX {
        let id = CommandId::from_raw(raw);
        let Some(outgoing) = id.spec_name(Direction::Outgoing) else { continue };
        let incoming = id.spec_name(Direction::Incoming).unwrap_or(outgoing);
        let names = if outgoing == incoming {
            format!("`{outgoing}`")
        } else {
            format!("`{outgoing}`, `{incoming}`")
        };
        let (out, inc) = (forms(OutgoingCommand::ALL, id), forms(IncomingCommand::ALL, id));
        writeln!(table, "| {raw} | {names} | {out} | {inc} |").expect("a string takes everything");
    }
    table
}

/// With `UPDATE_TABLE=1` the table is written anew.
#[test]
fn the_table_in_the_documentation_is_up_to_date() {
    let table = table();
    if std::env::var_os("UPDATE_TABLE").is_some() {
        std::fs::write(TABLE, &table).expect("the table can be written");
    }
    let found = std::fs::read_to_string(TABLE).unwrap_or_default();
    assert!(found == table, "{TABLE} is not as the declarations are; run this test with UPDATE_TABLE=1");
}

#[test]
fn every_id_has_a_type() {
    let named = |raw: &u8| CommandId::from_raw(*raw).spec_name(Direction::Outgoing).is_some();
    let typed = |raw: &u8| {
        let has = |all: &[MessageInfo]| all.iter().any(|info| info.id.raw() == *raw);
        has(OutgoingCommand::ALL) || has(IncomingCommand::ALL)
    };
    let missing: Vec<u8> = (1..=u8::MAX).filter(|raw| named(raw) && !typed(raw)).collect();
    assert!(missing.is_empty(), "ids without a type: {missing:?}");
}

#[test]
fn summaries_are_plain_sentences() {
    for info in OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL) {
        assert!(!info.summary.contains(['[', ']']), "{}", info.summary);
        assert!(info.summary.ends_with('.'), "{}", info.summary);
    }
}
