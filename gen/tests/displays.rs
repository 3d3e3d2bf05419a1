//! Displays and enabled parts in the printed text, free of complaints.

use crate::blocks::{Pair, Small};
use tilewright_gen::{tools, verilog};
use tilewright_hdl::*;

codes! { enum Way { Left, Right } }

/// The text of all modules, free of complaints.
fn clean(name: &'static str, build: fn(Module, Pair) -> Signal) -> String {
    let files = verilog(&elaborate(&Small { name, build }).unwrap_or_else(|problems| panic!("{problems}")));
    let texts: String = files.iter().map(|file| file.text.as_str()).collect();
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{texts}"));
    texts
}

#[track_caller]
fn has(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "{part}\n{text}"));
}

#[test]
fn a_display_prints_its_values() {
    let text = clean("shows", |m, i| {
        def!(way = m.reg(one_of::<Way>()).reset(Way::Left));
        way.when(i.a.bit(0), Way::Right);
        def!(seen = m.past(i.b) + 1);
        m.display(i.a.ne(0), "100% of {} at {:x}, {:b}: {}", &[i.a.signed(), i.a + i.b, i.b, *way]);
        m.display(seen.eq(1), "again, {}", &[seen]);
        m.display(i.b.unpack(row(8)), "lane {}", &[constants(bits(3).of(row(8)), |lane| lane)]);
        i.a
    });
    has(
        &text,
        &[
            "    always @(posedge clk) begin\n        if (!rst && (a != 8'd0)) begin",
            "$display(\"100%% of %0d at %0h, %0b: %0s\", $signed(a), {a + b}, b, \
             (way == 1'b0) ? {8'd0, \"Left\"} : (way == 1'b1) ? \"Right\" : {32'd0, \"?\"});",
            "$display(\"again, %0d\", seen);",
        ],
    );
    let (before, _) = text.split_once("$display").unwrap();
    assert!(before.rsplit_once("`ifndef SYNTHESIS").unwrap().1.contains("`else"), "{text}");
}

#[test]
fn an_instance_in_an_enabled_part_has_an_input_for_the_enable() {
    let text = clean("pauses", |m, i| {
        let late = Small { name: "late_one", build: |m, x| m.pipe("late", x.a) };
        let cell = m.enabled(i.a.bit(0), || {
            let words = m.memory("words", 256, 8, ReadUnderWrite::Old).fill(0);
            words.write(i.a.bit(1), i.a, i.b);
            let word = words.read(i.b);
            m.instance("u_cell", &late, Pair { a: word, b: i.b }).y
        });
        cell ^ m.instance("u_plain", &late, Pair { a: i.a, b: i.b }).y
    });
    has(
        &text,
        &[
            "input  wire       clk_en, // All on this clock keeps its state where this is low; a reset does not wait.",
            "if (clk_en) late <= a;",
            ".clk_en (a[0]),",
            "if (a[0]) words_read <= words[b];",
            "if (a[0] & a[1]) words[a] <= b;",
        ],
    );
}
