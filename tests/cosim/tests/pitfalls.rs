//! What printers of Verilog are known to get wrong, each as a small circuit with the expected values written down, in
//! our simulator, Icarus and Verilator.

use tilewright_cosim::batch::{self, Printed, Tool};
use tilewright_cosim::check::check_design;
use tilewright_gen::{testbench, verilog};
use tilewright_hdl::Recording;
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct In<T> { a: T, b: T, c: T }
    struct Out<T> { y: T }
}

/// A circuit of three inputs and one output.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Pitfall {
    name: &'static str,
    /// Of the inputs, in bits.
    widths: [u32; 3],
    circuit: fn(In) -> Signal,
    /// Values of the inputs, and the output that follows.
    rows: &'static [[u128; 4]],
}

const PITFALLS: &[Pitfall] = &[
    // A block that waits for a change of its inputs has some.
    Pitfall {
        name: "choice_by_a_constant",
        widths: [1, 1, 1],
        circuit: |i| case(lit(2, 2) << lit(2, 1), [(0, i.a), (1, i.b)], i.c),
        rows: &[[1, 0, 0, 1], [0, 1, 1, 0]],
    },
    // Two shifts by as much as the amounts hold are one by their whole sum.
    Pitfall {
        name: "shifted_left_twice",
        widths: [8, 2, 2],
        circuit: |i| (i.a << i.b) << i.c,
        rows: &[[0xff, 3, 3, 0xc0], [0xff, 3, 1, 0xf0], [0xff, 0, 0, 0xff]],
    },
    Pitfall {
        name: "shifted_right_three_times",
        widths: [8, 2, 2],
        circuit: |i| ((i.a >> i.b).named("once") >> i.c) >> i.b,
        rows: &[[0xff, 3, 1, 1], [0xff, 3, 3, 0], [0xff, 0, 2, 0x3f]],
    },
    // A signed product that is wider than some tools have.
    Pitfall {
        name: "wide_signed_product",
        widths: [8, 8, 1],
        circuit: |i| i.a.signed().sext(300).times(i.b.signed().sext(300)).bits().slice(0..16),
        rows: &[[0xff, 0xff, 0, 1], [0x80, 2, 0, 0xff00], [0x7f, 0x81, 0, 0xc0ff]],
    },
    // Exclusive ors and inversions of bits of a wide value.
    Pitfall {
        name: "a_bit_left_over_by_three",
        widths: [39, 1, 1],
        circuit: |i| cat![i.a.slice(32..39), i.a.bit(38) ^ i.a.bit(31) ^ i.a.bit(38)].ne(i.a.slice(31..39)),
        rows: &[[0x40_8000_0000, 0, 0, 0], [0x40_0000_0000, 0, 0, 0], [0x00_8000_0000, 0, 0, 0]],
    },
    Pitfall {
        name: "inverted_twice_between_ands",
        widths: [8, 8, 8],
        circuit: |i| {
            let not_both = !(i.a.bit(3) & i.b.bit(1));
            let or = !(i.c.bit(2) & not_both);
            i.c.bit(0) & !!or
        },
        rows: &[[8, 2, 5, 1], [0, 2, 5, 0], [8, 2, 1, 1], [8, 2, 4, 0]],
    },
    // A signed comparison stays signed beside an unsigned operand.
    Pitfall {
        name: "signed_compare_in_unsigned_context",
        widths: [8, 8, 8],
        circuit: |i| i.a.signed().lt(i.b.signed()).zext(8) + i.c,
        rows: &[[0x80, 0x7f, 3, 4], [0x7f, 0x80, 3, 3], [0xff, 0, 0, 1]],
    },
    // An arithmetic shift stays arithmetic in an unsigned context.
    Pitfall {
        name: "arithmetic_shift_in_unsigned_context",
        widths: [8, 3, 1],
        circuit: |i| i.c.repeat(8) & (i.a.signed() >> i.b).bits(),
        rows: &[[0x80, 3, 1, 0xf0], [0x80, 7, 1, 0xff], [0x70, 4, 1, 7]],
    },
    Pitfall {
        name: "arithmetic_shift_in_a_mux",
        widths: [8, 3, 1],
        circuit: |i| mux(i.c, (i.a.signed() >> i.b).bits(), i.a),
        rows: &[[0x80, 3, 1, 0xf0], [0x80, 3, 0, 0x80]],
    },
    // A sign extends from the operand and not from the context.
    Pitfall {
        name: "sign_extension_of_a_sum",
        widths: [4, 4, 12],
        circuit: |i| (i.a + i.b).sext(12) + i.c,
        rows: &[[7, 1, 0, 0xff8], [15, 1, 5, 5], [8, 0, 0x010, 0x008]],
    },
    // A sum does not keep its carry in a wider context.
    Pitfall {
        name: "carry_in_a_wider_context",
        widths: [8, 8, 9],
        circuit: |i| ((i.a + i.b) >> 1).zext(9) + i.c,
        rows: &[[0xff, 0x01, 0, 0], [0x80, 0x82, 1, 2]],
    },
    Pitfall {
        name: "sum_compared",
        widths: [8, 8, 9],
        circuit: |i| (i.a + i.b).zext(9).eq(i.c),
        rows: &[[0xff, 1, 0x100, 0], [0xff, 1, 0, 1]],
    },
    // Reductions of one bit and of inversions.
    Pitfall {
        name: "reductions_of_one_bit",
        widths: [1, 1, 1],
        circuit: |i| cat![i.a.all_ones(), i.a.any_one(), i.a.parity()],
        rows: &[[0, 0, 0, 0b000], [1, 0, 0, 0b111]],
    },
    Pitfall {
        name: "reductions_of_inversions",
        widths: [2, 1, 1],
        circuit: |i| cat![(!i.a).all_ones(), (!i.a).any_one(), (!i.a).parity()],
        rows: &[[0, 0, 0, 0b110], [1, 0, 0, 0b011], [2, 0, 0, 0b011], [3, 0, 0, 0b000]],
    },
    // Reductions of reductions.
    Pitfall {
        name: "reductions_of_reductions",
        widths: [3, 3, 1],
        circuit: |i| (i.a.all_ones() & i.b.all_ones().all_ones()) | i.c.any_one().any_one(),
        rows: &[[7, 7, 0, 1], [7, 6, 0, 0], [0, 0, 1, 1]],
    },
    // Shifts by the width and beyond.
    Pitfall {
        name: "shifts_beyond_the_width",
        widths: [8, 9, 1],
        circuit: |i| cat![i.a << i.b, i.a >> i.b, (i.a.signed() >> i.b).bits()],
        rows: &[[0x81, 7, 0, 0x80_01_ff], [0x81, 8, 0, 0x00_00_ff], [0x81, 0x100, 0, 0x00_00_ff]],
    },
    // Shift amounts wider than a word.
    Pitfall {
        name: "shifts_by_wide_amounts",
        widths: [8, 70, 1],
        circuit: |i| cat![i.a << i.b, i.a >> i.b, (i.a.signed() >> i.b).bits()],
        rows: &[[0x81, 1, 0, 0x02_40_c0], [0x81, (1 << 69), 0, 0x00_00_ff], [0x81, 1 << 32, 0, 0x00_00_ff]],
    },
    // Arithmetic of one bit.
    Pitfall {
        name: "arithmetic_of_one_bit",
        widths: [1, 1, 1],
        circuit: |i| cat![i.a + i.b, i.a - i.b, i.a.lt(i.b), i.a.signed().lt(i.b.signed()), (-i.a.signed()).bits()],
        rows: &[[1, 1, 0, 0b00001], [0, 1, 0, 0b11100], [1, 0, 0, 0b11011]],
    },
    // Products of one bit and signed products.
    Pitfall {
        name: "signed_product_of_one_bit",
        widths: [1, 1, 1],
        circuit: |i| (i.a.signed() * i.b.signed()).bits(),
        rows: &[[1, 1, 0, 1], [1, 0, 0, 0]],
    },
    Pitfall {
        name: "signed_product_in_unsigned_context",
        widths: [4, 4, 8],
        circuit: |i| (i.a.signed() * i.b.signed()).bits() + i.c,
        rows: &[[15, 15, 1, 2], [8, 8, 0, 64], [8, 7, 0, 0xc8]],
    },
    Pitfall {
        name: "product_keeps_all_bits",
        widths: [8, 3, 1],
        circuit: |i| i.a * i.b,
        rows: &[[0xff, 7, 0, 0x6f9], [0xff, 0, 0, 0]],
    },
    // Concatenations put the first on top.
    Pitfall {
        name: "concatenation_order",
        widths: [4, 8, 4],
        circuit: |i| cat![i.a, i.b, i.c],
        rows: &[[1, 0x23, 4, 0x1234]],
    },
    // Slices of expressions.
    Pitfall {
        name: "slices_of_expressions",
        widths: [8, 8, 1],
        circuit: |i| {
            cat![(i.a + i.b).slice(4..8), (i.a & i.b).bit(0), i.a.add_carry(i.b).bit(8), (i.a * i.b).slice(8..16)]
        },
        rows: &[[0xf1, 0x2f, 0, 0x0b2c], [0x11, 0x11, 0, 0x0a01]],
    },
    // An extended negative keeps its width.
    Pitfall {
        name: "extended_inversion",
        widths: [4, 4, 8],
        circuit: |i| (!i.a).zext(8) ^ (-i.b.signed()).bits().zext(8) ^ i.c,
        rows: &[[0, 1, 0, 0], [0xf, 0, 0xf0, 0xf0], [5, 3, 0, 7]],
    },
];

