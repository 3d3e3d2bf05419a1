//! The simulated network, which composes the words of all nodes.

use tilewright_rtl::pixelflow::TRANSFER;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::compositor::Mode;
use tilewright_rtl::pixelflow::network::{Network, NetworkIn, NetworkOut};
use tilewright_sim::{EngineKind, Simulation};

use super::Words;
use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::{self, NetworkObserver};
use crate::tracer::Tracer;

/// One direction of the network.
pub(in crate::pixelflow) struct Way {
    sim: Simulation<NetworkIn, NetworkOut>,
    network: Network,
    chips: u32,
    /// Pixels of a chip.
    pixels: usize,
    /// The observer of a pixel that is followed.
    pub observer: Option<Box<NetworkObserver>>,
}

impl Way {
    /// A network of that number of nodes.
    pub fn new(array: &PixelArray, nodes: usize, engine: EngineKind) -> Result<Way, Error> {
        let network = Network { nodes: nodes as u32, port: array.network_port() };
        let mut sim = Simulation::at(&network, TRANSFER)?.on(engine);
        for node in sim.i.nodes.clone() {
            sim.set(node.mode, Mode::Forward as u64);
            sim.set(node.sends, false);
            sim.set(node.first, false);
        }
        sim.try_reset()?;
        Ok(Way { sim, network, chips: array.chips(), pixels: array.pixels() as usize, observer: None })
    }

    /// Begins a waveform of it, if the simulation of that number is traced.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer, number: usize) -> Result<(), Error> {
        tracer.attach(&following::network(number), (&self.network, TRANSFER), &mut self.sim)
    }

    /// Sends words from the first node that has some to a node after all of these; the others compose. Returns the words at that node.
    ///
    /// Node number n sends its words n ticks later than the first one. A pixel that is followed is looked at if the tick of the first byte is given.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn send(&mut self, words: &[(usize, &Words)], to: usize, followed: Option<Ticks>) -> Result<Words, Error> {
        let mut observer = self.observer.as_mut().filter(|_| followed.is_some());
        if let (Some(observer), Some(from)) = (&mut observer, followed) {
            observer.begin(from);
        }
        let nodes = self.sim.i.nodes.clone();
        let (first, length) = (words[0].0, words[0].1.len());
        nodes.iter().for_each(|node| self.sim.set(node.mode, Mode::Forward as u64));
        for (number, _) in words {
            let mode = if *number == first { Mode::Load } else { Mode::Composite };
            self.sim.set(nodes[*number].mode, mode as u64);
        }
        self.sim.set(nodes[to].mode, Mode::Unload as u64);
        let mut came = Words::new(self.chips, length);
        let target = self.sim.o.nodes[to];
        // Until the last byte has left the network.
        for tick in 0..length + nodes.len() - first {
            for (number, own) in words {
                if let Some(bytes) = tick.checked_sub(number - first).and_then(|turn| own.get(turn)) {
                    self.sim.set(nodes[*number].own, bytes);
                }
            }
            self.sim.set(nodes[first].sends, tick < length);
            self.sim.set(nodes[first].first, tick < self.pixels);
            if self.sim.get_u64(target.unloaded) == 1 {
                came.push(self.sim.limbs(target.bytes));
            }
            if let Some(observer) = &mut observer {
                observer.look(&mut self.sim, tick as Ticks);
            }
            let stepped = self.sim.try_step().map_err(Error::from);
            if let (Err(error), Some(observer)) = (&stepped, &mut observer) {
                observer.fail(tick as Ticks, error);
            }
            stepped?;
        }
        if let Some(observer) = observer {
            observer.end(length as Ticks);
        }
        match came.len() == length {
            true => Ok(came),
            false => {
                let (unit, signal) = ("the network".to_owned(), "the number of bytes that arrive");
                let clock = (length + nodes.len() - first) as u64;
                Err(Error::Differs { unit, signal, clock, seen: came.len() as u64, expected: length as u64 })
            }
        }
    }

    /// For each pixel, chip by chip, the number of the first of these nodes that sent the received word.
    ///
    /// # Panics
    /// None of them sent it.
    pub fn winners(&self, own: &[(usize, &Words)], came: &Words) -> Vec<u16> {
        let bytes = came.len() / self.pixels;
        let is_of = |words: &Words, chip: u32, pixel: usize| {
            (0..bytes).map(|byte| byte * self.pixels + pixel).all(|at| words.byte(at, chip) == came.byte(at, chip))
        };
        let winner = |(chip, pixel)| own.iter().position(|(_, words)| is_of(words, chip, pixel));
        let pixels = (0..self.chips).flat_map(|chip| (0..self.pixels).map(move |pixel| (chip, pixel)));
        pixels.map(|pixel| winner(pixel).expect("the least word is one of them") as u16).collect()
    }
}
