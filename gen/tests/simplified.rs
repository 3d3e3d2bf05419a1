//! What the printer makes of operators whose result is known or is one of their operands.

use crate::blocks::{One, Pair, Small};
use tilewright_gen::verilog;
use tilewright_hdl::*;

type Build = fn(Module, Pair) -> Signal;

/// The expression that is assigned to the output `y`.
fn printed(build: Build) -> String {
    let design = elaborate(&Small { name: "simplified", build }).unwrap_or_else(|problems| panic!("{problems}"));
    let text = verilog(&design).pop().expect("there is a module").text;
    let (_, rest) = text.split_once("assign y = ").unwrap_or_else(|| panic!("{text}"));
    rest.split_once(';').expect("the assignment ends").0.to_string()
}

fn check(cases: &[(Build, &str)]) {
    let wrong: Vec<String> = cases
        .iter()
        .enumerate()
        .map(|(case, (build, expected))| (case, expected, printed(*build)))
        .filter(|(_, expected, printed)| printed != *expected)
        .map(|(case, expected, printed)| format!("case {case}: `{printed}` in place of `{expected}`"))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn wire(m: Module, name: &str, value: Signal) -> Signal {
    let wire = m.wire(name, 8);
    wire.drive(value);
    *wire
}

#[test]
fn a_wire_gives_its_name_to_what_drives_it() {
    check(&[(
        |m, i| {
            let sum = i.a + i.b;
            wire(m, "total", sum) - (sum ^ i.b)
        },
        "total - (total ^ b)",
    )]);
}

#[test]
fn a_neutral_operand_disappears_and_a_dominant_one_is_the_result() {
    check(&[
        (|_, i| i.a + 0, "a"),
        (|_, i| lit(8, 0) + i.a, "a"),
        (|_, i| i.a - 0, "a"),
        (|_, i| lit(8, 0) - i.a, "8'd0 - a"),
        (|_, i| i.a | 0, "a"),
        (|_, i| lit(8, 0) | i.a, "a"),
        (|_, i| i.a ^ 0, "a"),
        (|_, i| lit(8, 0) ^ i.a, "a"),
        (|_, i| i.a & lit(8, 0), "8'd0"),
        (|_, i| lit(8, 0) & i.a, "8'd0"),
        (|_, i| i.a & 255, "a"),
        (|_, i| lit(8, 255) & i.a, "a"),
        (|_, i| i.a | 255, "8'd255"),
        (|_, i| lit(8, 255) | i.a, "8'd255"),
        (|_, i| i.a ^ 255, "a ^ 8'hff"),
        (|_, i| i.a & 254, "a & 8'hfe"),
        (|_, i| i.a.times(lit(8, 0)), "16'd0"),
        (|_, i| lit(4, 0).times(i.a), "12'd0"),
        (|_, i| i.a.signed().times(lit(8, 0).signed()).bits(), "16'd0"),
        (|_, i| i.a.times(lit(8, 1)), "{8'd0, a} * 16'd1"),
        (|m, i| i.a + wire(m, "nothing", lit(8, 0)), "a"),
    ]);
}

#[test]
fn a_value_with_itself_or_its_inverse() {
    check(&[
        (|_, i| i.a ^ i.a, "8'd0"),
        (|_, i| i.a - i.a, "8'd0"),
        (|_, i| i.a & i.a, "a"),
        (|_, i| i.a | i.a, "a"),
        (|_, i| i.a + i.a, "a + a"),
        (|_, i| i.a & !i.a, "8'd0"),
        (|_, i| !i.a | i.a, "8'd255"),
        (|_, i| i.a ^ !i.a, "8'd255"),
        (|_, i| i.a & !i.b, "a & ~b"),
        (|_, i| !(!i.a), "a"),
        (|_, i| !i.a, "~a"),
        (|_, i| i.a.eq(i.a), "1'b1"),
        (|_, i| i.a.ge(i.a), "1'b1"),
        (|_, i| i.a.le(i.a), "1'b1"),
        (|_, i| i.a.ne(i.a), "1'b0"),
        (|_, i| i.a.lt(i.a), "1'b0"),
        (|_, i| i.a.gt(i.a), "1'b0"),
    ]);
}

#[test]
fn an_inverted_comparison_is_the_opposite_one() {
    check(&[
        (|_, i| !i.a.eq(i.b), "a != b"),
        (|_, i| !i.a.ne(i.b), "a == b"),
        (|_, i| !i.a.lt(i.b), "a >= b"),
        (|_, i| !i.a.ge(i.b), "a < b"),
        (|_, i| !i.a.gt(i.b), "a <= b"),
        (|_, i| !i.a.le(i.b), "a > b"),
        (|_, i| !i.a.signed().lt(i.b.signed()), "$signed(a) >= $signed(b)"),
        (|_, i| i.a.bit(0).eq(1), "a[0]"),
        (|_, i| i.a.bit(0).ne(0), "a[0]"),
        (|_, i| i.a.bit(0).eq(0), "!a[0]"),
        (|_, i| i.a.bit(0).ne(1), "!a[0]"),
        (|_, i| lit(1, 0).eq(i.a.bit(0)), "!a[0]"),
        (|_, i| i.a.eq(1), "a == 8'd1"),
        (|_, i| i.a.bit(0).any_one(), "a[0]"),
        (|_, i| i.a.all_ones(), "&a"),
        (|_, i| (!i.a).any_one(), "|(~a)"),
    ]);
}

#[test]
fn a_comparison_with_the_end_of_the_range_is_known() {
    check(&[
        (|_, i| i.a.lt(0), "1'b0"),
        (|_, i| lit(8, 255).lt(i.a), "1'b0"),
        (|_, i| i.a.gt(255), "1'b0"),
        (|_, i| lit(8, 0).gt(i.a), "1'b0"),
        (|_, i| i.a.le(255), "1'b1"),
        (|_, i| lit(8, 0).le(i.a), "1'b1"),
        (|_, i| i.a.ge(0), "1'b1"),
        (|_, i| lit(8, 255).ge(i.a), "1'b1"),
        (|_, i| i.a.lt(255), "a < 8'd255"),
        (|_, i| i.a.gt(0), "a > 8'd0"),
        (|_, i| lit(8, 0).lt(i.a), "8'd0 < a"),
        (|_, i| lit(8, 255).gt(i.a), "8'd255 > a"),
        (|_, i| i.a.le(0), "a <= 8'd0"),
        (|_, i| i.a.ge(255), "a >= 8'd255"),
        (|_, i| i.a.signed().lt(-128), "1'b0"),
        (|_, i| i.a.signed().gt(127), "1'b0"),
        (|_, i| i.a.signed().le(127), "1'b1"),
        (|_, i| i.a.signed().ge(-128), "1'b1"),
        (|_, i| i.a.signed().eq(-3), "$signed(a) == -8'sd3"),
        (|_, i| i.a.signed().bits().lt(lit(8, 253).signed().bits()), "a < 8'd253"),
        (|_, i| i.a.signed().ge(0), "$signed(a) >= 8'sd0"),
    ]);
}

/// Beyond the last word is zero.
#[test]
fn a_comparison_with_a_word_that_is_none_is_known() {
    fn word(m: Module, i: Pair, address: u64) -> Signal {
        let words = m.memory("words", 5, 8, ReadUnderWrite::Old);
        words.write(lit(1, 1), i.a.trunc(3), i.b);
        words.read_async(lit(3, address))
    }
    check(&[(|m, i| word(m, i, 5).gt(i.a), "1'b0"), (|m, i| word(m, i, 4).gt(i.a), "words_word > a")]);
}

#[test]
fn constants_are_computed() {
    check(&[
        (|_, _| lit(8, 200) + lit(8, 100), "8'd44"),
        (|_, _| lit(8, 3) - lit(8, 5), "8'd254"),
        (|_, _| lit(8, 200).times(lit(8, 100)), "16'd20000"),
        (|_, _| lit(8, 255).signed().times(lit(8, 2).signed()).bits(), "16'd65534"),
        (|_, _| lit(8, 12) & lit(8, 10), "8'd8"),
        (|_, _| lit(8, 12) | lit(8, 10), "8'd14"),
        (|_, _| lit(8, 12) ^ lit(8, 10), "8'd6"),
        (|_, _| !lit(8, 12), "8'd243"),
        (|_, _| lit(8, 255).all_ones(), "1'b1"),
        (|_, _| lit(8, 254).all_ones(), "1'b0"),
        (|_, _| lit(8, 0).any_one(), "1'b0"),
        (|_, _| lit(8, 8).any_one(), "1'b1"),
        (|_, _| lit(8, 7).parity(), "1'b1"),
        (|_, _| lit(8, 3).parity(), "1'b0"),
        (|_, _| lit(8, 200).lt(lit(8, 100)), "1'b0"),
        (|_, _| lit(8, 200).signed().lt(lit(8, 100).signed()), "1'b1"),
        (|_, _| lit(8, 100).signed().lt(lit(8, 200).signed()), "1'b0"),
        (|_, _| lit(8, 7).le(lit(8, 7)), "1'b1"),
        (|_, _| lit(8, 7).gt(lit(8, 6)), "1'b1"),
        (|_, _| lit(8, 6).ge(lit(8, 7)), "1'b0"),
        (|_, _| lit(8, 7).ne(lit(8, 6)), "1'b1"),
        (|_, _| lit(64, u64::MAX).zext(100) + lit(100, 1), "100'h0000000010000000000000000"),
        (|_, _| cat![lit(64, 1), lit(64, 0)] - lit(128, 1), "128'h0000000000000000ffffffffffffffff"),
        // Wider ones are left to the tools.
        (|_, _| lit(4, 9).zext(129) + lit(129, 1), "129'd9 + 129'd1"),
        (|_, _| lit(4, 9).zext(129) - lit(129, 1), "129'd9 - 129'd1"),
        (|_, _| lit(65, 3).times(lit(64, 5)), "129'd3 * 129'd5"),
        (|_, _| lit(4, 9).zext(8), "8'd9"),
        (|_, _| lit(4, 9).sext(8), "8'd249"),
        (|_, _| lit(2, 2).repeat(4), "8'd170"),
        (|_, _| cat![lit(4, 5), lit(4, 6)], "8'd86"),
        (|_, _| lit(8, 0x5a).slice(2..6), "4'd6"),
    ]);
}

#[test]
fn a_choice_that_is_known_is_made() {
    check(&[
        (|_, i| mux(lit(1, 1), i.a, i.b), "a"),
        (|_, i| mux(lit(1, 0), i.a, i.b), "b"),
        (|_, i| mux(i.b.bit(0), i.a, i.a), "a"),
        (|_, i| mux(i.b.bit(0), lit(1, 1), lit(1, 0)), "b[0]"),
        (|_, i| mux(i.b.bit(0), lit(1, 0), lit(1, 1)), "!b[0]"),
        (|_, i| mux(i.b.bit(0), lit(8, 1), lit(8, 0)), "b[0] ? 8'd1 : 8'd0"),
        (|_, i| select([(lit(1, 0), i.b), (i.b.bit(0), i.a)], lit(8, 3)), "b[0] ? a : 8'd3"),
        (|_, i| select([(i.b.bit(0), i.a), (lit(1, 1), i.b), (i.a.bit(0), lit(8, 9))], lit(8, 3)), "b[0] ? a : b"),
        (|_, i| select([(i.b.bit(0), i.a), (i.b.bit(1), i.b), (i.b.bit(2), i.b)], i.b), "b[0] ? a : b"),
        (|_, i| select([(i.b.bit(0), i.a), (i.b.bit(1), i.a)], i.a), "a"),
        (|_, i| case(lit(2, 1), [(0, i.a), (1, i.b)], lit(8, 3)), "b"),
        (|_, i| case(lit(2, 2), [(0, i.a), (1, i.b)], lit(8, 3)), "8'd3"),
        (|_, i| case(i.b.slice(0..2), [(0, i.a), (1, i.a)], i.a), "a"),
    ]);
}

#[test]
fn a_part_is_taken_of_what_has_it() {
    check(&[
        (|_, i| i.a.slice(0..8), "a"),
        (|_, i| i.a.slice(2..7).slice(1..3), "a[4:3]"),
        (|_, i| i.a.zext(12).slice(2..8), "a[7:2]"),
        (|_, i| i.a.zext(12).slice(8..11), "3'd0"),
        (|_, i| i.a.zext(12).slice(7..9), "{1'd0, a[7]}"),
        (|_, i| i.a.sext(12).slice(0..8), "a"),
        (|_, i| i.a.sext(12).slice(8..10), "a_extended[9:8]"),
        (|_, i| cat![i.a, i.b].slice(8..16), "a"),
        (|_, i| cat![i.a, i.b].slice(0..8), "b"),
        (|_, i| cat![i.a, i.b].slice(9..12), "a[3:1]"),
        (|_, i| cat![i.a, i.b].slice(4..12), "{a[3:0], b[7:4]}"),
        (|_, i| cat![i.a, i.b.bit(0), i.b].slice(4..12), "{a[2:0], b[0], b[7:4]}"),
        (|_, i| i.a.zext(10).zext(12), "{4'd0, a}"),
        (|_, i| cat![i.b.bit(0), i.a].zext(12), "{3'd0, b[0], a}"),
        (|_, i| cat![i.a, cat![i.b, i.a.zext(9)]], "{a, b, 1'd0, a}"),
        (|_, i| (i.a.zext(12) << 2).slice(1..12), "{2'd0, a, 1'b0}"),
        (|_, i| concat(&[i.a]), "a"),
        (|_, i| i.a.repeat(1), "a"),
        (|_, i| i.a.repeat(2), "{2{a}}"),
        (|_, i| i.a.zext(8), "a"),
        (|_, i| i.a.lt(i.b).sext(8), "{8{a < b}}"),
        (|_, i| i.a.slice(2..7).sext(8), "{{3{a[6]}}, a[6:2]}"),
        (|_, i| (i.a + i.b).slice(2..7).sext(8), "{{3{a_plus_b[6]}}, a_plus_b[6:2]}"),
        (|_, i| (i.a + 200).slice(2..7), "a_plus_200[6:2]"),
        (|_, i| (i.a.signed() + 100).bits().slice(2..7), "a_plus_100[6:2]"),
        // A negative number is no part of a name.
        (|_, i| (i.a.signed() + -56).bits().slice(2..7), "y_sum[6:2]"),
        (|_, i| i.a.zext(12).slice(2..8).sext(9), "{{3{a[7]}}, a[7:2]}"),
        (|_, i| cat![i.a, i.b].slice(4..8).sext(9), "{{5{b[7]}}, b[7:4]}"),
    ]);
}

#[test]
fn a_shift_by_a_constant_is_a_part() {
    check(&[
        (|_, i| i.a << 0, "a"),
        (|_, i| i.a << 3, "{a[4:0], 3'd0}"),
        (|_, i| i.a >> 3, "{3'd0, a[7:3]}"),
        (|_, i| (i.a.signed() >> 3).bits(), "{{3{a[7]}}, a[7:3]}"),
        (|_, i| i.a << lit(8, 3), "{a[4:0], 3'd0}"),
        (|_, i| i.a >> lit(8, 3), "{3'd0, a[7:3]}"),
        (|_, i| (i.a.signed() >> lit(8, 3)).bits(), "{{3{a[7]}}, a[7:3]}"),
        (|_, i| i.a << lit(8, 0), "a"),
        (|_, i| i.a << lit(8, 8), "8'd0"),
        (|_, i| i.a >> lit(8, 9), "8'd0"),
        (|_, i| (i.a.signed() >> lit(8, 8)).bits(), "{8{a[7]}}"),
        (|_, i| (i.a.bit(5).signed() >> lit(8, 1)).bits(), "a[5]"),
        (|_, i| (i.a.bit(5).zext(8).signed() >> lit(8, 1)).bits(), "8'd0"),
        (|_, i| i.a.bit(5).zext(8) >> lit(8, 1), "8'd0"),
        (|_, i| i.a >> cat![lit(8, 1), lit(64, 0)], "8'd0"),
        (|_, _| lit(8, 0x95) << lit(8, 3), "8'd168"),
        (|_, _| lit(8, 0x95) >> lit(8, 3), "8'd18"),
        (|_, _| (lit(8, 0x95).signed() >> lit(8, 3)).bits(), "8'd242"),
        (|_, _| (lit(8, 0x95).signed() >> lit(8, 8)).bits(), "8'd255"),
        (|_, _| lit(8, 0x95) >> lit(8, 8), "8'd0"),
        (|_, i| lit(8, 0) << i.a, "8'd0"),
        (|_, i| lit(8, 1) << i.a, "8'd1 << a"),
    ]);
}

/// Some tools accept no more than 32 bits of an amount: bits 16 and up make it too large.
#[test]
fn an_amount_of_many_bits_is_cut() {
    check(&[
        (|_, i| i.a << cat![i.b, i.b], "a << {b, b}"),
        (|_, i| i.a << cat![i.b, i.a, i.b], "(|b) ? 8'd0 : (a << {a, b})"),
        (|_, i| i.a >> cat![i.b.bit(0), i.a, i.b], "b[0] ? 8'd0 : (a >> {a, b})"),
    ]);
}

/// A value computed from lanes of an array of three cells.
fn of_lanes(m: Module, i: Pair, take: fn(One, Pair) -> Signal) -> Signal {
    let cell = Small { name: "cell_", build: |_, i| i.a + i.b };
    let mut taken = None;
    let _ = m.array("u_cell", 3, &cell, |row| {
        taken = Some(take(row, i));
        Pair { a: i.a, b: i.b }
    });
    taken.expect("the array is described once")
}

#[test]
fn a_lane_of_what_is_not_an_output_is_the_value_that_was_given() {
    check(&[
        (|m, i| of_lanes(m, i, |_, i| i.b.of(3).lane(2)), "b"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).lane(1)), "b"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).previous(7).lane(0)), "8'd7"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).previous(7).lane(2)), "b"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).following(7).lane(0)), "b"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).following(7).lane(2)), "8'd7"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.b, i.a, i.a]).shifted(2, 7).lane(2)), "b"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.b, i.a, i.a]).shifted(3, 7).lane(2)), "8'd7"),
        (|m, i| of_lanes(m, i, |_, i| i.b.of(3).shifted(0, 7).lane(0)), "b"),
        (|m, i| of_lanes(m, i, |_, i| i.b.of(3).previous(7).lane(0)), "8'd7"),
        (|m, i| of_lanes(m, i, |_, i| i.b.of(3).previous(7).lane(1)), "b"),
        (|m, i| of_lanes(m, i, |row, _| row.y.lane(1)), "u_cell[1].lane_y"),
        (|m, i| of_lanes(m, i, |row, i| row.y.previous(i.b).lane(0)), "b"),
        (|m, i| of_lanes(m, i, |row, i| row.y.previous(i.b).lane(1)), "u_cell[0].lane_y"),
        (|m, i| of_lanes(m, i, |_, i| stack([i.a, i.b, i.a]).sum()), "a + b + a"),
        (|m, i| of_lanes(m, i, |_, i| i.a.of(3).sum()), "a + a + a"),
        (|m, i| of_lanes(m, i, |_, i| i.a.of(3).and_all()), "a"),
    ]);
}

