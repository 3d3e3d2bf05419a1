//! Steps that are instances of earlier parts, alone and in arrays.

use super::{Builder, PartBlock, PartIn, PartOut, narrow};
use crate::spec::*;
use tilewright_hdl::ir::Reduction;
use tilewright_hdl::*;

impl Builder<'_> {
    /// An earlier part.
    pub fn child(&self, part: Pick) -> Option<PartBlock> {
        let index = usize::from(part.0).checked_rem(self.block.index)?;
        Some(PartBlock { index, ..self.block.clone() })
    }

    /// The pool that a child's clock is: seen from the second clock, both are the second.
    fn outside(d: usize, child_domain: usize) -> usize {
        d.max(child_domain)
    }

    /// A name that nothing inside of the instance has: the part's number is above those of the parts below it.
    fn instance_name(&self, number: usize) -> String {
        format!("u{}_{number}", self.block.index)
    }

    pub fn instance(&mut self, d: usize, number: usize, part: Pick, inputs: &[Pick]) {
        let Some(child) = self.child(part) else { return };
        let mut picks = inputs.iter().copied().chain(std::iter::repeat(Pick(1)));
        let [own, second] = [0, 1].map(|domain| {
            let feed =
                |input: &Input| self.pick_fit(Self::outside(d, domain), picks.next().expect("endless"), input.width);
            child.inputs_on(domain).map(feed).collect()
        });
        let out = self.on(d).instance(&self.instance_name(number), &child, PartIn { own, second });
        for (domain, signals) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            signals.into_iter().for_each(|signal| self.push(Self::outside(d, domain), signal));
        }
    }

    pub fn array(&mut self, d: usize, number: usize, child: &PartBlock, row: Row) {
        let module = self.on(d);
        let mut feeds = row.inputs.iter().copied().chain(std::iter::repeat((Feed::Broadcast, Pick(1))));
        let name = self.instance_name(number);
        let out = module.array(&name, row.lanes, child, |array| {
            let links = [array.out.link.clone(), array.out.second_link.clone()];
            let [own, second] = [0, 1].map(|domain| {
                let mut links = links[domain].iter();
                let feed = |input: &Input| {
                    let link = input.link.and_then(|_| links.next());
                    let (feed, pick) = feeds.next().expect("endless");
                    self.feed(&array, &row, Self::outside(d, domain), (feed, pick, input.width), link)
                };
                child.inputs_on(domain).map(feed).collect()
            });
            PartIn { own, second }
        });
        let mut gathers = row.outputs.iter().copied().chain(std::iter::repeat(Gather::Reduce(Reduction::Xor)));
        for (domain, lanes) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            for lanes in lanes {
                let signal = gather(lanes, gathers.next().expect("endless"));
                self.push(Self::outside(d, domain), signal);
            }
        }
    }

    fn feed(
        &mut self,
        array: &Array<PartOut<Lanes>>,
        row: &Row,
        d: usize,
        (feed, pick, width): (Feed, Pick, u32),
        link: Option<&Lanes>,
    ) -> Lanes {
        match (feed, link) {
            (Feed::Link(by), Some(link)) => {
                let edge = self.pick_fit(d, pick, width);
                link.shifted(row.by * (1 + i32::from(by % 3)), edge)
            }
            (Feed::Each, _) => {
                let picks = (0..row.lanes).map(|lane| Pick(pick.0.wrapping_add(7 * lane as u16)));
                let signals: Vec<_> = picks.map(|pick| self.pick_fit(d, pick, width)).collect();
                array.each(signals)
            }
            (Feed::Index, _) => array.constants(width, |lane| Bits::new(width, lane.into()).limbs()[0]),
            (Feed::Broadcast | Feed::Link(_), _) => {
                let signal = self.pick_fit(d, pick, width);
                array.all(&signal)
            }
        }
    }
}

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

fn gather(lanes: Lanes, gather: Gather) -> Signal {
    match gather {
        Gather::Reduce(Reduction::And) => lanes.and_all(),
        Gather::Reduce(Reduction::Or) => lanes.or_all(),
        Gather::Reduce(Reduction::Xor) => lanes.xor_all(),
        Gather::Reduce(Reduction::Add) => lanes.sum(),
        Gather::Lane(index) => lanes.lane(index % lanes.count()),
        Gather::Concat => narrow(concat(&lanes.to_vec())),
    }
}
