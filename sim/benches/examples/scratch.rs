use std::time::Instant;
use tilewright_benches::Subject;
use tilewright_sim::Simulation;
fn main() {
    let cycles: u64 = std::env::args().nth(1).unwrap().parse().unwrap();
    for name in std::env::args().skip(2) {
        let subject: Subject = name.parse().unwrap();
        let design = subject.design().unwrap();
        let start = Instant::now();
        let mut sim = Simulation::with_passes(&design, &tilewright_sim::Passes::default()).unwrap();
        sim.run(1);
        let first = start.elapsed();
        sim.run(60_000);
        let mut best = f64::MAX;
        for _ in 0..5 {
            let start = Instant::now();
            sim.run(cycles);
            best = best.min(start.elapsed().as_nanos() as f64 / cycles as f64);
        }
        println!("{name}: first {:.1} ms, {best:.1} ns, csum {:x}", first.as_secs_f64() * 1e3, sim.peek("csum").unwrap());
    }
}
