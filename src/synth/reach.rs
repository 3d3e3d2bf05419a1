//! Which clock the flip-flop has that is nearest to a wire.

use super::netlist::{Bit, Cell, Netlist};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The cells at each wire.
pub struct Reach<'a> {
    drivers: BTreeMap<u64, Vec<&'a Cell>>,
    readers: BTreeMap<u64, Vec<&'a Cell>>,
    /// The clock's pin at flip-flops.
    clock: &'a str,
}

/// The most wires that are looked at for a flip-flop.
const MOST_WIRES: usize = 10_000;

impl<'a> Reach<'a> {
    pub fn of(netlist: &'a Netlist, clock: &'a str) -> Reach<'a> {
        let mut reach = Reach { drivers: BTreeMap::new(), readers: BTreeMap::new(), clock };
        for cell in netlist.cells.values() {
            for (pin, wire) in wires(cell) {
                let at = if is_output(cell, pin) { &mut reach.drivers } else { &mut reach.readers };
                at.entry(wire).or_default().push(cell);
            }
        }
        reach
    }

    /// The clock of the nearest flip-flop behind a wire, or before it.
    pub fn clock(&self, wire: u64, behind: bool) -> Option<&'a Bit> {
        let cells = if behind { &self.readers } else { &self.drivers };
        let (mut known, mut queue) = (BTreeSet::from([wire]), VecDeque::from([wire]));
        while let Some(wire) = queue.pop_front() {
            for cell in cells.get(&wire).into_iter().flatten() {
                if let Some(clock) = cell.connections.get(self.clock).and_then(|bits| bits.first()) {
                    return Some(clock);
                }
                let onward = wires(cell).filter(|(pin, _)| is_output(cell, pin) == behind).map(|(_, wire)| wire);
                queue.extend(onward.filter(|wire| known.insert(*wire)));
            }
            if known.len() > MOST_WIRES {
                return None;
            }
        }
        None
    }
}

fn wires(cell: &Cell) -> impl Iterator<Item = (&str, u64)> {
    let bits = cell.connections.iter().flat_map(|(pin, bits)| bits.iter().map(move |bit| (pin.as_str(), bit)));
    bits.filter_map(|(pin, bit)| if let Bit::Wire(wire) = bit { Some((pin, *wire)) } else { None })
}

fn is_output(cell: &Cell, pin: &str) -> bool {
    cell.port_directions.get(pin).is_some_and(|way| way == "output")
}
