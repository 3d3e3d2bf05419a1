//! Steps that work on many lanes.

use super::form::Colour;
use super::{Builder, Kind, narrow};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

/// As the work says, signed or not.
fn read(work: &LaneWork, signal: Signal) -> Signal {
    if work.signed { signal.signed() } else { signal }
}

fn turned(x: Signal, columns: u32) -> Signal {
    match x.shape() {
        Shape::Grid(..) => x.columns().sum() - x.columns().lane(0),
        _ => x.to_columns(columns) + x.take(columns, |i| i / columns).to_rows(x.count()),
    }
}

fn combined(a: Signal, b: Signal) -> Signal {
    a + !b
}

bundle! {
    /// A lane, and which it is.
    struct Found<T> { value: T, lane: T }
}

/// The smallest lane, beside the first that is so.
fn least(x: Signal) -> Signal {
    Feature::TreeOfRecords.used();
    let numbers = constants(below(x.count()).of(x.shape()), u64::from);
    let found = tree(Found { value: x, lane: numbers }, |a, b| mux(b.value.lt(a.value), b, a));
    cat![found.lane, found.value.bits()]
}

impl Builder<'_> {
    pub fn lanes(&mut self, d: usize, number: usize, work: &LaneWork) -> Signal {
        let LaneWork { width, lanes, columns, .. } = *work;
        let mut parts = Vec::new();
        for lane in 0..lanes as usize {
            let pick = work.start[lane % work.start.len()];
            parts.push(self.pick_fit(d, pick, width));
        }
        let mut x = read(work, stack(parts));
        let mut before = x;
        for (index, step) in work.works.iter().enumerate() {
            let now = x;
            x = self.work(d, (number, index), work, step, (x, before));
            before = now;
        }
        // A row again.
        let x = if let Shape::Grid(..) = x.shape() { turned(x, columns) } else { x };
        let level = |level: u32| level.to_string();
        let levels: Vec<String> = (1..=6).map(level).collect();
        let plain = match work.end {
            End::Sum => x.sum(),
            End::Minimum => x.minimum(),
            End::Maximum => x.maximum(),
            End::Pick(index) => x.pick(self.pick_fit(d, index, 3)),
            End::Pack => narrow(x.pack()),
            End::Tree => tree(x, combined),
            End::Stages => {
                let name = self.namer.draw_with(&format!("t{number}_"), Kind::Inner, &levels);
                self.on(d).tree_of_stages(&name, x, combined)
            }
            End::Least => narrow(least(x)),
        };
        plain.bits()
    }

    fn work(
        &mut self,
        d: usize,
        at: (usize, usize),
        work: &LaneWork,
        step: &Work,
        (x, before): (Signal, Signal),
    ) -> Signal {
        let plain = |this: &mut Self, pick: Pick| read(work, this.pick_fit(d, pick, work.width));
        let lane = read(work, lit(work.width, 0));
        match step {
            Work::Add(with) => x + plain(self, *with),
            Work::Number(times) => {
                let number = |lane: u32| Bits::new(work.width, times.wrapping_mul(lane.into())).limbs()[0];
                x ^ read(work, constants(bits(work.width).of(x.shape()), number))
            }
            Work::Before if before.shape() == x.shape() => x - before,
            Work::Before => !x,
            Work::Least(with) => {
                let with = plain(self, *with);
                mux(x.lt(with), x, with)
            }
            Work::Invert(condition) => mux(self.pick_fit(d, *condition, 1), !x, x),
            Work::Shifted(by, edge) => {
                let edge = plain(self, *edge);
                match (x.shape(), by % 2) {
                    (Shape::Grid(..), 0) => x.rows().shifted(*by, edge),
                    (Shape::Grid(..), _) => x.columns().shifted(*by, edge),
                    _ => x.shifted(*by, edge),
                }
            }
            Work::Reversed if matches!(x.shape(), Shape::Grid(..)) => x.rows().reversed(),
            Work::Reversed => x.reversed(),
            Work::Take(first) if matches!(x.shape(), Shape::Grid(..)) => {
                Feature::TakeOr.used();
                x.columns().take_or(work.columns, |i| 2 * i + i32::from(*first % 3), lane)
            }
            Work::Take(first) if first % 3 == 0 => {
                Feature::TakeOr.used();
                x.take_or(work.lanes, |i| 3 * i - i32::from(*first % 4), lane)
            }
            Work::Take(first) => {
                Feature::Interleave.used();
                interleave([x, !x]).take(work.lanes, |i| 2 * i + i32::from(*first % 2))
            }
            Work::Turn => turned(x, work.columns),
            Work::Hold { reset, initial, count } => {
                let name = self.inner_name(&format!("g{}_{}", at.0, at.1));
                let layout = bits(work.width).of(x.shape());
                let mut held = self.on(d).reg(&name, if work.signed { layout.signed() } else { layout });
                if let Some(initial) = initial {
                    Feature::InitialOfLanes.used();
                    held = held.initial(initial.bits(work.width));
                }
                if let Some(reset) = reset {
                    Feature::ResetEach.used();
                    held = held.reset_each((0..x.shape().lanes()).map(|lane| match lane % 2 {
                        0 => reset.bits(work.width),
                        _ => reset.bits(work.width).not(),
                    }));
                }
                held.when(x.bit(0), x).when(self.pick_fit(d, *count, 1), *held + *held);
                *held
            }
            Work::Colours { initial, chosen } => {
                Feature::CodeLanes.used();
                let name = self.inner_name(&format!("v{}_{}", at.0, at.1));
                let held = self.on(d).reg(&name, one_of::<Colour>().of(x.shape()));
                let held = match initial {
                    Some(initial) => {
                        Feature::InitialOfLanes.used();
                        held.initial(Colour::of(u64::from(*initial)))
                    }
                    None => held.reset(Colour::Green),
                };
                let codes = Meaning::Code.made_of(x.bits().zext(work.width.max(3)).trunc(3));
                held.when(x.bit(0), codes);
                let chosen = plain(self, *chosen);
                Feature::ChooseByLanes.used();
                let value: Signal = held.choose(|colour: Colour| match colour {
                    Colour::Red | Colour::White => x,
                    Colour::Green => !x,
                    Colour::Blue => x + chosen,
                    Colour::Black => x - chosen,
                });
                mux(held.is(Colour::Blue), value, x)
            }
            Work::Remember { address, own } => {
                let name = self.namer.draw_with(&format!("h{}_{}", at.0, at.1), Kind::Inner, &["_read".to_owned()]);
                let layout = bits(work.width).of(x.shape());
                let memory = self.on(d).memory(&name, 4, layout, ReadUnderWrite::Old);
                let memory = memory.fill(Bits::zero(work.width));
                let (address, enable) = (self.pick_fit(d, *address, 2), x.bit(0));
                let numbers = x.bits().part(0, 1).repeat(2) ^ address;
                let x = x.bits();
                if *own {
                    memory.write(enable, numbers, x);
                    read(work, memory.read(numbers))
                } else {
                    memory.write(enable, address, x);
                    read(work, memory.read_async(address))
                }
            }
        }
    }
}
