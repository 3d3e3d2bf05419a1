//! Random circuits: what the simulator computes, the printed Verilog computes too, in Icarus; and no linter has
//! anything to say about a sample of them.
//!
//! `CIRCUITS=1000 cargo test --test random_circuits` tries more; each failure names its seed.

use tilewright_gen::{Replay, ReplayStep, testbench, tools, verilog};
use tilewright_hdl::{
    Bits, Block, Module, ReadUnderWrite, Reg, Signal, Width, bit, bits, bundle, case, cat, elaborate, lit, mux, select,
};
use tilewright_sim::Simulation;

bundle! {
    struct Inputs<T> { a: T, b: T, c: T, d: T, e: T, f: T }
    struct Outputs<T> { o0: T, o1: T, o2: T, o3: T, o4: T, o5: T, o6: T, o7: T }
}

/// The SplitMix64 generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn flip(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Zeros, ones, or anything.
    fn bits(&mut self, width: u32) -> Bits {
        match self.below(4) {
            0 => Bits::zero(width),
            1 => Bits::ones(width),
            _ => Bits::from_limbs(width, &[self.next(), self.next()]),
        }
    }
}

/// A circuit of so many random operators; at `depth` 1 it also has an array and an instance of smaller ones.
#[derive(Debug, Clone, PartialEq)]
struct Soup {
    seed: u64,
    operators: u32,
    depth: u32,
}

/// The signals made so far, and the generator that picks among them.
struct Pot {
    random: Random,
    signals: Vec<Signal>,
}

impl Pot {
    /// A signal, or now and then a constant.
    fn pick(&mut self) -> Signal {
        if self.random.below(8) > 0 {
            let at = self.random.below(self.signals.len());
            return self.signals[at];
        }
        let width = [1, 3, 8, 16, 33, 64][self.random.below(6)];
        let value = self.random.bits(width).to_u64().expect("at most 64 bits");
        lit(width, value)
    }

    /// A signal cut or widened to a width.
    fn pick_wide(&mut self, width: u32) -> Signal {
        let signal = self.pick();
        if signal.width() >= width {
            let low = self.random.below((signal.width() - width + 1) as usize) as u32;
            return signal.slice(low..low + width);
        }
        if self.random.flip() { signal.zext(width) } else { signal.sext(width) }
    }

    fn operator(&mut self) -> Signal {
        let x = self.pick();
        let (y, z, other) = (self.pick_wide(x.width()), self.pick_wide(x.width()), self.pick());
        let (small, bit) = (x.width().max(other.width()) < 40, self.pick_wide(1));
        match self.random.below(26) {
            0 => x + y,
            1 => x - y,
            2 => x & y,
            3 => x | y,
            4 => x ^ y,
            5 => !x,
            6 if small => x.times(other),
            7 if small => x.signed().times(other.signed()).bits(),
            8 => x.eq(y),
            9 => x.lt(y),
            10 => x.ge(y),
            11 => x.signed().lt(y.signed()),
            12 => x.signed().ge(y.signed()),
            13 => x << other,
            14 => x >> other,
            15 => (x.signed() >> other).bits(),
            16 => mux(bit, x, y),
            17 => select([(bit, y), (x.any_one(), z), (y.parity(), x)], !z),
            18 => case(self.pick_wide(3), [(0, x), (3, y), (5, z), (6, x + y)], z ^ x),
            19 if small => cat![x, other],
            20 if small => x.repeat(2),
            21 => x.all_ones(),
            22 => x.any_one(),
            23 => x.parity(),
            24 => x.signed().gt(y.signed()),
            _ => x.le(y),
        }
    }

    fn next_of(&mut self, register: Reg) {
        let (width, own) = (register.width(), register.value());
        let register = if self.random.flip() { register.enable(self.pick_wide(1)) } else { register };
        let (x, y, c, d) = (self.pick_wide(width), self.pick_wide(width), self.pick_wide(1), self.pick_wide(1));
        match self.random.below(5) {
            0 => register.next(x),
            1 => register.next(mux(c, x, own)),
            2 => register.next(mux(c, own, mux(d, x, y))),
            3 => register.next(select([(c, mux(d, x, y)), (d, y)], own)),
            _ => register.next(case(self.pick_wide(2), [(0, x), (1, mux(c, y, own)), (2, own)], y)),
        }
    }
}

impl Block for Soup {
    type In = Inputs;
    type Out = Outputs;

