//! Chapter 8: a square of processors under one instruction.

use tilewright_hdl::*;

codes! {
    /// What all processors do in a clock.
    pub enum Opcode {
        /// Loads a word of the memory.
        Load,
        /// Adds a word of the memory.
        Add,
        /// Adds a constant.
        AddConstant,
        /// Loads what the neighbour in the west has.
        West,
        /// Stores into the memory.
        Store,
        /// Goes on where the accumulator is less than a constant.
        IfLess,
        /// Goes on everywhere.
        Everybody,
    }
}

block! {
    /// `edge` x `edge` processors, each with an accumulator and 256 bytes of memory, under one instruction.
    pub struct Simd {
        /// How many there are along each edge.
        pub edge: u32,
    }
    in(self) SimdIn {
        /// What all of them do.
        instruction: pub struct Instruction {
            /// What.
            opcode: one_of::<Opcode>(),
            /// The word of the memory that is read or written.
            address: bits(8),
            /// The constant.
            constant: bits(8),
        },
        /// What the first column has in the west.
        west: bits(8).of(row(self.edge)),
    }
    out(self) SimdOut {
        /// The accumulators of the last column.
        east: bits(8).of(row(self.edge)),
        /// The greatest accumulator of each row.
        greatest: bits(8).of(row(self.edge)),
    }
}

impl Simd {
    fn build(&self, m: Module, i: SimdIn) -> SimdOut {
        let processors = grid(self.edge, self.edge);
        let Instruction { opcode, address, constant } = i.instruction;
        def!(a = m.reg(bits(8).of(processors)).reset(0));
        def!(active = m.reg(bit().of(processors)).reset(1));
        def!(memory = m.memory(256, bits(8).of(processors), ReadUnderWrite::Any).fill(0));
        def!(operand = memory.read_async(address));
        def!(neighbour = a.columns().previous(i.west));
        let result = choose!(opcode, Opcode {
            Load => operand,
            Add => a + operand,
            AddConstant => a + constant,
            West => neighbour,
            Store | IfLess | Everybody => a,
        });
        a.when(active, result);
        active.when(opcode.is(Opcode::IfLess), active & a.lt(constant)).when(opcode.is(Opcode::Everybody), 1);
        memory.write(active & opcode.is(Opcode::Store), address, a);
        SimdOut { east: a.columns().last(), greatest: a.columns().maximum() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    const EDGE: usize = 4;

    /// The processors in Rust.
    struct Model {
        a: [u8; EDGE * EDGE],
        active: [bool; EDGE * EDGE],
        memory: [[u8; 256]; EDGE * EDGE],
    }

    impl Model {
        fn step(&mut self, opcode: Opcode, address: u8, constant: u8, west: &[u64]) {
            let before = self.a;
            for lane in 0..EDGE * EDGE {
                let (row, column) = (lane / EDGE, lane % EDGE);
                let word = &mut self.memory[lane][usize::from(address)];
                let is_active = self.active[lane];
                let a = &mut self.a[lane];
                match opcode {
                    Opcode::Everybody => self.active[lane] = true,
                    _ if !is_active => {}
                    Opcode::Load => *a = *word,
                    Opcode::Add => *a = a.wrapping_add(*word),
                    Opcode::AddConstant => *a = a.wrapping_add(constant),
                    Opcode::West if column == 0 => *a = west[row] as u8,
                    Opcode::West => *a = before[lane - 1],
                    Opcode::Store => *word = *a,
                    Opcode::IfLess => self.active[lane] = *a < constant,
                }
            }
        }
    }

    #[test]
    fn the_processors_do_what_a_model_does() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Simd { edge: EDGE as u32 })?;
        let mut model = Model { a: [0; 16], active: [true; 16], memory: [[0; 256]; 16] };
        let mut random = 1u64;
        for _ in 0..1000 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let opcode = Opcode::ALL[(random >> 40) as usize % Opcode::ALL.len()];
            let (address, constant) = ((random >> 50) as u8 % 4, (random >> 20) as u8);
            let west = [1, 2, 3, 4].map(|row| (random >> row) % 256);
            let instruction = Instruction { opcode: opcode.code(), address: address.into(), constant: constant.into() };
            sim.set_record(sim.i.instruction, instruction);
            sim.set_lanes(sim.i.west, west);
            sim.step();
            model.step(opcode, address, constant, &west);
            assert_eq!(sim.peek("a[2][3]")?, u64::from(model.a[2 * EDGE + 3]));
            let rows = model.a.chunks(EDGE);
            assert_eq!(sim.lanes(sim.o.east), rows.clone().map(|row| row[EDGE - 1].into()).collect::<Vec<u64>>());
            let greatest = rows.map(|row| u64::from(*row.iter().max().unwrap())).collect::<Vec<_>>();
            assert_eq!(sim.lanes(sim.o.greatest), greatest);
        }
        Ok(())
    }
}
