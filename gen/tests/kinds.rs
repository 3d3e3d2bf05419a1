//! Designs of every kind pass every linter: several clocks, loaded memories, gathers, hostile names, dead values.

use crate::blocks::{LineBuffer, One, Pair, Small};
use tilewright_gen::tools::Target;
use tilewright_gen::{VerilogFile, tools, verilog};
use tilewright_hdl::*;

fn print(name: &'static str, build: fn(Module, Pair) -> Signal) -> Vec<VerilogFile> {
    verilog(&elaborate(&Small { name, build }).unwrap_or_else(|problems| panic!("{problems}")))
}

/// The text of the top module, free of complaints.
fn clean(name: &'static str, build: fn(Module, Pair) -> Signal) -> String {
    let files = print(name, build);
    tools::lint(&files).unwrap();
    files.into_iter().rfind(|file| file.name.ends_with(".v")).expect("there is a top module").text
}

const SLOW: Clock = Clock::new("slow", Period::ns(14));

#[test]
fn a_memory_between_two_clocks() {
    let text = clean("two_clocks", |m, i| {
        let memory = m.memory("words", 256, 8, ReadUnderWrite::Any);
        let write = m.reg("write", 1).reset(0);
        write.next(!write);
        memory.write(write, i.a, i.b);
        let address = m.on(SLOW).reg("address", 8).reset(0);
        address.next(address + 1);
        memory.on(SLOW).read(address)
    });
    assert!(text.contains("always @(posedge slow_clk) begin\n        words_read <= words[address];"), "{text}");
}

#[test]
fn a_memory_written_by_two_clocks() {
    clean("two_writers", |m, i| {
        let memory = m.memory("words", 200, 8, ReadUnderWrite::Old).true_dual_port();
        memory.write(i.a.bit(0), i.a, i.b);
        let address = m.on(SLOW).reg("address", 8).reset(0);
        address.next(address + 1);
        memory.on(SLOW).write(lit(1, 1), address, address);
        memory.read(i.b)
    });
}

#[test]
fn a_table_too_long_for_the_text() {
    let build = |m: Module, i: Pair| {
        let table = m.memory("squares", 2000, 8, ReadUnderWrite::Old);
        let table = table.words((0..1500).map(|at| (at * at) & 0xff));
        table.read(cat![i.a.trunc(3), i.b]) ^ table.read(i.a.zext(11))
    };
    let text = clean("loaded", build);
    assert!(text.contains("$readmemh(\"loaded.squares.hex\", squares);"), "{text}");
    let files = print("loaded", build);
    let data = files.iter().find(|file| file.name == "loaded.squares.hex").expect("the data are a file");
    assert_eq!(data.text.lines().count(), 2000);
    assert_eq!(data.text.lines().nth(20), Some("90"));
}

/// Verilator 5.006 rejects a signed product of more than 512 bits.
#[test]
fn a_signed_product_of_any_width_is_taken() {
    let files = print("product", |_, i| {
        let [a, b] = [i.a.repeat(40), i.b.repeat(40)].map(|x| x.signed());
        a.times(b).bits().slice(250..258)
    });
    assert!(files[0].text.contains(" * ") && !files[0].text.contains("$signed"), "{}", files[0].text);
    tools::lint(&files).unwrap();
}

