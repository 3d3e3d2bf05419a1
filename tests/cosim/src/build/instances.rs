//! Steps that are instances of earlier parts, alone and in arrays.

use super::border::Pads;
use super::expression::binary;
use super::{Builder, PartBlock, PartIn, Ports, child_index, fit, narrow};
use crate::features::Feature;
use crate::spec::*;
use crate::stimulus::Numbers;
use tilewright_hdl::ir::Reduction;
use tilewright_hdl::*;

impl Builder<'_> {
    /// An earlier part, if there is one and room for it.
    pub fn child(&self, number: usize, part: Pick) -> Option<PartBlock> {
        let index = child_index(part, self.block.index)?;
        (self.block.size(number) > 0).then(|| PartBlock { index, ..self.block.clone() })
    }

    /// What is given to a port of that form, be it a code or not.
    fn pick_into(&mut self, d: usize, pick: Pick, form: Form) -> Signal {
        form.meaning.read(self.pick_fit(d, pick, form.width()))
    }

    /// The pool that a child's clock is: seen from the second clock, both are the second.
    fn outside(d: usize, child_domain: usize) -> usize {
        d.max(child_domain)
    }

    /// A name that nothing inside of the instance has: the part's number is above those of the parts below it.
    pub fn instance_name(&mut self, number: usize) -> String {
        let name = format!("u{}_{number}", self.block.index);
        self.namer.remember(&name);
        name
    }

    /// A clock that a child has another name for than the part has, and the handle of the one in its place.
    fn given(&self, d: usize, domain: usize, child: &PartBlock) -> Option<(Module, Clock)> {
        let named = child.clock(domain).filter(|_| [self.block, child].iter().any(|it| it.names_clocks()))?;
        Feature::NamesItsClocks.used();
        Some((self.on(Self::outside(d, domain)), named))
    }

    pub fn instance(&mut self, d: usize, number: usize, child: &PartBlock, inputs: &[Pick]) {
        let mut picks = inputs.iter().copied().chain(std::iter::repeat(Pick(1)));
        let [own, second] = [0, 1].map(|domain| {
            let feed =
                |input: &Input| self.pick_into(Self::outside(d, domain), picks.next().expect("endless"), input.form);
            child.ports_on(domain, feed)
        });
        let (name, module) = (self.instance_name(number), self.on(d));
        let into = PartIn { own, second, pads: Pads::default() };
        let clocks = [0, 1].map(|domain| self.given(d, domain, child));
        let out = in_place_of(clocks, || module.instance(&name, child, into));
        for (domain, signals) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            signals.values().into_iter().for_each(|signal| self.push(Self::outside(d, domain), signal));
        }
    }

    pub fn array(&mut self, d: usize, number: usize, child: &PartBlock, row: Row) {
        let module = self.on(d);
        let mut feeds = row.inputs.iter().copied().chain(std::iter::repeat((Feed::Broadcast, Pick(1))));
        let name = self.inner_name(&format!("u{}_{number}", self.block.index));
        let clocks = [0, 1].map(|domain| self.given(d, domain, child));
        let out = in_place_of(clocks, || {
            module.array(&name, row.lanes, child, |array| {
                let links = [array.link.clone(), array.second_link.clone()].map(Ports::values);
                let [own, second] = [0, 1].map(|domain| {
                    let mut links = links[domain].iter();
                    let feed = |input: &Input| {
                        let link = input.link.and_then(|link| Some((link, links.next()?.bits())));
                        let (feed, pick) = feeds.next().expect("endless");
                        let fed = self.feed(&row, Self::outside(d, domain), (feed, pick, input.form.width()), link);
                        input.form.meaning.read(fed)
                    };
                    child.ports_on(domain, feed)
                });
                PartIn { own, second, pads: Pads::default() }
            })
        });
        let mut gathers = row.outputs.iter().copied().chain(std::iter::repeat(Gather::Reduce(Reduction::Xor)));
        for (domain, lanes) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            for lanes in lanes.values() {
                let signal = gather(lanes.bits(), gathers.next().expect("endless"));
                self.push(Self::outside(d, domain), signal);
                self.rows[Self::outside(d, domain)].push(lanes.bits());
            }
        }
    }

    /// The lanes of another array, over and over, each put through the same function.
    fn one_by_one(&self, row: &Row, of: Signal, each: impl FnMut(Signal) -> Signal) -> Signal {
        let signals = of.to_vec().into_iter().map(each).collect::<Vec<_>>();
        stack(signals.into_iter().cycle().take(row.lanes as usize))
    }

    fn feed(
        &mut self,
        row: &Row,
        d: usize,
        (feed, pick, width): (Feed, Pick, u32),
        link: Option<(Link, Signal)>,
    ) -> Signal {
        match (feed, link) {
            (Feed::Back(reduction), Some((Link { registered: true, .. }, link))) => {
                gather(link, Gather::Reduce(reduction))
            }
            (Feed::Rotate(by), Some((Link { registered: true, .. }, link))) => {
                let lane = |lane: u32| link.lane((lane + u32::from(by)) % row.lanes);
                stack((0..row.lanes).map(lane).collect::<Vec<_>>())
            }
            (Feed::Other(other, by), _) if !self.rows[d].is_empty() => {
                let other = self.rows[d][usize::from(other.0) % self.rows[d].len()];
                if other.count() == row.lanes && other.width() == width {
                    let edge = self.pick_fit(d, pick, width);
                    return if by == 0 { other } else { other.shifted(i32::from(by), edge) };
                }
                self.one_by_one(row, other, |signal| fit(signal, width, pick))
            }
            (Feed::Lifted(op, other), _) if !self.rows[d].is_empty() => {
                let other = self.rows[d][usize::from(other.0) % self.rows[d].len()];
                let with = self.pick_fit(d, pick, width);
                self.one_by_one(row, other, |signal| binary(op, fit(signal, width, pick), with).trunc(width))
            }
            (Feed::LiftedTable(op, other), _) if !self.rows[d].is_empty() => {
                let other = self.rows[d][usize::from(other.0) % self.rows[d].len()];
                let constants = (0..other.count()).map(|lane| lit(width, Numbers(lane.into()).bits(width).limbs()[0]));
                let mut constants = constants.collect::<Vec<_>>().into_iter();
                self.one_by_one(row, other, |signal| {
                    let constant = constants.next().expect("one for each lane");
                    binary(op, fit(signal, width, pick), constant).trunc(width)
                })
            }
            (Feed::Link(by), Some((Link { registered, .. }, link))) => {
                let edge = self.pick_fit(d, pick, width);
                // What is not in a register may lead in one direction only.
                let back = registered && by % 2 == 1;
                link.shifted(if back { -row.by } else { row.by } * REACH[usize::from(by / 2) % REACH.len()], edge)
            }
            (Feed::Each, _) => {
                let picks = (0..row.lanes).map(|lane| Pick(pick.0.wrapping_add(7 * lane as u16)));
                let signals: Vec<_> = picks.map(|pick| self.pick_fit(d, pick, width)).collect();
                stack(signals)
            }
            (Feed::Index, _) => constants(bits(width).of(row.lanes), |lane| Bits::new(width, lane.into()).limbs()[0]),
            (Feed::Table(seed), _) => constants(bits(width).of(row.lanes), |lane| {
                let number = Numbers(seed.wrapping_add(lane.into())).draw();
                Bits::new(width, number).limbs()[0]
            }),
            _ => self.pick_fit(d, pick, width),
        }
    }
}

