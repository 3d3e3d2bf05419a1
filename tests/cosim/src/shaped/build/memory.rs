//! Memories.

use super::*;
use tilewright_hdl::{Bits, ReadUnderWrite, index_width};

impl Builder<'_> {
    fn maybe_plain(&mut self, MaybePlain { pick, plain }: MaybePlain, width: u32, shape: Shape) -> NodeId {
        self.fit(pick, width, if plain { Shape::Plain } else { shape })
    }

    /// Both hold; each is plain or of that shape.
    fn both(&mut self, a: NodeId, b: NodeId, shape: Shape) -> NodeId {
        if self.build.shape(a) == self.build.shape(b) {
            return self.build.and(a, b);
        }
        let [a, b] = [a, b].map(|id| if self.build.shape(id) == shape { id } else { self.build.everywhere(id, shape) });
        self.build.and(a, b)
    }

    pub fn memory(&mut self, number: usize, clock: ClockId, spec: &Store) {
        let shape = self.shape(spec.shape);
        let other = self.spec.second_period.map_or(clock, |_| ClockId(1 - clock.0));
        let address_width = index_width(spec.depth.into());
        let clocks = spec.reads.iter().map(|read| match (read.asynchronous, read.crossing) {
            (true, _) => None,
            (false, crossing) => Some(if crossing { other } else { clock }),
        });
        let clocks: Vec<Option<ClockId>> = clocks.collect();
        let crosses = clocks.iter().flatten().any(|it| *it != clock);
        let policy = if crosses { ReadUnderWrite::Old } else { spec.policy };
        let writes = spec.writes.iter().map(|write| {
            let enable = self.maybe_plain(write.enable, 1, shape);
            (enable, self.maybe_plain(write.address, address_width, shape))
        });
        let writes: Vec<(NodeId, NodeId)> = writes.collect();
        let reads = spec.reads.iter().zip(&clocks).map(|(read, clock)| {
            let address = self.maybe_plain(read.address, address_width, shape);
            let mut enable = read.enable.filter(|_| clock.is_some()).map(|it| self.maybe_plain(it, 1, shape));
            let keeps_off = policy == ReadUnderWrite::Any && !self.spec.odd.reads_any;
            for &(write, _) in writes.iter().filter(|_| keeps_off && clock.is_some()) {
                let quiet = self.build.not(write);
                enable = Some(enable.map_or(quiet, |enable| self.both(enable, quiet, shape)));
            }
            (*clock, enable, address)
        });
        let reads: Vec<_> = reads.collect();
        for (name, width) in [("m", Some(spec.width)), ("twin", spec.twin)] {
            let Some(width) = width else { continue };
            let ends: Vec<String> = (0..reads.len()).map(|port| format!("_read{port}")).collect();
            let name = self.namer.legal_with(&format!("{name}{number}"), Kind::Inner, &ends);
            let id = self.build.memory(&name, spec.depth, width, shape);
            let index = id.0 as usize;
            self.build.module.memories[index].policy = policy;
            self.build.module.memories[index].contents = contents(&spec.contents, spec.depth, width, shape);
            for (&(clock, enable, address), end) in reads.iter().zip(&ends) {
                let data = self.build.read(id, clock.is_some(), address, enable);
                let port = self.build.module.memories[index].reads.last_mut().expect("there is one");
                port.clock = clock;
                if clock.is_some() {
                    self.build.named(&format!("{name}{end}"), data);
                }
                self.values.push(data);
            }
            for (port, (write, &(enable, address))) in spec.writes.iter().zip(&writes).enumerate() {
                let nothing = self.build.constant(width, 0, shape);
                self.build.write(id, enable, address, nothing);
                self.build.module.memories[index].writes[port].clock = clock;
                self.late.push(Late::Data { memory: index, port, data: write.data });
            }
        }
    }
}

fn contents(filling: &Filling, depth: u32, width: u32, shape: Shape) -> Contents {
    let random = |seed: u64, words: u8| {
        let mut numbers = Numbers(seed);
        let count = numbers.draw() % (u64::from(words) + 1);
        (0..count.min(depth.into())).map(|_| numbers.bits(width)).collect::<Vec<Bits>>()
    };
    match filling {
        Filling::Unknown => Contents::Unknown,
        Filling::Fill(word) => Contents::Fill(word.bits(width)),
        Filling::Words(words) => {
            Contents::Words(words.iter().take(depth as usize).map(|word| word.bits(width)).collect())
        }
        Filling::Each(seed, words) if shape.is_plain() => Contents::Words(random(*seed, *words)),
        Filling::Each(seed, words) => {
            Contents::Each((0..shape.lanes()).map(|lane| random(seed ^ u64::from(lane), *words)).collect())
        }
    }
}