/// A read beyond the last word gives 0, which costs a comparison and a multiplexer if the address can go that far.
#[test]
fn a_read_is_gated_where_its_address_can_be_beyond_the_depth() {
    fn read(m: Module, i: Pair, address: Signal) -> Signal {
        let words = m.memory("words", 400, 8, ReadUnderWrite::Old);
        words.write(i.a.bit(0), cat![i.a.bit(1), i.b], i.a);
        words.read(address) ^ words.read_async(address)
    }
    fn counter(m: Module, last: u32) -> Signal {
        let at = m.reg("at", 9).reset(0);
        at.when(at.eq(last), 0).otherwise(at + 1);
        *at
    }
    let texts = [
        ("whole", false, clean("whole", |m, i| read(m, i, counter(m, 399)))),
        ("one_beyond", true, clean("one_beyond", |m, i| read(m, i, counter(m, 400)))),
        (
            "above",
            false,
            clean("above", |m, i| {
                let at = m.reg("at", 9).reset(3);
                let next = at + i.a.slice(0..3).zext(9);
                at.when(next.lt(400), next);
                read(m, i, *at)
            }),
        ),
        (
            "not_above",
            true,
            clean("not_above", |m, i| {
                let at = m.reg("at", 9).reset(3);
                let next = at + i.a.slice(0..3).zext(9);
                at.when(next.le(400), next);
                read(m, i, *at)
            }),
        ),
        (
            "down",
            false,
            clean("down", |m, i| {
                let at = m.reg("at", 9).reset(399);
                at.when(i.a.bit(7), mux(at.eq(0), 399, at - 1));
                read(m, i, *at)
            }),
        ),
        (
            "cut",
            false,
            clean("cut", |m, i| {
                let at = cat![i.a.bit(0), i.b];
                read(m, i, mux(at.ge(400), 0, at))
            }),
        ),
        (
            "later",
            false,
            clean("later", |m, i| {
                let at = m.reg("later", 9).reset(0);
                at.next(counter(m, 399));
                read(m, i, *at)
            }),
        ),
        ("every_26th", false, clean("every_26th", |m, i| read(m, i, (i.a.slice(0..4) * lit(5, 26)).trunc(9)))),
        ("every_27th", true, clean("every_27th", |m, i| read(m, i, (i.a.slice(0..4) * lit(5, 27)).trunc(9)))),
        // A register without a reset starts with any value.
        (
            "no_reset",
            true,
            clean("no_reset", |m, i| {
                let at = m.reg("at", 9);
                at.when(at.ge(399), 0).otherwise(at + 1);
                read(m, i, *at)
            }),
        ),
        ("from_input", true, clean("from_input", |m, i| read(m, i, cat![i.a.bit(0), i.b]))),
    ];
    for (name, is_gated, text) in texts {
        assert_eq!(text.contains("_inside"), is_gated, "{name}\n{text}");
        assert_eq!(text.contains("< 9'd400) ?"), is_gated, "{name}\n{text}");
    }
}

/// Yosys takes time quadratic in the words of an `initial` block.
#[test]
fn a_large_memory_is_filled_from_a_file() {
    let files =
        print("vast", |m, i| m.memory("filled", 65_536, 8, ReadUnderWrite::Old).fill(0x5a).read(cat![i.a, i.b]));
    let started = std::time::Instant::now();
    tools::lint(&files).unwrap();
    assert!(started.elapsed().as_secs() < 60, "the linters take {:?}", started.elapsed());
    let data = files.iter().find(|file| file.name == "vast.filled.hex").expect("the data are a file");
    assert!(data.text.lines().count() == 65_536 && data.text.lines().all(|line| line == "5a"));
}

#[test]
fn lanes_that_feed_each_other_are_no_loop() {
    clean("gathered", |m, i| {
        let adder = Small { name: "adder", build: |_, i| i.a + i.b };
        let sums = m.array("u_sum", 4, &adder, |row| {
            let y = row.y;
            Pair { a: stack([i.a, y.lane(0), y.lane(1), y.lane(0)]), b: stack([i.b, i.a, y.lane(0), y.lane(2)]) }
        });
        sums.y.last()
    });
}

#[test]
fn what_all_lanes_make_is_called_after_the_array() {
    let text = clean("combined", |m, i| {
        let adder = Small { name: "adder", build: |_, i| i.a + i.b };
        let sums = m.array("u_sum", 4, &adder, |_| Pair { a: i.a, b: constants(bits(8).of(4), u64::from) });
        (sums.y.sum() ^ sums.y.xor_all()) + (sums.y.or_all() ^ sums.y.and_all())
    });
    for name in ["u_sum_y_sum", "u_sum_y_xor", "u_sum_y_any", "u_sum_y_all"] {
        assert!(text.contains(&format!("wire [7:0] {name};")), "{text}");
    }
}

#[test]
fn names_that_arrays_use_are_free_for_others() {
    clean("hostile", |m, i| {
        let inner = Small { name: "inner", build: |_, i| i.a + i.b };
        def!(y_ = i.a ^ 3);
        def!(u_cell_y = !i.b);
        def!(lane = i.b & y_);
        let genvar = (lane | i.a).named("i");
        let cells = m.array("u_cell", 3, &inner, |row| Pair { a: row.y.previous(lane), b: lane });
        let more = m.array("u_more", 3, &inner, |_| Pair { a: constants(bits(8).of(3), u64::from), b: u_cell_y });
        cells.y.sum() ^ genvar ^ y_ ^ more.y.or_all()
    });
}

