//! A helper that is called again and again, so that one line of the source asks for the same names.

use super::names::Kind;
use super::{Builder, fit};
use crate::features::Feature;
use crate::spec::Pick;
use tilewright_blocks::{Counter, CounterIn};
use tilewright_hdl::*;

/// The names that the helper asks for.
#[derive(Debug, Clone)]
pub struct Names {
    register: String,
    net: String,
    memory: String,
    instance: String,
}

/// How wide its values are at most.
const WIDEST: u32 = 70;

impl Builder<'_> {
    /// Calls of the helper, each with another value.
    pub fn again(&mut self, d: usize, times: u8, of: Pick) {
        Feature::CalledAgain.used();
        let names = self.names_of_helper();
        for time in 0..times {
            let pick = Pick(of.0.wrapping_add(2 * u16::from(time)));
            let signal = self.pick(d, pick);
            let signal = fit(signal, signal.width().min(WIDEST), pick);
            let mixed = mix(self.on(d), &names, signal);
            self.push(d, mixed);
        }
    }

    /// All calls in a part ask for the same names.
    fn names_of_helper(&mut self) -> Names {
        if self.helper.is_none() {
            let reads: Vec<String> =
                ["_read".to_owned()].into_iter().chain((1..60).map(|number| format!("_{number}_read"))).collect();
            let instance = format!("u{}_again", self.block.index);
            self.namer.remember(&instance);
            let [register, net] = ["again", "mixed"].map(|plain| self.namer.draw(plain, Kind::Inner));
            let memory = self.namer.draw_with("last", Kind::Inner, &reads);
            self.helper = Some(Names { register, net, memory, instance });
        }
        self.helper.clone().expect("it was just drawn")
    }
}

/// A net of a register, a memory and an instance.
fn mix(m: Module, names: &Names, signal: Signal) -> Signal {
    let was = m.pipe(&names.register, signal);
    let counter =
        m.instance(&names.instance, &Counter::new(5), CounterIn { restart: was.bit(0), enable: signal.ne(was) });
    let words = m.memory(&names.memory, 5, signal.width(), ReadUnderWrite::Old);
    words.write(counter.wraps, counter.count, signal);
    (words.read(counter.count) ^ was).named(&names.net)
}
