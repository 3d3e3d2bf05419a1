//! Chapter 5: a queue of received bytes.

use tilewright_hdl::*;

record! {
    /// What a receiver has received.
    pub struct Received {
        /// The byte.
        data: bits(8),
        /// Its stop bit was low: the line was disturbed.
        broken: bit(),
    }
}

block! {
    /// A queue of received bytes. A push into a full queue and a pop of an empty one do nothing.
    pub struct ByteQueue {
        /// How many bytes there is room for, a power of two.
        pub depth: u32,
    }
    in ByteQueueIn {
        /// Puts `byte_in` into the queue.
        push: bit(),
        /// What comes in.
        byte_in: Received,
        /// Removes the oldest byte.
        pop: bit(),
    }
    out(self) ByteQueueOut {
        /// The oldest byte, unless the queue is empty.
        oldest: Received,
        /// There is none.
        empty: bit(),
        /// There is no room.
        full: bit(),
        /// How many bytes there are.
        used: up_to(self.depth),
    }
}

impl ByteQueue {
    fn build(&self, m: Module, i: ByteQueueIn) -> ByteQueueOut {
        def!(bytes = m.memory(self.depth, Received::widths(), ReadUnderWrite::Any));
        let pointer = bytes.address_width() + 1; // One bit more tells full from empty.
        def!(first = m.reg(pointer).reset(0));
        def!(behind = m.reg(pointer).reset(0));
        def!(empty = first.eq(behind));
        def!(full = (first ^ behind).eq(self.depth));
        def!(pushes = i.push & !full);
        bytes.write(pushes, behind.low(), i.byte_in);
        behind.when(pushes, behind + 1);
        first.when(i.pop & !empty, first + 1);
        ByteQueueOut { oldest: bytes.read_async(first.low()), empty, full, used: behind - *first }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::VecDeque;
    use tilewright_sim::Simulation;

    #[test]
    fn the_first_in_is_the_first_out() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ByteQueue { depth: 4 })?;
        let wave = sim.record(["push", "byte_in_data", "pop", "oldest_data", "oldest_broken", "empty", "full"]);
        for data in [0x41, 0x42] {
            sim.drive(ByteQueueIn { push: 1, byte_in: Received { data, broken: data & 1 }, pop: 0 });
            sim.step();
        }
        for _ in 0..3 {
            sim.drive(ByteQueueIn { push: 0, byte_in: Received { data: 0, broken: 0 }, pop: 1 });
            sim.step();
        }
        wave.expect(
            r"
            clk           |____/~~\_/~~\_/~~\_/~~\_/
            push          |~~~~~~~~~\_______________
            byte_in_data  | 41 | 42 | 0            |
            pop           |_________/~~~~~~~~~~~~~~~
            oldest_data   | 0  | 41      | 42 | 0  |
            oldest_broken |____/~~~~~~~~~\__________
            empty         |~~~~\______________/~~~~~
            full          |_________________________",
        );
        Ok(())
    }

    #[test]
    fn it_is_a_queue() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ByteQueue { depth: 4 })?.seeded(1);
        let mut model = VecDeque::new();
        for clock in 0..500u64 {
            let (push, pop) = (clock * 7 % 5 > 1, clock * 11 % 17 > clock / 32);
            let byte = Received { data: clock % 251, broken: clock % 3 / 2 };
            sim.drive(ByteQueueIn { push: push.into(), byte_in: byte, pop: pop.into() });
            let ByteQueueOut { oldest, empty, full, used } = sim.read_u64();
            assert_eq!((empty == 1, full == 1, used), (model.is_empty(), model.len() == 4, model.len() as u64));
            model.front().into_iter().for_each(|first| assert_eq!(oldest, *first));
            let pushes = push && model.len() < 4;
            if pop {
                model.pop_front();
            }
            if pushes {
                model.push_back(byte);
            }
            sim.step();
        }
        Ok(())
    }
}
