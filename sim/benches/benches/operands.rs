//! The time from a design to the first cycle if an operation has very many operands:
//! `cargo bench -p tilewright-benches --bench operands`. Twice the operands should take twice the time.

use std::time::Instant;

use tilewright_hdl::{Module, Signal, Width, bits, block, bundle, case, concat, elaborate, lit, mux, select, stack};
use tilewright_sim::{EngineKind, Simulation};

/// The operation with the many operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Form {
    /// Bits of one number, side by side, repeated.
    Bits,
    /// Bits of a register as wide as the result, permuted.
    Shuffled,
    /// Computed bits, side by side.
    Computed,
    /// Constants by number.
    Table,
    /// Computed values by number.
    Cases,
    /// Computed values by conditions.
    Select,
    /// The next value of a register, by conditions.
    Whens,
    /// Lanes, one after another.
    Lanes,
}

bundle! {
    struct In<T> { x: T }
    struct Out<T> { y: T }
}

block! {
    /// One operation with this number of operands.
    struct Operands {
        form: Form,
        operands: u32,
    }
    in(self) = In { x: bits(20) };
    out(self) = Out { y: self.width() };
}

impl Operands {
    fn width(&self) -> Width {
        match self.form {
            Form::Bits | Form::Shuffled | Form::Computed => bits(self.operands),
            _ => bits(20),
        }
    }

    fn build(&self, m: Module, i: In) -> Out {
        let (n, x) = (self.operands, i.x);
        let numbers = || 0..n;
        let condition = |k: u32| x.eq(u64::from(k));
        let value = |k: u32| x ^ u64::from(k);
        let y: Signal = match self.form {
            Form::Bits => concat(&numbers().map(|k| x.bit(k % 20)).collect::<Vec<_>>()),
            Form::Shuffled => {
                let all = m.reg("all", n).reset(0);
                all.next(concat(&numbers().map(|k| all.bit(k ^ 1)).collect::<Vec<_>>()) ^ x.zext(n));
                *all
            }
            Form::Computed => concat(&numbers().map(condition).collect::<Vec<_>>()),
            Form::Table => case(x, numbers().map(|k| (k, lit(20, k.wrapping_mul(77) % (1 << 20)))), lit(20, 5)),
            Form::Cases => case(x, numbers().map(|k| (k, value(k ^ 1))), x),
            Form::Select => select(numbers().map(|k| (condition(k), value(k ^ 1))), x),
            Form::Whens => {
                let y = m.reg("taken", 20).reset(0);
                let first = y.when(condition(0), value(1));
                let _ = (1..n).fold(first, |all, k| all.when(condition(k), value(k ^ 1)));
                *y
            }
            Form::Lanes => stack(numbers().map(value)).xor_all(),
        };
        Out { y: m.pipe("last", mux(x.eq(0), y, !y)) }
    }
}

/// Seconds of processor time, or of wall-clock time if the system does not tell.
fn now(start: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let spent = text.split(' ').next().and_then(|it| it.parse::<f64>().ok());
    spent.map_or_else(|| start.elapsed().as_secs_f64(), |nanoseconds| nanoseconds / 1e9)
}

fn main() {
    let all = [
        (Form::Bits, 262_144),
        (Form::Shuffled, 262_144),
        (Form::Computed, 262_144),
        (Form::Table, 100_000),
        (Form::Cases, 100_000),
        (Form::Select, 100_000),
        (Form::Whens, 65_536),
        (Form::Lanes, 65_536),
    ];
    let mut arguments = std::env::args().skip(1).filter(|it| !it.starts_with('-'));
    let only = arguments.next();
    for (form, most) in all {
        if only.as_ref().is_some_and(|only| *only != format!("{form:?}")) {
            continue;
        }
        for operands in [most / 4, most / 2, most] {
            let start = Instant::now();
            let described = now(start);
            let design = elaborate(&Operands { form, operands }).expect("the description has no mistake");
            print!("{:10} {operands:7}   described {:6.2} s", format!("{form:?}"), now(start) - described);
            for kind in [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled] {
                let begun = now(start);
                let mut sim = Simulation::from_design(&design).expect("it can run").on(kind);
                let program = now(start);
                sim.step();
                let first = now(start);
                sim.run(10);
                let then = (now(start) - first) / 10.0;
                let (program, first) = (program - begun, first - program);
                print!("   {kind:?}: program {program:.2} s, first cycle {first:.2} s, each {then:.4} s");
            }
            println!();
        }
    }
}