#[test]
fn what_nothing_reads_is_tied() {
    let text = clean("unread", |m, i| {
        let child = Small { name: "pass", build: |_, i| i.a };
        let _ = m.instance("u_idle", &child, Pair { a: i.a, b: i.b });
        def!(checked = i.a.lt(i.b));
        m.assert(checked, "a stays below b");
        m.assert((i.a + i.b).ne(0), "the sum is not zero");
        let idle = m.reg("idle", 8);
        idle.next(i.b);
        i.a.trunc(4).zext(8)
    });
    assert!(text.contains("wire [7:0] u_idle_y;"), "{text}");
    // Registers that only assertions read are unread in synthesis.
    assert!(text.contains("wire _unused_ok = &{1'b0, rst, u_idle_y, checked, idle};"), "{text}");
}

#[test]
fn constants_do_not_reach_a_comparison() {
    let text = clean("constant", |_, i| {
        let always = i.a.ge(0) & i.b.le(255) & !i.a.gt(255);
        mux(always, case(i.a.slice(0..2), [(1, i.b), (2, lit(8, 7))], i.a), i.b)
    });
    assert!(!text.contains(">=") && !text.contains("<="), "{text}");
}

#[test]
fn signed_operators_have_a_net_of_their_own() {
    let text = clean("signed_ops", |_, i| {
        let shifted = (i.a.signed() >> i.b.slice(0..3)).bits();
        let product = i.a.signed().times(i.b.signed()).bits().slice(4..12);
        (i.b.bit(7).repeat(8) & shifted) + product
    });
    assert!(text.contains("wire [7:0] y_shifted = $signed(a) >>> b[2:0];"), "{text}");
    assert!(text.contains("wire [15:0] a_times_b = $signed(a) * $signed(b);"), "{text}");
}

#[test]
fn shared_expressions_are_printed_once() {
    let text = clean("shared", |_, i| (0..64).fold(i.a ^ i.b, |x, _| x ^ (x + x)));
    assert_eq!(text.matches(" + ").count(), 64, "{text}");
}

/// A named net is read by name everywhere, even if it is the whole next value of a register.
#[test]
fn a_named_choice_is_written_once_however_many_registers_take_it() {
    let text = clean("named_choice", |m, i| {
        def!(fetched = select([(i.a.bit(0), i.b), (i.a.bit(1), i.a ^ i.b), (i.a.bit(2), i.b >> 1)], i.a + i.b));
        def!(held = m.reg(8));
        held.when(i.b.bit(7), fetched + 1).when(i.b.bit(6), fetched);
        def!(last = m.pipe(fetched));
        def!(earlier = m.reg(8).reset(0));
        earlier.when(i.a.eq(0), fetched ^ held).otherwise(fetched);
        held ^ last ^ earlier
    });
    assert_eq!(text.matches("a ^ b").count(), 1, "{text}");
    assert_eq!(text.matches("always @*").count(), 1, "{text}");
    for taken in [
        "held <= fetched + 8'd1;",
        "held <= fetched;",
        "last <= fetched;",
        "earlier <= fetched ^ held;",
        "earlier <= fetched;",
    ] {
        assert!(text.contains(taken), "{taken}\n{text}");
    }
}

#[test]
fn chains_of_any_length_do_not_overflow_the_stack() {
    let files = print("long", |_, i| (0..100_000).fold(i.a, |x, step| if step % 2 == 0 { x + i.b } else { x ^ 5 }));
    assert!(files[0].text.lines().all(|line| line.len() < 200));
    assert_eq!([" + ", " ^ "].map(|operator| files[0].text.matches(operator).count()), [50_000; 2]);
    let muxes = print("choices", |_, i| (0..20_000).fold(i.a, |x, step| mux(i.b.eq(step % 256), step % 255, x)));
    assert_eq!(muxes[0].text.matches("if (").count(), 20_000);
}

#[test]
fn an_array_of_any_size_is_the_same_text() {
    let print = |lanes: u32| {
        let design = elaborate(&Wide { lanes }).unwrap_or_else(|problems| panic!("{problems}"));
        verilog(&design).pop().expect("there is a top module").text
    };
    let (small, large) = (print(1000), print(9000));
    // The number of nodes of a tree with this many leaves, and the last of them; the place comments move to the
    // right.
    let sizes = |lanes: u32| [2 * lanes - 1, 2 * lanes - 2, lanes].map(|size| size.to_string());
    let of_any_size = |text: &str, lanes: u32| {
        let words: Vec<&str> = text.split_whitespace().collect();
        sizes(lanes).iter().fold(words.join(" "), |text, size| text.replace(size, "N"))
    };
    assert_eq!(of_any_size(&small, 1000), of_any_size(&large, 9000));
    assert_eq!(small.lines().count(), large.lines().count());
}

