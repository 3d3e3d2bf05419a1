//! Queues of records, each field of which is used: `cargo bench -p tilewright-benches --bench records`.

use std::time::Instant;

use tilewright_blocks::StreamBlocks;
use tilewright_hdl::{Module, Signal, bits, block, bundle, constants, def, elaborate, row};
use tilewright_sim::{Passes, Simulation};

/// Cycles of a measurement.
const CYCLES: u64 = 20_000;

bundle! {
    struct Job<T> { a: T, b: T, x: T, y: T, flag: T }
}

block! {
    /// A queue from a maker of records, from a counter, to an adder of their fields.
    struct Unit;
    in UnitIn { seed: bits(32) }
    out UnitOut { sum: bits(32) }
}

impl Unit {
    fn build(&self, m: Module, i: UnitIn) -> UnitOut {
        def!(count = m.reg(32).reset(0));
        let number = *count + i.seed;
        let a = constants(bits(32).of(row(3)), |lane| 3 + u64::from(lane)) + number;
        let b = constants(bits(40).of(row(4)), |lane| 5 << lane) ^ number.zext(40);
        let job = Job { a, b, x: number.part(3, 10), y: number.part(9, 10), flag: number.bit(0) };
        let (jobs, sent) = m.offer(number.part(0, 3).ne(5), job);
        count.next(*count + 0x0019_660d);
        let job = m.fifo("u_queue", 2, jobs).take_when(number.part(4, 2).ne(3));
        def!(sum = m.reg(32).reset(0));
        let fields = job.a.xor_all() + job.b.xor_all().trunc(32);
        let place = tilewright_hdl::cat![job.x, job.y, job.flag, sent].zext(32);
        sum.when(job.taken, *sum + (fields ^ place));
        UnitOut { sum: *sum }
    }
}

block! {
    /// Several of them.
    struct Units {
        count: u32,
    }
    out TopOut { csum: bits(32) }
}

impl Units {
    fn build(&self, m: Module, (): ()) -> TopOut {
        let seed: Signal = constants(bits(32).of(row(self.count)), |lane| u64::from(lane) * 77_777);
        let units = m.array("u_unit", self.count, &Unit, |_| UnitIn { seed });
        def!(csum = m.reg(32).reset(0));
        csum.next(csum.rotate_left(3) + units.sum.xor_all());
        TopOut { csum: *csum }
    }
}

/// Nanoseconds a cycle, the best of five measurements, and the checksum.
fn measure(units: &Units, passes: &Passes) -> (f64, u64) {
    let design = elaborate(units).expect("it keeps all rules");
    let mut sim = Simulation::with_passes(&design, passes).expect("every design can be compiled");
    sim.run(10);
    let least = (0..5).map(|_| {
        let start = Instant::now();
        sim.run(CYCLES);
        start.elapsed().as_secs_f64() * 1e9 / CYCLES as f64
    });
    let cycle = least.fold(f64::INFINITY, f64::min);
    let port = sim.port("csum").expect("it is there");
    (cycle, sim.get(port).to_u64().expect("32 bits"))
}

fn main() {
    for count in [1, 4, 64, 256] {
        let units = Units { count };
        let (whole, expected) = measure(&units, &Passes { fields: false, ..Passes::default() });
        let (split, sum) = measure(&units, &Passes::default());
        assert_eq!(sum, expected, "fields make no difference but in time");
        println!(
            "{count:4} queues   whole {whole:8.0} ns a cycle   in fields {split:8.0}   {:5.2} times as fast",
            whole / split
        );
    }
}
