//! Appendix A: a line of each kind.

use tilewright_hdl::*;

codes! {
    /// What is done.
    pub enum Operation {
        /// Nothing.
        Keep,
        /// A sum.
        Add,
        /// An exclusive or.
        Xor,
    }
}

record! {
    /// A step of a program.
    pub struct Step(width: u32) {
        /// What is done.
        operation: one_of::<Operation>(),
        /// With what.
        operand: bits(width),
    }
}

block! {
    /// Uses the language.
    pub struct CheatSheet {
        /// How wide its words are.
        pub width: u32,
    }
    in(self) CheatSheetIn {
        /// Steps.
        steps: stream(Step::widths(self.width)),
        /// Writes into the memory.
        write: bit(),
        /// Where.
        address: below(100),
        /// Four bytes side by side.
        bytes: bits(8).of(row(4)),
    }
    out(self) CheatSheetOut {
        /// What was computed.
        results: stream(bits(self.width)),
        /// The sum of the bytes, and more.
        checks: bits(16),
    }
}

/// High in the first clock in which `bit` is.
fn rising(m: Module, bit: Signal) -> Signal {
    def!(was = m.pipe(bit));
    bit & !was
}

impl CheatSheet {
    fn build(&self, m: Module, i: CheatSheetIn) -> CheatSheetOut {
        // Registers.
        def!(count = m.reg(8).reset(0)); // .initial(0): at power-on
        count.next(count + 1);
        def!(latest = m.reg(below(100)).when(i.write, i.address)); // else it keeps its value
        def!(timer = m.reg(up_to(9)).reset(9));
        timer.when(i.write, 9).when(timer.ne(0), timer - 1); // the first that is high wins
        def!(late = m.pipe(i.write)); // one clock later
        def!(odd = m.toggle(i.write)); // a bit that inverts
        def!(rises = m.within("write", || rising(m, i.write))); // the names of a helper: `write_was`
        def!(slow = m.enabled(odd, || m.toggle("slow_bit", i.write))); // keeps its state where `odd` is low

        // Expressions.
        let sum = count + 1; // wraps
        let wide = count.add_carry(1); // one bit more
        let product = count * 100; // 8 + 7 bits
        let difference = count.zext(9).signed() - 100; // signed
        let is_small = count.lt(16) & !count.eq(3) | late;
        let parts = cat![count.slice(0..4), count.part(4, 4), count.bit(7), count.msb()];
        let any = parts.any_one() ^ parts.all_ones() ^ parts.parity();

        // Choices.
        let smaller = mux(count.lt(sum), count, sum);
        let first = select([(late, sum), (is_small, *count)], 0);
        let by_number = case(count.slice(0..2), [(0, sum), (2, *count)], 0);

        // Streams.
        def!(full = m.reg(bit()).reset(0));
        def!(accumulator = m.reg(self.width).reset(0));
        let (results, sent) = m.offer(full, *accumulator);
        let step = i.steps.take_when(!full | sent);
        full.when(step.taken, 1).when(sent, 0);
        let result = choose!(step.operation, Operation {
            Keep => accumulator,
            Add => accumulator + step.operand,
            Xor => accumulator ^ step.operand,
        });
        accumulator.when(step.taken, result);

        // Memories.
        def!(words = m.memory(100, 8, ReadUnderWrite::Any).fill(0));
        words.write(i.write, i.address, sum);
        def!(at_once = words.read_async(i.address));
        def!(at_edge = words.read(latest));

        // Lanes.
        def!(total = i.bytes.zext(10).sum());
        let shifted = i.bytes.previous(at_once); // lane 0 gets `at_once`, lane 1 what lane 0 is
        def!(greatest = shifted.maximum());

        // What is stated.
        m.assert(timer.le(9), "the timer never passes its start");
        m.assume(i.address.lt(100), "addresses are in range");
        m.cover("the timer ends", timer.eq(0));
        m.display(i.write, "{} at {:x}", &[sum, i.address]); // also {:b}; a simulation shows it
        m.assert(m.past(i.write).implies(timer.eq(9)), "a write starts the timer");

        let all = smaller ^ first ^ by_number ^ at_edge ^ greatest;
        let bits = wide.parity() ^ product.parity() ^ difference.parity() ^ any ^ odd ^ rises ^ slow;
        CheatSheetOut { results, checks: cat![all, total.slice(0..7), bits] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Pauses, Simulation};

    #[test]
    fn the_lines_of_a_test() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&CheatSheet { width: 8 })?.seeded(1);
        let messages = sim.messages();
        sim.set(sim.i.write, 1);
        sim.set_lanes(sim.i.bytes, [1, 2, 3, 4]);
        sim.reset();
        sim.run(10);
        assert_eq!(messages.lines()[2], "3 at 0"); // what `m.display` showed
        assert_eq!(sim.peek("total")?, 10);
        assert_eq!(sim.peek_memory("words", 0)?, 10);
        let (steps, results) = (sim.i.steps, sim.o.results);
        let t = sim.testbench();
        let step = |operation: Operation, operand| Step { operation: operation.code(), operand };
        let program = [step(Operation::Add, 5), step(Operation::Xor, 1), step(Operation::Keep, 9)];
        t.run((
            t.send_all(steps, program, Pauses::percent(30, 1)),
            t.expect_all(results, [5, 4, 4], Pauses::percent(60, 2)),
        ));
        Ok(())
    }
}