#[test]
fn a_read_within_the_depth_has_no_multiplexer() {
    block! {
        /// A memory of 400 words, read at the edge and at once.
        struct Reads { in_bounds: bool }
        in ReadsIn { at: below(400) }
        out ReadsOut { late: bits(8), now: bits(8), named: bits(8) }
    }
    impl Reads {
        fn build(&self, m: Module, i: ReadsIn) -> ReadsOut {
            def!(words = m.memory(400, 8, ReadUnderWrite::Any).fill(1));
            let words = if self.in_bounds { words.in_bounds() } else { words };
            let late = words.read(i.at);
            def!(named = words.read(i.at));
            ReadsOut { late, now: words.read_async(i.at), named }
        }
    }
    let text = |in_bounds| verilog(&elaborate(&Reads { in_bounds }).unwrap())[0].text.clone();
    let (open, stated) = (text(false), text(true));
    assert!(open.contains("words_read0 = words_read0_inside ? words_read0_word : 8'd0;"), "{open}");
    assert!(open.contains("assign now = (at < 9'd400) ? words[at] : 8'd0;"), "{open}");
    assert!(stated.contains("words_read0 <= words[at];") && stated.contains("assign now = words[at];"), "{stated}");
    // An output of the name of a read is declared once.
    assert!(open.contains("    assign named = named_inside ? named_word : 8'd0;"), "{open}");
    assert!(stated.contains("named <= words[at];") && !stated.contains("    reg [7:0] named;"), "{stated}");
    let circuit = stated.split("`ifdef").next().unwrap();
    assert!(!circuit.contains("400;") && !circuit.contains('?'), "{stated}");
}