/// What `describe` describes, with each of two clocks in the place of the other one beside it.
fn in_place_of<R>([own, second]: [Option<(Module, Clock)>; 2], describe: impl FnOnce() -> R) -> R {
    let within = || match second {
        Some((m, clock)) => m.in_place_of(clock, describe),
        None => describe(),
    };
    match own {
        Some((m, clock)) => m.in_place_of(clock, within),
        None => within(),
    }
}

/// How far neighbours may be away.
const REACH: [i32; 8] = [1, 1, 1, 2, 3, 4, 7, 12];

/// How an array is fed and read.
pub struct Row<'a> {
    /// How many lanes.
    pub lanes: u32,
    /// Which way links lead.
    pub by: i32,
    /// What feeds the inputs.
    pub inputs: &'a [(Feed, Pick)],
    /// How the outputs are read.
    pub outputs: &'a [Gather],
}

fn gather(lanes: Signal, gather: Gather) -> Signal {
    match gather {
        Gather::Reduce(Reduction::And) => lanes.and_all(),
        Gather::Reduce(Reduction::Or) => lanes.or_all(),
        Gather::Reduce(Reduction::Xor) => lanes.xor_all(),
        Gather::Reduce(Reduction::Add) => lanes.sum(),
        Gather::Reduce(Reduction::Min) => lanes.minimum(),
        Gather::Reduce(Reduction::Max) => lanes.maximum(),
        Gather::Lane(index) => lanes.lane(index % lanes.count()),
        Gather::Concat => narrow(concat(&lanes.to_vec())),
    }
}
