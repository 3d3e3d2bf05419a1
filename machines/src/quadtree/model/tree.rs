//! A tree of units in time. Its arbiters take what comes first, so the model steps through clocks. It skips clocks in which nothing happens.

use super::division::{Course, Division, Unit, Work};
use super::line::{self, Stage};
use super::queue::Queue;
use super::record::{Counts, Visit};

/// A tree of two levels or more.
pub(super) struct Tree {
    /// Level by level; the quarters of number v's windows go to numbers 4 v + 1 to 4 v + 4.
    nodes: Vec<Node>,
    /// The arbiters of all nodes except the last level's.
    arbiters: Vec<Arbiter>,
    /// The node whose window leaves the tree, and the clock of that.
    going: Option<(usize, u64)>,
    /// The clock after the last simulated one.
    clock: u64,
    /// Whether something was sent or ended in the last clock, so that something may follow in the next one.
    has_moved: bool,
}

/// A unit of a tree, with its queue.
struct Node {
    queue: Queue<Work>,
    /// The clock in which a window last left the queue.
    left: Option<u64>,
    unit: Unit,
    held: Option<Held>,
}

/// A window that a unit has.
struct Held {
    division: Division,
    /// The quarter that is offered from the division's clock on.
    quarter: Option<Work>,
}

/// A round-robin arbiter of four.
#[derive(Clone, Default)]
struct Arbiter {
    /// The one that was served last.
    last: Option<usize>,
    /// The one that is shown until it is served.
    chosen: Option<usize>,
}

impl Tree {
    /// A tree of several levels, the first of which is `level`, with queues of that depth.
    pub fn new(level: u32, levels: u32, depth: usize, keeps_visits: bool) -> Tree {
        let nodes = (0..levels).flat_map(|below| (0..1 << (2 * below)).map(move |_| level + below));
        let nodes: Vec<Node> = nodes.map(|level| Node::new(depth, Unit::new(level, 1, keeps_visits))).collect();
        let arbiters = vec![Arbiter::default(); nodes.len() / 4];
        Tree { nodes, arbiters, going: None, clock: 0, has_moved: false }
    }

    /// As [`line::take`].
    pub fn take(&mut self, behind: &mut [Stage], course: &Course, work: Work, offered: u64) -> u64 {
        let mut clock = offered;
        while self.nodes[0].queue.is_full() && self.step(behind, course) {
            clock = clock.max(self.clock);
        }
        self.nodes[0].queue.push(work, clock);
        clock
    }

    /// As [`line::finish`].
    pub fn finish(&mut self, behind: &mut [Stage], course: &Course) {
        while self.step(behind, course) {}
    }

    /// The first clock after all its work.
    pub fn idle(&self) -> u64 {
        self.nodes.iter().map(|node| node.unit.end() + 1).max().unwrap_or(0)
    }

    /// Passes on its counters.
    pub fn hand_over(self, counts: &mut [Counts], visits: &mut Vec<Visit>) {
        self.nodes.into_iter().for_each(|node| node.unit.hand_over(counts, visits));
    }

    /// Simulates the next clock in which something may happen; false if there is none.
    fn step(&mut self, behind: &mut [Stage], course: &Course) -> bool {
        let Some(clock) = self.next_clock() else { return false };
        self.clock = clock + 1;
        self.choose(clock);
        if self.going.is_none() {
            self.going = self.chosen().map(|(node, work)| (node, line::take(behind, course, work, clock)));
        }
        // Each unit sees whether the next ones had space before this clock.
        self.has_moved = false;
        for node in (0..self.nodes.len()).rev() {
            let moves = self.send(node, clock);
            let takes = self.nodes[node].end_and_take(course, clock);
            self.has_moved |= moves | takes;
        }
        true
    }

    fn next_clock(&self) -> Option<u64> {
        if self.has_moved {
            return Some(self.clock);
        }
        let goes = self.going.map(|(_, clock)| clock);
        self.nodes.iter().filter_map(Node::next_clock).chain(goes).filter(|clock| *clock >= self.clock).min()
    }

