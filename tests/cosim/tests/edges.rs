//! Clocks of both edges, and memories whose addresses are said to stay in bounds.

use tilewright_cosim::check::check_design;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

const BUS: Clock = Clock::new("bus", Period::ns(14)).reset(Reset::AsynchronousLow).falling();

block! {
    /// A state machine, lanes and a memory of a number of words that is no power of two.
    struct Store;
    in StoreIn { write: bit(), data: bits(8) }
    out StoreOut { word: bits(8), sum: bits(8), at: below(11) }
}

impl Store {
    fn build(&self, m: Module, i: StoreIn) -> StoreOut {
        def!(at = m.reg(below(11)).reset(3));
        // A saturating sum is no address that the printer can bound.
        at.next(mux((at + i.data.trunc(2).zext(4)).lt(11), at + i.data.trunc(2).zext(4), 0));
        def!(bytes = m.memory(11, 8, ReadUnderWrite::Old).fill(7).in_bounds());
        bytes.write(i.write, at, i.data);
        def!(word = bytes.read_when(!i.write, at));
        def!(ring = m.reg(bits(8).of(row(3))).reset(0));
        ring.next(ring.previous(word));
        m.assert(m.past(i.write).implies(word.eq(m.past(word))), "a write reads nothing");
        StoreOut { word, sum: ring.sum(), at: *at }
    }
}

block! {
    /// The store on a rising clock and on a falling one.
    struct Both;
    in BothIn { own: StoreIn { write: bit(), data: bits(8) }, bus: StoreIn { write: bit(), data: bits(8) }.on(BUS) }
    out BothOut { own_out: StoreOut = _, bus_out: StoreOut = _ }
}

impl Both {
    fn build(&self, m: Module, i: BothIn) -> BothOut {
        def!(own = m.instance(&Store, i.own));
        def!(bus = m.on(BUS).instance(&Store, i.bus));
        BothOut { own_out: own, bus_out: bus }
    }
}

#[test]
fn others_agree_on_clocks_of_both_edges() {
    let stimulus = |sim: &mut Simulation| {
        let ports = ["own_write", "own_data", "bus_write", "bus_data"].map(|name| sim.port(name).unwrap());
        for step in 0..80u64 {
            if step == 20 || step == 26 {
                sim.set_reset(BUS, step == 20);
            }
            let values = [step / 3 % 2, step * 37 % 256, step / 5 % 2, step * 91 % 256];
            ports.into_iter().zip(values).for_each(|(port, value)| sim.set(port, value));
            sim.try_step()?;
        }
        Ok(())
    };
    check_design(&elaborate_at(&Both, DefaultClock::new(DEFAULT_PERIOD)).unwrap(), stimulus).unwrap();
    check_design(&elaborate_at(&Both, DefaultClock::new(DEFAULT_PERIOD).falling()).unwrap(), stimulus).unwrap();
}
