//! Our dump as Yosys compares one with Verilog.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_hdl::Design;
use tilewright_hdl::ir::ReadUnderWrite;

/// A row whose lanes are variables of their own.
struct Row {
    /// The width and the value of each lane, lane 0 first.
    lanes: Vec<(usize, String)>,
    has_changed: bool,
}

/// The names of reads of which nobody may rely on what they give when their word is written: Yosys gives another one than the simulator.
/// What is made of them is compared.
pub fn unreliable_reads(design: &Design) -> BTreeSet<&str> {
    let memories =
        design.modules().iter().flat_map(|module| module.memories.iter().map(move |memory| (module, memory)));
    memories
        .filter(|(_, memory)| memory.policy == ReadUnderWrite::Any)
        .flat_map(|(module, memory)| memory.reads.iter().filter_map(|read| module.node(read.node).name.as_deref()))
        .collect()
}

/// The dump (VCD) with each row as one vector, lane 0 lowest, which it is as a port in Verilog; without the signals of those names.
pub fn for_yosys(dump: &str, left_out: &BTreeSet<&str>) -> String {
    let (header, changes) = dump.split_once("$enddefinitions $end\n").expect("a dump has a header");
    let (mut text, mut rows, mut plain) = (String::new(), Vec::<Row>::new(), BTreeSet::new());
    // By the id of a lane, the rows that it is in.
    let mut places = BTreeMap::<&str, Vec<(usize, usize)>>::new();
    let mut open: Option<&str> = None;
    for line in header.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let ["$var", kind, width, id, name, ..] = words[..] else {
            (text, open) = (text + line + "\n", None);
            continue;
        };
        let (base, lane) = name.split_once('[').map_or((name, None), |(base, lane)| (base, Some(lane)));
        if left_out.contains(base) {
            continue;
        }
        if lane.is_none() {
            plain.insert(id);
            (text, open) = (text + line + "\n", None);
            continue;
        }
        // The lanes of a row stand one after another.
        if open.replace(base) != Some(base) {
            rows.push(Row { lanes: Vec::new(), has_changed: false });
            text += &format!("$var {kind} WIDTH{0} row:{0} {base} $end\n", rows.len() - 1);
        }
        let (number, width) = (rows.len() - 1, width.parse().expect("a width is a number"));
        places.entry(id).or_default().push((number, rows[number].lanes.len()));
        rows[number].lanes.push((width, "0".repeat(width)));
    }
    for (number, row) in rows.iter().enumerate() {
        let width: usize = row.lanes.iter().map(|(width, _)| width).sum();
        text = text.replacen(&format!("WIDTH{number} "), &format!("{width} "), 1);
    }
    text += "$enddefinitions $end\n";
    for line in changes.lines() {
        if let Some((value, id)) = change(line) {
            for &(row, lane) in places.get(id).into_iter().flatten() {
                let (width, kept) = &mut rows[row].lanes[lane];
                *kept = format!("{value:0>width$}");
                rows[row].has_changed = true;
            }
            if plain.contains(id) {
                text += &format!("{line}\n");
            }
            continue;
        }
        text += &changed(&mut rows);
        text += &format!("{line}\n");
    }
    text + &changed(&mut rows)
}

/// The value and the id of a change.
fn change(line: &str) -> Option<(&str, &str)> {
    match line.as_bytes().first()? {
        b'b' | b's' => line[1..].split_once(' '),
        b'0' | b'1' => Some(line.split_at(1)),
        _ => None,
    }
}

/// The changes of rows since they were last asked for.
fn changed(rows: &mut [Row]) -> String {
    let mut text = String::new();
    for (number, row) in rows.iter_mut().enumerate().filter(|(_, row)| row.has_changed) {
        let lanes: String = row.lanes.iter().rev().map(|(_, value)| value.as_str()).collect();
        text += &format!("b{lanes} row:{number}\n");
        row.has_changed = false;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_vectors_and_names_are_left_out() {
        let dump = "\
$scope module top $end
$var wire 1 ! clk $end
$var wire 2 # words[0] [1:0] $end
$var wire 2 $ words[1] [1:0] $end
$var reg 2 $ last [1:0] $end
$var reg 2 % bank_read [1:0] $end
$scope module u $end
$var wire 1 & words[0] $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
$dumpvars
0!
b0 #
b10 $
b0 %
0&
$end
#5
1!
b1 #
b11 %
";
        let expected = "\
$scope module top $end
$var wire 1 ! clk $end
$var wire 4 row:0 words $end
$var reg 2 $ last [1:0] $end
$scope module u $end
$var wire 1 row:1 words $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
$dumpvars
0!
b10 $
b1000 row:0
b0 row:1
$end
#5
1!
b1001 row:0
";
        assert_eq!(for_yosys(dump, &BTreeSet::from(["bank_read"])), expected);
    }
}