    fn inputs(&self) -> Inputs<Width> {
        Inputs { a: bits(8), b: bits(8), c: bit(), d: bits(9), e: bits(33), f: bits(70) }
    }

    fn build(&self, m: Module, i: Inputs) -> Outputs {
        m.ignore(&i);
        let mut pot = Pot { random: Random(self.seed), signals: vec![i.a, i.b, i.c, i.d, i.e, i.f] };
        let registers = [1, 8, 13, 40].map(|width| {
            let register = m.reg(&format!("r{width}"), width);
            pot.signals.push(register.value());
            if pot.random.flip() { register.reset(pot.random.next() & 1) } else { register }
        });
        for number in 0..self.operators {
            let signal = pot.operator();
            let named = pot.random.below(5) == 0;
            pot.signals.push(if named { signal.named(&format!("n{number}")) } else { signal });
        }
        let memory = m.memory("memory", 5, 9, ReadUnderWrite::Old);
        let words = (0..4).map(|word| Bits::new(9, word * 77));
        let memory = if pot.random.flip() { memory.words(words) } else { memory };
        memory.write(pot.pick_wide(1), pot.pick_wide(3), pot.pick_wide(9));
        let o6 = memory.read_when(pot.pick_wide(1), pot.pick_wide(3));
        let o7 = memory.read_async(pot.pick_wide(3));
        registers.into_iter().for_each(|register| pot.next_of(register));
        let last = pot.signals.len() - 1;
        let mut o = [0; 6].map(|_| pot.signals[last - pot.random.below(20.min(last))]);
        if self.depth > 0 {
            let child = Soup { seed: self.seed + 1, operators: self.operators / 2, depth: self.depth - 1 };
            let cells = m.array("u_cell", 3, &child, |row| Inputs {
                a: row.all(&pot.pick_wide(8)),
                b: row.index(8),
                c: row.constants(1, |lane| u64::from(lane % 2)),
                d: row.out.o6.previous(3),
                e: row.each([0; 3].map(|_| pot.pick_wide(33))),
                f: row.constants(70, |lane| u64::from(lane * lane) << 30),
            });
            (o[3], o[4], o[5]) = (cells.o0.lane(1), cells.o7.sum(), cells.o6.or_all());
            let d = cells.o6.xor_all();
            o[2] = m.instance("u_one", &child, Inputs { a: i.a, b: i.b, c: i.c, d, e: i.e, f: i.f }).o0;
        }
        let [o0, o1, o2, o3, o4, o5] = o;
        Outputs { o0, o1, o2, o3, o4, o5, o6, o7 }
    }
}

/// A run of 40 cycles on random inputs, with a reset in the middle if there is one.
fn record(block: &Soup) -> Replay {
    let mut sim = Simulation::of(block).expect("the circuit is sound");
    let recording = sim.recording();
    let mut random = Random(!block.seed);
    let has_reset = elaborate(block).expect("the circuit is sound").top().clocks[0].reset.is_some();
    for cycle in 0..40 {
        for (name, width) in [("a", 8), ("b", 8), ("c", 1), ("d", 9), ("e", 33), ("f", 70)] {
            let port = sim.port(name).expect("it is an input");
            sim.set(port, random.bits(width));
        }
        if cycle == 20 && has_reset {
            sim.reset();
        }
        sim.step();
    }
    let recording = recording.lock().expect("nobody panicked").clone();
    let step = |step: tilewright_sim::Step| ReplayStep {
        time_ps: step.time,
        rising: step.clocks,
        resets: step.resets,
        inputs: step.inputs,
        outputs: step.outputs,
    };
    Replay { steps: recording.steps.into_iter().map(step).collect(), initial: Vec::new() }
}

#[test]
fn icarus_computes_what_the_simulator_computes() {
    let circuits = std::env::var("CIRCUITS").map_or(40, |count| count.parse().expect("CIRCUITS is a number"));
    for seed in 0..circuits {
        let block = Soup { seed, operators: 20 + (seed % 5 * 20) as u32, depth: (seed % 2) as u32 };
        let design = elaborate(&block).unwrap_or_else(|problems| panic!("seed {seed}: {problems}"));
        let (files, bench) = (verilog(&design), testbench(&design, &record(&block)));
        let _ = tools::replay_in_icarus(&files, &bench).unwrap_or_else(|problems| panic!("seed {seed}: {problems}"));
        if seed % 10 == 1 {
            tools::lint(&files).unwrap_or_else(|problems| panic!("seed {seed}: {problems}"));
        }
    }
}
