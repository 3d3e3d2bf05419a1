//! Surfer's decoders: the fields of words that are records.
//!
//! A decoder is made for instructions, and takes a value apart by the masks and slices in a TOML file: that of the
//! page of the `instruction-decoder` that Surfer uses. Ours has one instruction, which every value matches.

use super::{FIRST_LINE, named};
use std::collections::BTreeMap;
use std::fmt::Write;
use tilewright_hdl::ir::{Design, Field, Kind, Names, Record};

/// Surfer's decoders take values of at most that many bits.
const WIDEST: u64 = 64;

/// The decoder of each record that is packed into words, by the name of its type.
pub(super) fn files(design: &Design) -> Vec<(String, String)> {
    let mut records: Vec<(&str, &Record)> = Vec::new();
    for record in design.modules().iter().flat_map(|module| &module.records) {
        if record.width() <= WIDEST && !records.contains(&(record.of, record)) {
            records.push((record.of, record));
        }
    }
    named(records, |_, record| text(record))
}

fn text(record: &Record) -> String {
    let (fields, width) = (&record.fields, record.width());
    let lines = |line: &dyn Fn(&Field) -> String| fields.iter().map(line).collect::<Vec<_>>();
    let parts = lines(&|Field { name, width, kind }| format!("  [\"{name}\", {width}, \"{}\"],\n", part(*kind)));
    let slices =
        lines(&|Field { name, width, .. }| format!("  {{ name = \"{name}\", top = {}, bot = 0 }},\n", width - 1));
    let shown = lines(&|Field { name, .. }| format!("{name} %{name}%"));
    let codes: BTreeMap<&str, Names> =
        fields.iter().filter_map(|field| field.kind.names()).map(|it| (it.of, it)).collect();
    let mut text = format!("{FIRST_LINE}set = \"fields\"\nwidth = {width}\n\n");
    let _ = write!(text, "[formats]\nnames = [\"word\"]\nparts = [\n{}]\n\n", parts.concat());
    let _ = write!(text, "[types]\nnames = [\"record\"]\nrecord = [\n{}]\n\n", slices.concat());
    let _ = write!(text, "[word]\ntype = \"record\"\nrepr = {{ default = \"{}\" }}\n", shown.join(", "));
    let _ = write!(text, "instructions = {{ any = {{ mask = 0, match = 0 }} }}\n\n");
    let names: Vec<String> = codes.keys().map(|of| format!("\"{of}\"")).collect();
    let _ = write!(text, "[mappings]\nnames = [{}]\n", names.join(", "));
    for (of, names) in codes {
        let code = |(code, value)| format!("{value} = \"{code}\"");
        let codes: Vec<String> = names.codes.iter().zip(names.values).map(code).collect();
        let _ = writeln!(text, "{of} = {{ {} }}", codes.join(", "));
    }
    text
}

/// The type of a field: a number, or one of the mappings.
fn part(kind: Kind) -> &'static str {
    match kind {
        Kind::Number => "u64",
        Kind::Signed => "i64",
        Kind::Code(names) => names.of,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{Codes, codes};

    codes! { enum Phase { Idle = 0, Run = 2 } }

    #[test]
    fn a_decoder_has_a_slice_and_a_part_for_each_field() {
        let field = |name: &str, width, kind| Field { name: name.to_owned(), width, kind };
        let fields = vec![
            field("phase", 2, Kind::Code(Phase::NAMES)),
            field("step", 5, Kind::Signed),
            field("at_0_x", 9, Kind::Number),
        ];
        let expected = r#"# Tilewright
set = "fields"
width = 16

[formats]
names = ["word"]
parts = [
  ["phase", 2, "Phase"],
  ["step", 5, "i64"],
  ["at_0_x", 9, "u64"],
]

[types]
names = ["record"]
record = [
  { name = "phase", top = 1, bot = 0 },
  { name = "step", top = 4, bot = 0 },
  { name = "at_0_x", top = 8, bot = 0 },
]

[word]
type = "record"
repr = { default = "phase %phase%, step %step%, at_0_x %at_0_x%" }
instructions = { any = { mask = 0, match = 0 } }

[mappings]
names = ["Phase"]
Phase = { 0 = "Idle", 2 = "Run" }
"#;
        assert_eq!(text(&Record { of: "Part", fields }), expected);
    }
}
