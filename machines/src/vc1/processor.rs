//! A processing element, which runs its program clock by clock with the ports of its local frame buffer unit and of the bus.
//!
//! Source: VC1-PE, VC1-ACC, VC1-NET. The i860 waits until a port has taken an access, and then goes on computing. While it waits for the bus,
//! it takes packets from its queue and draws them. So the bus never waits for a queue whose processing element waits for the bus. While it
//! waits for a swap it does nothing.

use tilewright_rtl::swap::SwapState;

pub(crate) use self::ahead::Shared;
use super::clocks::{Class, Clocks};
use super::job::Views;
use super::program::{Access, Next, Phase, Settings, Sight, Task};
use super::words::{Message, Word};

/// Clocks of computation below which single steps are faster than looking ahead.
const FEW: u64 = 4;

/// A processing element in the middle of a frame.
pub(crate) struct Processor {
    settings: Settings,
    /// The result of geometry for each view.
    views: Views,
    /// Its program: each task has begun the next one, and the last one is running.
    tasks: Vec<Task>,
    now: Now,
    /// For each task that it began in the middle of a step, the step to resume.
    suspended: Vec<(usize, Now)>,
    /// The signals of the swap control in the coming clock.
    may: SwapState,
    /// The word that it offers to the bus.
    offered: Option<Word>,
    /// The word at the front of its queue.
    front: Option<Word>,
    /// The number of polygons that it has sent and not received yet.
    unseen: u32,
    tally: Tally,
    /// The frames that are over.
    frames: Vec<Tally>,
    /// Its logged activities, if they are logged.
    log: Option<Log>,
}

/// Consecutive classes of clocks, each with its number of clocks.
#[derive(Clone, Debug, Default)]
struct Log {
    runs: Vec<(Class, u64)>,
    /// The number of entries for frames that are over.
    over: usize,
}

/// The counts of a processing element in its frame so far, from swap to swap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Its clocks.
    pub clocks: Clocks,
    /// Pixels that the local frame buffer took.
    pub pixels: u64,
    /// Swaps because no page was free.
    pub overflows: u64,
    /// Polygons that it sent to all.
    pub broadcast: u64,
}

/// Its activity in a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Now {
    /// Computing for this number of clocks, at least 1, before an access or the next step.
    Computing(u64, Class, Option<Access>),
    /// At a port.
    Accessing(Access),
    Waiting,
}

/// The inputs of a processing element at an edge of its clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// Its local frame buffer takes the access.
    pub taken: bool,
    /// The bus takes the word that it offers.
    pub sent: bool,
    /// The swap control's signals from then on.
    pub may: SwapState,
    /// The word at the front of its queue from then on.
    pub front: Option<Word>,
}

impl Processor {
    pub fn new(settings: Settings, views: Views) -> Processor {
        let mut processor = Processor {
            settings,
            views,
            tasks: vec![Task::Frames(Phase::Swapped)],
            now: Now::Waiting,
            suspended: Vec::new(),
            may: SwapState::Clear,
            offered: None,
            front: None,
            unseen: 0,
            tally: Tally::default(),
            frames: Vec::new(),
            log: None,
        };
        processor.go_on();
        processor
    }

    /// The same processing element, which logs its activities.
    pub fn logged(self) -> Processor {
        Processor { log: Some(Log::default()), ..self }
    }

    /// Its consecutive activities in the frames that are over, with their clocks; empty unless it is [logged](Processor::logged).
    pub fn runs(&self) -> &[(Class, u64)] {
        self.log.as_ref().map_or(&[], |log| &log.runs[..log.over])
    }

    fn count(&mut self, class: Class, clocks: u64) {
        *self.tally.clocks.of(class) += clocks;
        if let Some(Log { runs, over }) = &mut self.log {
            let last = runs.len().saturating_sub(1);
            match runs.last_mut().filter(|(before, _)| *before == class && last >= *over) {
                Some((_, before)) => *before += clocks,
                None => runs.push((class, clocks)),
            }
        }
    }

    /// Its access to the local frame buffer in the coming clock.
    pub fn access(&self) -> Option<Access> {
        match self.now {
            Now::Accessing(access @ (Access::Clear(_) | Access::Draw(_))) if !self.is_halted() => Some(access),
            _ => None,
        }
    }

    /// Its word for the bus in the coming clock.
    pub fn offered(&self) -> Option<Word> {
        self.offered
    }

    /// Whether it takes a word from its queue in the coming clock, if there is one.
    pub fn receives(&self) -> bool {
        self.now == Now::Accessing(Access::Receive) && !self.is_halted()
    }

