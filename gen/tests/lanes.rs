//! Modules with lanes: their text, about which no linter complains, and its behaviour.
//!
//! `UPDATE_GOLDEN=1 cargo test -p tilewright-gen` rewrites the files.

mod awkward;
#[path = "../../hdl/tests/shapes/build.rs"]
mod build;
mod evaluate;
#[path = "../../hdl/tests/shapes/machines.rs"]
mod machines;
mod modules;

use crate::golden::compare::compare;
use tilewright_gen::{VerilogFile, testbench, tools, verilog};
use tilewright_hdl::Design;
use tilewright_hdl::ir::{Module, Shape};

fn print(modules: Vec<Module>) -> Vec<VerilogFile> {
    verilog(&Design::new(modules).unwrap_or_else(|problems| panic!("{problems}")))
}

/// The module and those in it print as the golden files, free of complaints.
fn golden(modules: Vec<Module>) {
    let files = print(modules.clone());
    assert_eq!(files, print(modules.clone()), "the same design prints differently");
    files.iter().for_each(compare);
    tools::lint(&files).unwrap();
    behaves(modules);
}

/// In Icarus, the text behaves as the module does, on random inputs.
fn behaves(modules: Vec<Module>) {
    let recording = evaluate::recording(&modules, 60);
    let design = Design::new(modules).unwrap_or_else(|problems| panic!("{problems}"));
    let _ = tools::replay_in_icarus(&verilog(&design), &testbench(&design, &recording)).unwrap();
}

/// The text of the last module, free of complaints.
fn clean(modules: Vec<Module>) -> String {
    let mut files = print(modules.clone());
    tools::lint(&files).unwrap();
    behaves(modules);
    files.pop().expect("there is a module").text
}

#[test]
fn a_row_of_registers_with_gates() {
    golden(vec![modules::counters()]);
}

#[test]
fn a_grid() {
    golden(vec![machines::systolic(4)]);
}

#[test]
fn a_tree_in_a_row() {
    golden(vec![modules::tree()]);
}

#[test]
fn lanes_that_signals_say() {
    golden(vec![modules::picks()]);
}

#[test]
fn memories_of_lanes() {
    golden(vec![modules::memories()]);
}

#[test]
fn ports_with_lanes() {
    golden(modules::packed_ports());
}

#[test]
fn arrays_that_feed_each_other() {
    golden(modules::arrays());
}

#[test]
fn groups_that_read_each_other() {
    golden(vec![modules::rings()]);
}

#[test]
fn constants_of_a_grid() {
    golden(vec![modules::constants()]);
}

/// A comparison that no linter sees through in one lane may be constant in another.
#[test]
fn comparisons_with_constants_of_the_lanes() {
    let text = clean(vec![awkward::comparisons()]);
    assert!(text.contains("$signed({2'd0, x[i * 2 +: 2]}) >= $signed("), "{text}");
}

/// Constants are known through all lanes taken from other lanes; otherwise a linter finds a constant comparison.
#[test]
fn comparisons_with_constants_of_other_lanes() {
    clean(vec![awkward::passed_constants()]);
}

#[test]
fn a_comparison_with_a_lane_that_is_a_constant() {
    let text = clean(vec![awkward::constant_in_a_lane()]);
    assert!(text.contains("assign less = 1'b0;"), "{text}");
}

/// The input of a chain is in a scope of another shape, from which no parameter of the lanes is found.
#[test]
fn constants_in_what_enters_lanes() {
    clean(vec![awkward::entered_constants()]);
}

/// Lanes that are never written, enabled or chosen have a driver all the same, as every linter requires.
#[test]
fn constants_of_the_lanes_that_decide() {
    clean(vec![awkward::decided()]);
}

