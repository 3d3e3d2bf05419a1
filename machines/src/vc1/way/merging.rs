//! The merger: the scan, the rounds in which the pixel passes the chain, and the swap of the global frame buffer.

use tilewright_rtl::vc1::Vc1;

use super::drawing::Drawing;
use super::round::Round;
use super::sequencer::{Scan, Sequencer};
use super::told::{At, Edge, Told};
use super::{Followed, Sim, compared, net, yes};

/// The models of the merger's units.
pub(super) struct Merging {
    followed: Followed,
    background: u64,
    processors: u32,
    sequencer: Sequencer,
    banks: Banks,
    /// The rounds in which the pixel is under way, the oldest first.
    rounds: Vec<Round>,
    /// The scan in the clock before.
    scan: Option<Scan>,
    /// By local frame buffer, the clock of the last swap.
    swapped: Vec<u64>,
    clock: u64,
    /// Frames that are commanded and not on display yet.
    frames: u32,
}

/// The swap of the global frame buffer's banks.
struct Banks {
    merge_clocks: u64,
    way: u32,
    frames: Vec<String>,
    /// The bank being filled, which changes with `shown`.
    filled: u32,
    /// The first local frame buffer that has not ended the frame.
    next: usize,
    since: u64,
    way_left: u32,
}

impl Merging {
    pub fn new(machine: &Vc1, followed: Followed, background: u64) -> Merging {
        let swap = machine.gfb_swap();
        let mut sequencer = Sequencer::new(machine);
        // The first edge after the reset comes before the first look.
        sequencer.edge(false);
        Merging {
            followed,
            background,
            processors: machine.processors,
            sequencer,
            banks: Banks {
                merge_clocks: swap.merge_clocks,
                way: swap.way,
                frames: (0..machine.processors).map(|it| format!("u_swap.u_lfb_swap[{it}].frame")).collect(),
                filled: 0,
                next: 0,
                since: 0,
                way_left: swap.way,
            },
            rounds: Vec::new(),
            scan: None,
            swapped: vec![0; machine.processors as usize],
            clock: 0,
            frames: 0,
        }
    }

    /// The host commands a frame.
    pub fn command(&mut self) {
        self.frames += 1;
    }

    /// A local frame buffer exchanged its buffers. The merger notices within a few clocks.
    pub fn swaps(&mut self, number: u32) {
        self.swapped[number as usize] = self.clock;
    }

    /// Looks at the units before the edge after `clock`.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, (drawing, told): (&mut [Drawing], &mut Told)) {
        self.clock = clock + 1;
        let edge = Edge::merge(clock + 1);
        let restart = net(sim, "u_gfb.u_sequencer.restart") == 1;
        let (seen, expected) = (Scan::seen(sim), self.sequencer.scan(restart));
        if seen != expected {
            told.check("sequencer", 0, false, || {
                let pairs = seen.values().into_iter().zip(expected.values());
                let values = pairs.map(|((name, seen), (_, expected))| compared(name, seen, expected)).collect();
                let at = At { unit: "sequencer of the global frame buffer".to_owned(), block: "gfb-sequencer", edge };
                at.step("scans the screen", values).on("u_gfb.u_sequencer.feed")
            });
        }
        self.sequencer.edge(restart);
        let before = self.scan.replace(seen);
        if before.is_some_and(|it| it.enable && !it.restart) {
            for round in &mut self.rounds {
                round.advance();
                round.look(sim, edge, (drawing, &self.swapped));
            }
        }
        if before.is_some_and(|it| it.restart) {
            // What is in the chain at a restart is not stored.
            self.rounds.drain(..).for_each(|round| round.tell(true, told));
        }
        let is_over = |round: &mut Round| round.is_over();
        self.rounds.extract_if(.., is_over).for_each(|round| round.tell(false, told));
        let is_fed = seen.enable && !seen.restart && seen.feed == self.followed.number;
        if is_fed && self.frames > 0 {
            let background = seen.blank.then_some(self.background);
            let mut round = Round::new(self.followed, self.processors, (self.banks.filled, background));
            round.look(sim, edge, (drawing, &self.swapped));
            self.rounds.push(round);
        }
        if self.banks.look(sim, edge, (seen.enable, restart), told) {
            self.frames = self.frames.saturating_sub(1);
        }
    }
}

impl Banks {
    /// Returns whether a frame goes on display.
    fn look(&mut self, sim: &mut Sim, edge: Edge, (enable, restart): (bool, bool), told: &mut Told) -> bool {
        while self.frames.get(self.next).is_some_and(|frame| net(sim, frame) != u64::from(self.filled)) {
            self.next += 1;
        }
        let all = self.next == self.frames.len();
        let is_merged = all && self.since >= self.merge_clocks && self.way_left == 0;
        let expected = is_merged && net(sim, "u_gfb.blanking") == 1;
        let swap = net(sim, "u_swap.u_gfb_swap.swap") == 1;
        if swap || swap != expected {
            told.check("banks", 0, swap, || {
                let values = vec![compared("swap", yes(swap), yes(expected))];
                let at = At { unit: "swap control of the global frame buffer".to_owned(), block: "gfb-swap", edge };
                at.step("puts the merged bank on display", values).on("u_swap.u_gfb_swap.swap")
            });
        }
        if swap != restart {
            told.check("banks wire", 0, false, || {
                let values = vec![compared("swap", yes(restart), yes(swap))];
                let at = At { unit: "swap wire of the global frame buffer".to_owned(), block: "vc1", edge };
                at.step("restarts the scan", values).on("u_gfb.u_sequencer.restart")
            });
        }
        if !all || swap {
            (self.since, self.way_left) = (0, self.way);
        } else {
            self.since += 1;
            self.way_left -= u32::from(enable && self.way_left > 0);
        }
        if swap {
            (self.filled, self.next) = (self.filled ^ 1, 0);
        }
        swap
    }
}