    /// Arbiters that show nothing choose one of the offers, those of the last level first.
    fn choose(&mut self, clock: u64) {
        for number in (0..self.arbiters.len()).rev() {
            if self.arbiters[number].chosen.is_none() {
                let next = self.arbiters[number].turns().find(|branch| self.offers(4 * number + 1 + branch, clock));
                self.arbiters[number].chosen = next;
            }
        }
    }

    /// Whether a window of the last level comes out of a branch.
    fn offers(&self, node: usize, clock: u64) -> bool {
        match self.arbiters.get(node) {
            Some(arbiter) => arbiter.chosen.is_some(),
            None => self.nodes[node].offered(clock).is_some(),
        }
    }

    /// The window that all arbiters have chosen, and its node.
    fn chosen(&self) -> Option<(usize, Work)> {
        let mut node = 0;
        while let Some(arbiter) = self.arbiters.get(node) {
            node = 4 * node + 1 + arbiter.chosen?;
        }
        Some((node, self.nodes[node].held.as_ref()?.quarter?))
    }

    /// Sends the quarter that a node offers, if it is taken.
    fn send(&mut self, node: usize, clock: u64) -> bool {
        let Some((branch, work)) = self.nodes[node].offered(clock) else { return false };
        if node < self.arbiters.len() {
            let next = &mut self.nodes[4 * node + 1 + branch];
            if !next.had_room(clock) {
                return false;
            }
            next.queue.push(work, clock);
        } else {
            if self.going != Some((node, clock)) {
                return false;
            }
            self.going = None;
            let mut node = node;
            while node > 0 {
                node = (node - 1) / 4;
                self.arbiters[node].last = self.arbiters[node].chosen.take();
            }
        }
        self.nodes[node].sent(clock);
        true
    }
}

impl Node {
    fn new(depth: usize, unit: Unit) -> Node {
        Node { queue: Queue::new(depth), left: None, unit, held: None }
    }

    /// The next clock in which it offers a quarter, ends or takes a window, if it does not wait for the others.
    fn next_clock(&self) -> Option<u64> {
        match &self.held {
            Some(held) => Some(held.division.clock()),
            None => self.queue.oldest().map(|(_, since)| since + 1),
        }
    }

    /// The quarter that is offered in a clock, and its number.
    fn offered(&self, clock: u64) -> Option<(usize, Work)> {
        let held = self.held.as_ref().filter(|held| held.division.clock() <= clock)?;
        held.quarter.map(|quarter| (held.division.number(), quarter))
    }

    /// Whether its queue had space before something left it in that clock.
    fn had_room(&self, clock: u64) -> bool {
        self.queue.len() + usize::from(self.left == Some(clock)) < self.queue.depth()
    }

    /// Sends the offered quarter.
    fn sent(&mut self, clock: u64) {
        if let Some(Held { division, quarter }) = &mut self.held {
            division.send(clock);
            *quarter = division.next();
        }
    }

    /// Ends a division in its last clock, and takes the next window if the unit has none. Returns whether it did anything.
    fn end_and_take(&mut self, course: &Course, clock: u64) -> bool {
        let ended = self.held.take_if(|held| held.quarter.is_none() && held.division.clock() <= clock);
        if let Some(Held { division, .. }) = &ended {
            self.unit.count(division);
        }
        let is_there = self.queue.oldest().is_some_and(|(_, since)| since < clock);
        if self.held.is_none() && is_there {
            self.left = Some(clock);
            self.held = self.queue.pop().map(|(work, _)| {
                let mut division = Division::new(course, work, clock);
                let quarter = division.next();
                Held { division, quarter }
            });
            return true;
        }
        ended.is_some()
    }
}

impl Arbiter {
    /// All four, beginning after the one that was served last.
    fn turns(&self) -> impl Iterator<Item = usize> + use<> {
        let first = self.last.map_or(0, |last| last + 1);
        (first..4).chain(0..first)
    }
}
