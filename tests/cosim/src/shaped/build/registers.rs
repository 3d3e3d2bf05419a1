//! Registers, and what holds several values together.

use super::*;

impl Builder<'_> {
    /// A register that keeps what it holds so far.
    pub fn started(&mut self, number: usize, clock: ClockId, start: Start) -> NodeId {
        let Start { width, reset, initial, .. } = start;
        let shape = self.shape(start.shape);
        let name = self.name(&format!("r{number}"), Kind::Inner);
        let each = |seed| {
            let mut numbers = Numbers(seed);
            (0..shape.lanes()).map(|_| numbers.bits(width)).collect()
        };
        let reset = match reset {
            Reset::Keeps => None,
            Reset::Same(pattern) => Some(Init::Same(pattern.bits(width))),
            Reset::Each(seed) if shape.is_plain() => Some(Init::Same(Numbers(seed).bits(width))),
            Reset::Each(seed) => Some(Init::Each(each(seed))),
        };
        let register = self.build.register(&name, width, shape, reset);
        let made = self.build.module.registers.last_mut().expect("there is one");
        made.clock = clock;
        if let Some(initial) = initial {
            Feature::InitialInShapes.used();
            made.initial = Some(initial.bits(width));
        }
        register
    }

    pub fn register(
        &mut self,
        number: usize,
        clock: ClockId,
        start: Start,
        enable: Option<Pick>,
        next: Pick,
        link: Option<&Link>,
    ) {
        let register = self.started(number, clock, start);
        let shape = self.build.shape(register);
        let enable = enable.map(|pick| self.fit(pick, 1, shape));
        self.build.next(register, enable, register);
        match link {
            Some(link) if !shape.is_plain() => {
                let next = self.follow(register, link, None);
                self.build.next(register, enable, next);
            }
            _ => self.late.push(Late::Next(register, next)),
        }
        self.values.push(register);
    }

    /// Values side by side as one word, in what holds it, and its parts.
    pub fn record(&mut self, number: usize, clock: ClockId, fields: &[Pick], held: Held) {
        Feature::RecordInShapes.used();
        let mut parts = self.alike(fields);
        let mut width = 0;
        parts.retain(|part| {
            let wider = width + self.build.width(*part);
            let fits = wider <= WIDEST;
            width = if fits { wider } else { width };
            fits
        });
        let shape = self.build.shape(parts[0]);
        let whole = self.build.node(Op::Concat(parts.clone()), width, shape);
        let name = self.name(&format!("e{number}"), Kind::Inner);
        let word = match held {
            Held::Net => {
                let net = self.build.node(Op::Wire(whole), width, shape);
                self.build.named(&name, net)
            }
            Held::Register => {
                let register = self.build.register(&name, width, shape, None);
                self.build.module.registers.last_mut().expect("there is one").clock = clock;
                self.build.next(register, None, whole);
                register
            }
            Held::Memory(address) => {
                let (address, id) = (self.fit(address, 1, shape), self.build.memory(&name, 2, width, shape));
                let always = self.build.constant(1, 1, shape);
                self.build.write(id, always, address, whole);
                self.build.module.memories[id.0 as usize].writes[0].clock = clock;
                self.build.read(id, false, address, None)
            }
        };
        let mut low = width;
        for part in parts {
            let part = self.build.width(part);
            low -= part;
            let field = self.build.node(Op::Slice { of: word, low }, part, shape);
            self.push(number, field);
        }
    }
}