    /// Whether it has drawn its frame: its contribution to the sync line.
    pub fn done(&self) -> bool {
        let is_drawn = matches!(self.tasks[..], [Task::Frames(Phase::Drawn)]);
        is_drawn && self.now == Now::Waiting && self.may == SwapState::Draw && self.offered.is_none()
    }

    /// The number of polygons of its frame that it has not begun.
    pub fn polygons_left(&self, all: usize) -> usize {
        match &self.tasks[..] {
            [Task::Frames(Phase::Swapped | Phase::Cleared), ..] => all,
            [_, Task::Polygons(polygons), ..] => polygons.left(self.settings.number),
            _ => 0,
        }
    }

    /// Its counts of the frames that are over.
    pub fn frames(&self) -> &[Tally] {
        &self.frames
    }

    /// Whether it waits for a swap of its local frame buffer.
    pub fn is_halted(&self) -> bool {
        matches!(self.may, SwapState::Due | SwapState::Overflow)
    }

    /// Whether it has cleared its table, and nothing happens until a command comes.
    pub fn is_idle(&self) -> bool {
        let is_cleared = matches!(self.tasks[..], [Task::Frames(Phase::Cleared)]);
        is_cleared && self.now == Now::Waiting && self.may == SwapState::Draw && self.front.is_none()
    }

    /// Computes ahead, if it offers nothing to the bus and waits for no swap. Returns the number of edges that it skipped. It reaches accesses to
    /// its local frame buffer by itself; for everything else it has to see its ports.
    pub fn compute_ahead(&mut self) -> u64 {
        let clocks = match self.now {
            _ if self.offered.is_some() || self.is_halted() => 0,
            Now::Computing(left, _, Some(Access::Draw(_) | Access::Clear(_))) => left,
            Now::Computing(left @ FEW.., ..) => left - 1,
            _ => 0,
        };
        self.pass(clocks);
        clocks
    }

    /// Runs edges of its clock without new inputs. It may reach a port of its local frame buffer, which does not take the access during these
    /// edges.
    pub fn pass(&mut self, mut clocks: u64) {
        if let Now::Computing(left, class, Some(access @ (Access::Clear(_) | Access::Draw(_)))) = self.now
            && clocks >= left
            && !self.is_halted()
        {
            self.count(class, left);
            self.now = Now::Accessing(access);
            clocks -= left;
        }
        let class = match (self.may, &mut self.now) {
            (SwapState::Overflow, _) => Class::Overflow,
            (SwapState::Due, _) => Class::Swap,
            (_, Now::Waiting) => Class::Sync,
            (_, Now::Computing(left, class, _)) => {
                *left -= clocks;
                *class
            }
            (_, Now::Accessing(Access::Clear(_) | Access::Draw(_))) => Class::Stalled,
            (_, Now::Accessing(Access::Send(_) | Access::Receive)) => Class::Bus,
        };
        self.count(class, clocks);
    }

    /// Its activity in the coming clocks.
    pub fn now(&self) -> Now {
        self.now
    }

    /// The received words of the current packet.
    pub fn packet(&mut self) -> &mut Vec<u32> {
        let Some(Task::Receive { words }) = self.tasks.last_mut() else { unreachable!("a word is received by a task") };
        words
    }

    /// Notes that the bus has taken its word.
    pub fn taken_by_bus(&mut self) {
        self.offered = None;
    }

    /// Shows it that word at the front of its queue in the coming clock.
    pub fn see(&mut self, front: Option<Word>) {
        self.front = front;
    }

    /// The word at the front of its queue.
    pub fn front(&self) -> Option<Word> {
        self.front
    }

    /// The signals of the swap control in the coming clock.
    pub fn may(&self) -> SwapState {
        self.may
    }

    /// Runs an edge of its clock.
    pub fn edge(&mut self, edge: Edge) {
        let before = std::mem::replace(&mut self.may, edge.may);
        let arrived = std::mem::replace(&mut self.front, edge.front);
        let port_is_free = self.offered.is_none();
        if edge.sent {
            self.offered = None;
        }
        let class = match before {
            SwapState::Overflow => Class::Overflow,
            SwapState::Due => Class::Swap,
            SwapState::Clear | SwapState::Draw => self.clock(edge.taken, port_is_free, arrived),
        };
        self.count(class, 1);
        match (before, edge.may) {
            (SwapState::Overflow, SwapState::Clear) => {
                self.tally.overflows += 1;
                self.interrupt(Task::Clear { patch: 0 });
            }
            (SwapState::Due, SwapState::Clear) => {
                self.frames.push(std::mem::take(&mut self.tally));
                if let Some(Log { runs, over }) = &mut self.log {
                    *over = runs.len();
                }
                self.tasks = vec![Task::Frames(Phase::Swapped)];
                self.go_on();
            }
            _ => {}
        }
    }

