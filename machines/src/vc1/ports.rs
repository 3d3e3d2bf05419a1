//! The ports of the hardware: those of the processing elements, and that of the host to the bus.

use tilewright_sim::Port;

use super::hardware::Hardware;
use super::processor::Processor;
use super::program::Access;
use super::words::Word;

/// The signals at the ports of a processing element.
#[derive(Clone, Default)]
pub(super) struct Ports {
    pub access: Option<Access>,
    pub sends: Option<Word>,
    pub receives: bool,
    pub done: bool,
    /// Whether the local frame buffer takes the access at the coming edge, and the bus the word.
    pub taken: bool,
    pub sent: bool,
}

impl Hardware {
    /// Puts the requests of a processing element at its ports for the coming clock.
    pub(super) fn present(&mut self, number: usize, processor: &Processor) {
        let port = self.sim.i.processors[number];
        let access = processor.access();
        let before = std::mem::replace(&mut self.ports[number].access, access);
        if before != access {
            match access {
                Some(Access::Draw(pixel)) => {
                    self.sim.set(port.request.x, pixel.x);
                    self.sim.set(port.request.y, pixel.y);
                    self.sim.set(port.request.word, pixel.word);
                }
                Some(Access::Clear(patch)) => self.sim.set(port.clear.patch, patch),
                _ => {}
            }
            self.sim.set(port.request.valid, matches!(access, Some(Access::Draw(_))));
            self.sim.set(port.clear.valid, matches!(access, Some(Access::Clear(_))));
        }
        let sends = processor.offered();
        if std::mem::replace(&mut self.ports[number].sends, sends) != sends {
            self.offer(port.sends.valid, port.sends.word, port.sends.last, sends);
        }
        let receives = processor.receives();
        if std::mem::replace(&mut self.ports[number].receives, receives) != receives {
            self.sim.set(self.sim.o.processors[number].received.ready, receives);
        }
        let done = processor.done();
        if std::mem::replace(&mut self.ports[number].done, done) != done {
            self.sim.set(port.done, done);
        }
    }

    fn offer(&mut self, valid: Port, word: Port, last: Port, offered: Option<Word>) {
        if let Some(offered) = offered {
            self.sim.set(word, offered.word);
            self.sim.set(last, offered.last);
        }
        self.sim.set(valid, offered.is_some());
    }

    /// Whether the local frame buffer takes the access at its port at the coming edge.
    pub(super) fn takes(&mut self, processor: usize) -> bool {
        let port = self.sim.i.processors[processor];
        match self.ports[processor].access {
            Some(Access::Draw(_)) => self.flag(port.request.ready),
            Some(Access::Clear(_)) => self.flag(port.clear.ready),
            _ => false,
        }
    }

    /// Whether the bus takes the word that a processing element offers at the coming edge.
    pub(super) fn sends(&mut self, processor: usize) -> bool {
        self.ports[processor].sends.is_some() && self.flag(self.sim.i.processors[processor].sends.ready)
    }

    /// Whether the bus has taken the host's word, so that another one may follow.
    pub fn takes_command(&self) -> bool {
        self.command.is_none()
    }

    /// Offers a word of the host to the bus, or none.
    pub fn command(&mut self, word: Option<Word>) {
        self.command = word;
    }

    /// Puts the host's word at its port for the coming clock. The host keeps the sync line low until its words are sent.
    pub(super) fn present_command(&mut self) {
        let word = self.command;
        let before = std::mem::replace(&mut self.command_port, word);
        if before != word {
            let port = self.sim.i.command;
            self.offer(port.valid, port.word, port.last, word);
            self.sim.set(self.sim.i.ready, word.is_none());
        }
    }
}