impl std::fmt::Debug for Pitfall {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl Block for Pitfall {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        let [a, b, c] = self.widths.map(bits);
        In { a, b, c }
    }

    fn build(&self, m: Module, i: In) -> Out {
        m.ignore(&i);
        Out { y: (self.circuit)(i) }
    }

    fn name(&self) -> String {
        self.name.to_owned()
    }
}

impl Pitfall {
    fn input(&self, [a, b, c, _]: [u128; 4]) -> [Bits; 3] {
        let [wa, wb, wc] = self.widths;
        [Bits::from_u128(wa, a), Bits::from_u128(wb, b), Bits::from_u128(wc, c)]
    }

    /// For another simulator: the expected values are those written down.
    fn printed(&self) -> Printed {
        let design = elaborate(self).unwrap();
        let width = design.top().width(design.top().outputs[0].node);
        let step = |(number, row): (usize, &[u128; 4])| Step {
            time_ps: 1000 * (number as u64 + 1),
            rising: Vec::new(),
            resets: Vec::new(),
            inputs: self.input(*row).to_vec(),
            outputs: vec![Bits::from_u128(width, row[3])],
        };
        let replay = Recording { steps: self.rows.iter().enumerate().map(step).collect(), initial: Vec::new() };
        Printed {
            files: verilog(&design),
            bench: testbench(&design, &replay),
            fails: false,
            covered: None,
            shown: None,
        }
    }
}