    /// Runs a clock in which it does not wait for a swap. Returns its class.
    fn clock(&mut self, taken: bool, port_is_free: bool, arrived: Option<Word>) -> Class {
        match self.now {
            Now::Waiting => {
                self.go_on();
                Class::Sync
            }
            Now::Computing(left, class, access) => {
                self.compute(left - 1, class, access);
                class
            }
            Now::Accessing(Access::Clear(_) | Access::Draw(_)) if !taken => Class::Stalled,
            Now::Accessing(Access::Clear(_)) => {
                self.go_on();
                Class::Clearing
            }
            Now::Accessing(Access::Draw(_)) => {
                self.tally.pixels += 1;
                self.go_on();
                Class::Rasterization
            }
            Now::Accessing(Access::Send(word)) if port_is_free => {
                self.offered = Some(word);
                self.unseen += u32::from(word.last);
                self.tally.broadcast += u64::from(word.last);
                self.go_on();
                Class::Sending
            }
            Now::Accessing(Access::Send(_)) => {
                if self.may_serve() {
                    self.interrupt(Task::receive());
                }
                Class::Bus
            }
            Now::Accessing(Access::Receive) => match arrived {
                Some(word) => {
                    self.receive(word);
                    Class::Receiving
                }
                None => Class::Bus,
            },
        }
    }

    /// Whether it may receive a packet while its own packet waits for the bus. It must not be the packet that it is sending.
    pub fn may_serve(&self) -> bool {
        let is_begun = matches!(self.tasks.last(), Some(Task::Send { at: 2.., .. }));
        self.front.is_some_and(|word| {
            let is_own = Message::is_of(word.word, self.settings.number);
            !(is_own && is_begun && self.unseen == 0)
        })
    }

    fn receive(&mut self, word: Word) {
        let words = self.packet();
        words.push(word.word);
        if word.last {
            let message = Message::of_words(words);
            self.tasks.pop();
            match message {
                Some(Message::Command { frame }) => {
                    if let ([Task::Frames(phase @ Phase::Cleared)], Some(view)) =
                        (&mut self.tasks[..], self.views.of(frame))
                    {
                        *phase = Phase::Commanded(view);
                    }
                }
                Some(Message::Polygon { sender, vertices }) => {
                    self.unseen -= u32::from(sender == self.settings.number && self.unseen > 0);
                    let packet = self.views.set_up(&vertices, self.settings.size);
                    self.tasks.extend(packet.map(|packet| Task::share(&packet, &self.settings)));
                }
                // It is stored, and drawn as the command says.
                Some(Message::Scene { .. }) | None => {}
            }
        }
        self.go_on();
    }

    /// Begins a task in the middle of a step, which it resumes afterwards.
    fn interrupt(&mut self, task: Task) {
        self.suspended.push((self.tasks.len(), self.now));
        self.tasks.push(task);
        self.go_on();
    }

    /// Runs the current task to its next step.
    fn go_on(&mut self) {
        loop {
            if let Some((_, now)) = self.suspended.pop_if(|(tasks, _)| *tasks == self.tasks.len()) {
                self.now = now;
                return;
            }
            let sight = Sight { word: self.front.is_some(), may: self.may };
            let task = self.tasks.last_mut().expect("the first task is never over");
            match task.next(&sight, &self.settings) {
                Next::Step { clocks: 0, access: None, .. } => {}
                Next::Step { clocks, class, access } => {
                    // The last clock of an access is that at the port.
                    self.compute(clocks - u64::from(access.is_some()), class, access);
                    return;
                }
                Next::Begin(task) => self.tasks.push(task),
                Next::End => drop(self.tasks.pop()),
                Next::Wait => {
                    self.now = Now::Waiting;
                    return;
                }
            }
        }
    }

    fn compute(&mut self, clocks: u64, class: Class, access: Option<Access>) {
        match (clocks, access) {
            (1.., _) => self.now = Now::Computing(clocks, class, access),
            (0, Some(access)) => self.now = Now::Accessing(access),
            (0, None) => self.go_on(),
        }
    }
}

mod ahead;
#[cfg(test)]
mod tests;
