//! The sync line and the swaps of local frame buffers.

use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::Vc1;

use super::{Sim, net, pe};
use crate::looks::Looks;
use crate::told::{At, Told, compared, yes};

/// Clocks within which the line rises once all have drawn: the bus notes that its queues are empty.
const RISES: u32 = 8;

/// The guards of swaps.
pub(super) struct Swaps {
    merge_clocks: u64,
    patches: u32,
    processors: Vec<Local>,
    /// Whether the line was high in the last clock.
    was_high: bool,
    /// Clocks for which the line should have been high.
    late: u32,
}

/// A local frame buffer.
struct Local {
    /// Its last swap.
    swapped: Option<u64>,
    /// Entries of its table that were cleared since.
    cleared: u32,
    /// The line was high before the last edge.
    halted: bool,
    nets: [String; 4],
    /// The swap as it is said, and as it comes.
    looks: Looks,
}

impl Swaps {
    pub fn new(machine: &Vc1) -> Swaps {
        let local = |number| {
            let nets = [
                format!("u_swap.u_lfb_swap[{number}].swap"),
                format!("u_lfb[{number}].swap"),
                format!("u_swap.u_lfb_swap[{number}].ready"),
                format!("u_swap.u_lfb_swap[{number}].state"),
            ];
            let mut looks = Looks::default();
            looks.add("", nets[..2].iter().map(|it| &**it));
            Local { swapped: None, cleared: 0, halted: false, nets, looks }
        };
        Swaps {
            merge_clocks: machine.lfb_swap().merge_clocks,
            patches: machine.lfb.patches.count(),
            processors: (0..machine.processors).map(local).collect(),
            was_high: false,
            late: 0,
        }
    }

    /// A processor cleared an entry.
    pub fn clears(&mut self, processor: usize) {
        self.processors[processor].cleared += 1;
    }

    /// Looks at the line and at swaps before an edge. `done` is given if the bus has delivered all words and all programs have drawn.
    pub fn before(&mut self, sim: &mut Sim, clock: u64, done: bool, told: &mut Told) {
        for (number, local) in (0..).zip(&mut self.processors).filter(|(_, it)| it.halted) {
            local.looks.look(sim);
            let [said, came] = local.looks.from(0);
            if said != came {
                told.check("swap wire", number, false, || {
                    let at = At { unit: format!("swap wire of PE {number}"), block: "vc1", edge: pe(clock) };
                    at.step("swaps the buffers", vec![compared("swap", came, said)]).on(&local.nets[1])
                });
            }
        }
        let line = sim.get_u64(sim.o.line) == 1;
        let idle = done && sim.o.processors.clone().iter().all(|it| sim.get_u64(it.idle) == 1);
        let rises = line && !self.was_high;
        self.late = if idle && !line { self.late + 1 } else { 0 };
        if rises || self.late == RISES {
            self.line(sim, clock, [line, idle], told);
        }
        self.was_high = line;
    }

    /// The line rises, or should have.
    fn line(&self, sim: &mut Sim, clock: u64, [line, expected]: [bool; 2], told: &mut Told) {
        let edge = pe(clock);
        for (number, local) in (0..).zip(&self.processors) {
            let ready = net(sim, &local.nets[2]) == 1;
            if ready != line && line != expected {
                let at = At { unit: format!("swap control of PE {number}"), block: "lfb-swap", edge };
                let values = vec![compared("ready", yes(ready), yes(expected))];
                told.tell(at.step("says whether it may swap", values).on(&local.nets[2]));
            }
        }
        let values = vec![compared("line", yes(line), yes(expected))];
        let at = At { unit: "sync line".to_owned(), block: "sync-line", edge };
        told.tell(at.step("rises when all have drawn", values).on("u_swap.line"));
    }

    /// A processing element sees the state of its swap control change. Returns whether its buffers were exchanged.
    /// It is told if the followed patch has a page there.
    pub fn sees(
        &mut self,
        clock: u64,
        (number, has_page): (u32, bool),
        [before, after]: [SwapState; 2],
        told: &mut Told,
    ) -> bool {
        if before == after {
            return false;
        }
        let local = &mut self.processors[number as usize];
        let at = || At { unit: format!("swap control of PE {number}"), block: "lfb-swap", edge: pe(clock) };
        local.halted = matches!(after, SwapState::Due | SwapState::Overflow);
        match (before, after) {
            (SwapState::Due | SwapState::Overflow, SwapState::Clear) => {
                let waited = local.swapped.is_none_or(|swapped| clock - swapped >= self.merge_clocks);
                (local.swapped, local.cleared) = (Some(clock), 0);
                let values = vec![compared("T_m has passed since the last swap", "yes", yes(waited))];
                let does =
                    if before == SwapState::Due { "swaps at the end of the frame" } else { "swaps in an overflow" };
                if has_page || !waited {
                    told.check("swap", number, has_page, || at().step(does, values).on(&local.nets[0]));
                }
                return true;
            }
            (SwapState::Clear, SwapState::Draw) if local.cleared != self.patches => {
                let values = vec![compared("entries cleared", local.cleared, self.patches)];
                told.check("draw", number, false, || at().step("lets the processor draw", values).on(&local.nets[3]));
            }
            (SwapState::Draw, SwapState::Due) if !self.was_high => {
                let values = vec![compared("state", "due to swap", "draw")];
                told.check("due", number, false, || at().step("waits for the line", values).on(&local.nets[3]));
            }
            _ => {}
        }
        false
    }
}