#[test]
fn our_simulator_avoids_them() {
    for pitfall in PITFALLS {
        let mut sim = Simulation::of(pitfall).unwrap();
        for row in pitfall.rows {
            let [a, b, c] = pitfall.input(*row);
            sim.drive_bits(In { a, b, c });
            assert_eq!(sim.read().y.to_u128(), Some(row[3]), "{pitfall:?} of {row:?}");
        }
    }
}

fn avoided_in(tool: Tool) {
    if !tool.is_here() {
        return;
    }
    let printed: Vec<Printed> = PITFALLS.iter().map(Pitfall::printed).collect();
    let verdicts = batch::run(tool, &printed, batch::PATIENCE).unwrap();
    for (pitfall, wrong) in PITFALLS.iter().zip(verdicts) {
        assert!(wrong.is_none(), "{pitfall:?} in {}:\n{}", tool.name(), wrong.unwrap_or_default());
    }
}

#[test]
fn the_printed_verilog_avoids_them_in_icarus() {
    avoided_in(Tool::Icarus);
}

#[test]
fn the_printed_verilog_avoids_them_in_verilator() {
    avoided_in(Tool::Verilator);
}

/// Reads a memory at addresses that are computed, and wrap.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Wrapping;

impl Block for Wrapping {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        In { a: bits(3), b: bits(3), c: bits(8) }
    }

    fn build(&self, m: Module, i: In) -> Out {
        def!(words = m.memory(8, 8, ReadUnderWrite::Old).words((0..8).map(|word| Bits::new(8, 17 * word))));
        words.write(i.a.eq(i.b), i.a + i.b, i.c);
        Out { y: words.read(i.a + i.b) ^ words.read_async(i.a - i.b) }
    }
}

/// Some simulators do not cut the expression in an index to its width.
#[test]
fn addresses_wrap_at_their_width() {
    let stimulus = |sim: &mut Simulation| {
        let [a, b, c] = ["a", "b", "c"].map(|name| sim.port(name).unwrap());
        for step in 0..64u64 {
            sim.set(a, step % 8);
            sim.set(b, step / 8);
            sim.set(c, step);
            sim.try_step()?;
        }
        Ok(())
    };
    check_design(&elaborate(&Wrapping).unwrap(), stimulus).unwrap();
}