#[test]
fn constants_that_are_combined() {
    let text = clean(vec![awkward::greatest_of_constants()]);
    // 5, 5 and 3 in two bits, less 0, 2 and 2.
    for part in ["assign greatest = 2'd3;", "assign least = 2'd1;"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn constants_that_choices_pass_on() {
    clean(vec![awkward::least_of_some_constants()]);
}

/// Where a read beyond the depth is gated, each lane gates its own, so it has a memory of its own.
#[test]
fn memories_that_share_an_address() {
    for (depth, memory) in [(8, "reg [23:0] words [0:7];"), (5, "reg [3:0] words [0:4];")] {
        let text = clean(vec![awkward::masked_reads(Shape::Grid(2, 3), depth)]);
        assert!(text.contains(memory), "{text}");
    }
}

#[test]
fn memories_that_are_read_together_or_in_some_lanes() {
    let text = clean(vec![awkward::read_together()]);
    assert!(text.contains("if (on) words_read0 <= words[at];"), "{text}");
    assert!(text.contains("if (words_read_enable[i]) words_read1[i * 4 +: 4] <= words[at][i * 4 +: 4];"), "{text}");
}

/// Verilator 5.006 does not take a loop over 4096 lanes. Yosys has no room for so many, so no linter reads them.
#[test]
fn so_many_memories_that_share_an_address_that_a_loop_is_in_another() {
    let text = &print(vec![awkward::masked_reads(Shape::Grid(64, 64), 8)])[0].text;
    assert!(text.contains("for (i = 0; i < 64; i = i + 1) begin : words_lane"), "{text}");
    assert!(text.contains("for (j = 0; j < 64; j = j + 1) begin : words_part"), "{text}");
    behaves(vec![awkward::masked_reads(Shape::Grid(40, 26), 8)]);
}

/// A depth that needs a guard, and one that does not.
#[test]
fn data_that_is_read_before_its_memory() {
    for depth in [8, 5] {
        let text = clean(vec![awkward::read_ahead(depth)]);
        assert!(text.contains("_ahead[i].data = data;"), "{text}");
    }
}

#[test]
fn a_net_that_is_itself_in_other_lanes() {
    clean(vec![awkward::passed_on()]);
}

#[test]
fn shifts_by_constants_of_the_lanes() {
    tools::lint(&print(vec![awkward::shifted_out()])).unwrap();
}

#[test]
fn bits_of_lanes() {
    clean(vec![awkward::bits_of_lanes()]);
}

#[test]
fn more_lanes_than_a_vector_or_an_array_holds() {
    // 8 bits do not reach the last of 300 lanes.
    for (lanes, bits, last) in [(1700, 12, 10), (300, 12, 8), (300, 8, 8)] {
        let text = clean(vec![awkward::far_pick(lanes, bits)]);
        assert!(text.contains(&format!("begin : picked_by_bit{last}")), "{text}");
    }
}

/// A LUT and a multiplexer of two LUTs select a bit of three lanes; a multiplier and a shifter would be 847 LUTs.
#[test]
fn a_pick_is_a_multiplexer() {
    let files = print(vec![awkward::pick_of_three()]);
    if let Some(cells) = tools::cells(&files, tools::Target::Ecp5).unwrap() {
        assert_eq!(cells.keys().filter(|cell| cell.starts_with("MULT")).count(), 0, "{cells:?}");
        assert!(cells["LUT4"] <= 3 * 40, "{cells:?}");
    }
}

#[test]
fn processors_and_their_trees() {
    let text = clean(vec![machines::processors(8)]);
    assert!(text.contains("reg words [0:207];") || text.contains("reg [63:0] words [0:207];"), "{text}");
    assert_eq!(text.matches("case (operation)").count(), 1, "a named choice is written once: {text}");
    let lines = print(vec![machines::processors(128)])[0].text.lines().count();
    assert!(lines < 500, "{lines} lines");
}

#[test]
fn a_systolic_array_is_as_long_however_large() {
    let lines = [2, 8, 64].map(|side| print(vec![machines::systolic(side)])[0].text.lines().count());
    assert_eq!(lines, [lines[0]; 3]);
    assert!(lines[2] < 70, "{lines:?}");
}

/// Verilator inlines a module, and confuses a loop in it with one of the same label around it.
#[test]
fn loops_within_loops_have_labels_of_their_own() {
    let text = clean(awkward::nested());
    for label in ["u_cell_3", "total_linked_row", "total_tree_4"] {
        assert!(text.contains(&format!("begin : {label}")), "{text}");
    }
}

/// Yosys must know the width of a `case` before it has made the lanes after this one.
#[test]
fn choices_by_other_lanes() {
    clean(vec![awkward::chosen_by_another()]);
}

/// Linters compute some lanes, and complain if that makes a comparison constant.
#[test]
fn ends_of_the_range_in_some_lanes() {
    clean(vec![awkward::ends_in_some_lanes()]);
}

/// A value that leads back to its own list is known to be constant, too.
#[test]
fn constants_behind_a_list_of_what_it_is_made_of() {
    clean(vec![awkward::listed_of_each_other()]);
    let text = clean(vec![awkward::shifted_by_an_entry()]);
    assert!(text.contains("assign shifted = y;"), "{text}");
}

/// Icarus takes two blocks for one where one reads a net by two names, and the other reads it and one more net.
#[test]
fn a_net_at_two_ports() {
    let text = clean(awkward::fed_twice());
    assert!(text.contains(".p        ({x}),") && text.contains(".q        (x),"), "{text}");
}