#[test]
fn constants_of_lanes_are_formulas_or_tables() {
    let text = clean("positions", |m, i| {
        let adder = Small { name: "adder", build: |_, i| i.a + i.b };
        let grid = m.array("u_grid", 64, &adder, |_| Pair {
            a: constants(bits(8).of(64), |lane| u64::from(lane % 8)),
            b: constants(bits(8).of(64), |lane| u64::from(lane / 8)),
        });
        let scattered = m.array("u_scattered", 64, &adder, |_| Pair {
            a: constants(bits(8).of(64), |lane| u64::from(lane * lane % 251)),
            b: i.b,
        });
        grid.y.xor_all() ^ scattered.y.xor_all() ^ i.a
    });
    assert!(text.contains("localparam [31:0] lane_a = i % 8;"), "{text}");
    assert!(text.contains("localparam [31:0] lane_b = i / 8;"), "{text}");
    assert!(text.contains("localparam [511:0] u_scattered_lane_a = {"), "{text}");
}

#[test]
fn memories_become_block_ram() {
    let files = verilog(&elaborate(&LineBuffer).expect("the block is sound"));
    // For 1000 words of 24 bits, with the flag of an address in range as the only flip-flop.
    for (target, ram, count, flip_flop) in
        [(Target::Ice40, "SB_RAM40_4K", 6, "SB_DFF"), (Target::Ecp5, "DP16KD", 2, "TRELLIS_FF")]
    {
        if let Some(cells) = tools::cells(&files, target).unwrap() {
            assert_eq!((cells.get(ram), cells.get(flip_flop)), (Some(&count), Some(&1)), "{cells:?}");
        }
    }
}

block! {
    /// An array of registers in a chain.
    struct Wide { lanes: u32 }
    in = Pair { a: bits(8), b: bits(16) };
    out = One { y: bits(8) };
}

impl Wide {
    fn build(&self, m: Module, i: Pair) -> One {
        let cell = Cell;
        let cells = m.array("u_cell", self.lanes, &cell, |row| Pair {
            a: row.y.previous(i.a),
            b: constants(bits(16).of(self.lanes), u64::from),
        });
        One { y: cells.y.xor_all() ^ i.b.trunc(8) }
    }
}

block! {
    struct Cell;
    in = Pair { a: bits(8), b: bits(16) };
    out = One { y: bits(8) };
}

impl Cell {
    fn build(&self, m: Module, i: Pair) -> One {
        One { y: m.pipe("y", i.a ^ i.b.trunc(8) ^ i.b.slice(8..16)) }
    }
}

/// A row of cells: `take` returns the first input of each lane.
fn cells(m: Module, count: u32, i: Pair, take: impl FnOnce(One) -> Signal) -> Signal {
    let cell = Small { name: "cell_", build: |_, i| i.a ^ i.b };
    let row = m.array("u_cell", count, &cell, |row| Pair { a: take(row), b: i.b });
    row.y.xor_all()
}

#[test]
fn a_shift_has_its_edge_at_the_end_it_comes_from() {
    let previous = clean("from_previous", |m, i| cells(m, 3, i, |row| row.y.previous(i.a)));
    assert!(previous.contains("if (i < 1) begin : lane_a_edge"), "{previous}");
    let following = clean("from_following", |m, i| cells(m, 3, i, |row| row.y.shifted(-2, i.a)));
    assert!(following.contains("if (i >= 1) begin : lane_a_edge"), "{following}");
}

/// Tools accept no more than 65,536 bits in a vector.
#[test]
fn constants_without_a_rule_are_a_table_up_to_its_widest() {
    fn text(name: &'static str, build: fn(Module, Pair) -> Signal) -> String {
        print(name, build).pop().expect("there is a module").text
    }
    fn irregular(m: Module, count: u32, i: Pair) -> Signal {
        let words = (0..u64::from(count)).map(move |lane| lit(8, (lane * lane / 7 + lane) & 0xff));
        cells(m, count, i, move |_| stack(words))
    }
    assert!(text("widest", |m, i| irregular(m, 8192, i)).contains("[65535:0]"));
    assert!(!text("too_wide", |m, i| irregular(m, 8193, i)).contains("[65543:0]"));
}
