//! A master of I2C.

use crate::debouncer::{Debouncer, DebouncerIn};
use crate::i2c_command::{I2cAction, I2cAnswer, I2cCommand, I2cResult};
use crate::ports::state_that_it_stays;
use tilewright_hdl::{Module, Period, below, bit, block, cat, choose, codes, def, lit, mux, one_of, up_to, when};

/// The modes of I2C, by their fastest clocks.
///
/// ```
/// # use tilewright_blocks::{I2cMaster, I2cMode};
/// # use tilewright_hdl::Period;
/// let master = I2cMaster::new(I2cMode::Fast, Period::ns(20));
/// assert_eq!(master, I2cMaster { low: 65, high: 53, filter: 4 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum I2cMode {
    /// 100 kHz.
    Standard,
    /// 400 kHz. Spikes of up to 50 ns are ignored.
    Fast,
    /// 1 MHz. Spikes of up to 50 ns are ignored.
    FastPlus,
}

codes! {
    /// Where an [`I2cMaster`] is in what it does.
    enum Phase {
        /// The bus is not ours.
        Free,
        /// A START waits until the bus is free.
        Wait,
        /// SDA is low and SCL high: a START.
        Begin,
        /// The bus is ours, and SCL is low until the next command.
        Own,
        /// SCL is low, and SDA changes in the middle.
        Low,
        /// SCL is released, until it is seen high.
        Rise,
        /// SCL is high.
        High,
        /// Both lines are released: a STOP.
        End,
    }
}

block! {
    /// A master of I2C, for buses with several masters and with slaves that stretch the clock.
    ///
    /// ```text
    ///              .-----------.
    /// commands ===>| 9 bits    |---> sda_low            .--------.
    /// answers <====| in, out   |<------------- filter --| sync   |<-- sda
    ///              '-----------'                        '--------'
    ///                 ^     .---------.
    ///                 '-----| phase,  |---> scl_low     .--------.
    ///        busy <---------| clocks  |<------ filter --| sync   |<-- scl
    ///                       '---------'                 '--------'
    /// ```
    ///
    /// Both lines are open drains with pull-ups. `scl_low` pulls SCL low, and `scl` is the level of the line.
    /// [`Pad`](tilewright_hdl::Pad) with `PadIn::open_drain` is the pin for each. The lines may change at any time, as
    /// they are synchronized. A level of less than `filter` clocks is ignored.
    ///
    /// Each command has one answer, in the same sequence. The master has the bus from a START to a STOP. Between two
    /// commands, it keeps SCL low, and the slaves wait. A slave stretches the clock by keeping SCL low. The high
    /// period begins when the master sees SCL high, however long that takes.
    ///
    /// Other masters may use the bus. `busy` is high from any START to the next STOP. A START waits until `busy` is low
    /// and both lines were high for `low` clocks. If another master ends the high period first, the low period begins
    /// then. A master that sends a high and sees a low has lost the bus, and releases it. Its answer is `Lost`, and so
    /// are those to all commands up to the next `Stop`, including it: a program that was sent ahead is skipped. A command
    /// without a START before it is answered `Lost`, too. So is a `Stop` after which SDA stays low.
    ///
    /// A bit takes `low + high + filter + 3` clocks, if the lines rise at once. In `filter + 3` of them SCL is high, but
    /// not yet seen high.
    ///
    /// | command | clocks from the command to its answer |
    /// |---|---|
    /// | `Start` on a free bus | `high + 2` |
    /// | `Start`, repeated | a bit, and `high + 1` |
    /// | `Write`, `Read` | 9 bits, and 1 |
    /// | `Stop` | a bit, and `low + 1` |
    ///
    /// The next command is taken together with the answer. No `valid` waits for `ready`, and `answers.ready` passes to
    /// `commands.ready`.
    ///
    /// ```
    /// # use tilewright_blocks::{I2cAnswer, I2cCommand, I2cMaster};
    /// # use tilewright_sim::{Pauses, Simulation};
    /// let mut sim = Simulation::of(&I2cMaster { low: 6, high: 4, filter: 1 })?;
    /// let (i, o) = (sim.i, sim.o);
    /// sim.set(i.scl, 1);
    /// sim.set(i.sda, 1);
    /// sim.reset();
    /// let t = sim.testbench();
    /// let commands = [I2cCommand::START, I2cCommand::write(0xa0), I2cCommand::STOP];
    /// let (_, answers, ..) = t.run((
    ///     t.send_all(i.commands, commands, Pauses::NONE),
    ///     t.receive_all(o.answers, 3, Pauses::NONE),
    ///     t.answer(i.scl, [o.scl_low], |[low]| low ^ 1), // no slave pulls
    ///     t.answer(i.sda, [o.sda_low], |[low]| low ^ 1),
    /// ));
    /// let results: Vec<u64> = answers.iter().map(|answer| answer.result).collect();
    /// assert_eq!(results, [0, 1, 0]); // done, not acknowledged, done
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[doc(alias = "TWI")]
    pub struct I2cMaster {
        /// The clocks for which SCL is low, and for which the bus rests before a START.
        pub low: u32,
        /// The clocks for which SCL is seen high, and from a START to the first falling edge of SCL.
        pub high: u32,
        /// The clocks in succession that a level must last before it counts.
        pub filter: u32,
    }
    ranges(self) {
        filter: 1..=1024,
        /// The master sees what it does to the lines before it goes on.
        low: self.filter + 4..,
        high: 2..,
    }
    latency(self) = format!("{} clocks for a byte", 9 * self.clocks_of_a_bit() + 1);
    in I2cMasterIn {
        /// What to do.
        commands: stream(I2cCommand),
        /// The level of SCL, which is asynchronous.
        scl: bit(),
        /// The level of SDA, which is asynchronous.
        sda: bit(),
    }
    out I2cMasterOut {
        /// What became of each command.
        answers: stream(I2cAnswer),
        /// High while the master pulls SCL low.
        scl_low: bit(),
        /// High while the master pulls SDA low.
        sda_low: bit(),
        /// High from a START of any master to a STOP.
        busy: bit(),
    }
}

impl I2cMaster {
    /// A master on a clock of this period. No time is shorter than the mode allows (UM10204), and SCL is no
    /// faster. The rise time of the lines makes a real bus slower.
    ///
    /// ```
    /// # use tilewright_blocks::{I2cMaster, I2cMode};
    /// # use tilewright_hdl::Period;
    /// let master = I2cMaster::new(I2cMode::Standard, Period::ns(100));
    /// assert_eq!(master.low + master.high + master.filter + 3, 100); // 100 kHz
    /// ```
    pub fn new(mode: I2cMode, clock: Period) -> I2cMaster {
        let (low, high, period, spike) = match mode {
            I2cMode::Standard => (4_700, 4_000, 10_000, None),
            I2cMode::Fast => (1_300, 600, 2_500, Some(50)),
            I2cMode::FastPlus => (500, 260, 1_000, Some(50)),
        };
        let clock = clock.picoseconds();
        let clocks = |ns: u64| u32::try_from((1_000 * ns).div_ceil(clock)).unwrap_or(u32::MAX);
        // A spike is seen by one edge more than there are whole clocks in it.
        let filter = spike.map_or(1, |ns: u64| u32::try_from(1_000 * ns / clock + 2).unwrap_or(u32::MAX));
        let low = clocks(low);
        let rest = clocks(period).saturating_sub(low).saturating_sub(filter.saturating_add(3));
        I2cMaster { low, high: clocks(high).max(rest), filter }
    }

    /// From one falling edge of SCL to the next, where no slave stretches the clock.
    fn clocks_of_a_bit(&self) -> u64 {
        u64::from(self.low) + u64::from(self.high) + u64::from(self.filter) + 3
    }

    fn build(&self, m: Module, i: I2cMasterIn) -> I2cMasterOut {
        use Phase::*;
        let I2cMaster { low, high, filter } = *self;
        def!(scl = m.instance(&Debouncer { clocks: filter.into(), idle: true }, DebouncerIn { line: i.scl }));
        // SDA is seen a clock later than SCL, so a change right after a falling edge of SCL is no START or STOP.
        def!(sda = m.instance(&Debouncer { clocks: u64::from(filter) + 1, idle: true }, DebouncerIn { line: i.sda }));
        def!(busy = m.reg(bit()).reset(0));
        busy.when(sda.falls & scl.level, 1).when(sda.rises & scl.level, 0);
        def!(rest = m.reg(up_to(low)).reset(low));
        rest.when(busy | !scl.level | !sda.level, low).when(rest.ne(0), rest - 1);

        def!(phase = m.fsm(Free));
        def!(word = m.reg(9)); // what is to be sent, from the left; what is received comes in from the right
        def!(result = m.reg(one_of::<I2cResult>()));
        def!(full = m.reg(bit()).reset(0));
        let (answers, sent) = m.offer(full, I2cAnswer { result: *result, byte: word.slice(1..9) });
        let is_ready = (phase.is(Free) | phase.is(Own)) & (!full | sent);
        let command = i.commands.take_when(is_ready);
        def!(action = m.reg(one_of::<I2cAction>()).when(command.taken, command.action));
        let [starts, reads, stops] = [I2cAction::Start, I2cAction::Read, I2cAction::Stop].map(|it| action.is(it));

        // After a loss, all up to a STOP is skipped.
        def!(skips = m.reg(bit()).reset(0));
        let without_bus = command.taken & phase.is(Free);
        def!(begins = without_bus & command.action.is(I2cAction::Start) & !skips);

        def!(count = m.reg(below(low.max(high))).reset(0));
        def! { done = choose!(phase, Phase {
            Free | Wait | Own | Rise => 1,
            Low | End => count.eq(low - 1),
            Begin | High => count.eq(high - 1) | !scl.level,
        }) }
        count.when(done, 0).otherwise(count + 1);
        def!(place = m.reg(up_to(9)).reset(0));
        def!(is_last = place.eq(8));
        def!(bit_ends = phase.is(High) & done);
        place.when(command.taken, 0).when(bit_ends, place + 1);

        // Of a byte that is received, the acknowledgement alone is ours. No START or STOP is possible while SCL is low.
        let is_ours = !(reads ^ is_last);
        let collides = is_ours & word.msb() & !sda.level;
        def!(lost = bit_ends & (collides | (starts | stops) & !scl.level));
        let moves = phase.next(|phase| match phase {
            Free => when(begins, Wait),
            Wait => when(rest.eq(0), Begin),
            Begin => when(done, Own),
            Own => when(command.taken, Low),
            Low => when(done, Rise),
            Rise => when(scl.level, High),
            High => when(lost, Free)
                .or_when(done & starts, Begin)
                .or_when(done & stops, End)
                .or_when(done & is_last, Own)
                .or_when(done, Low),
            End => when(done, Free),
        });
        skips.when(lost & !stops, 1).when(without_bus & command.action.is(I2cAction::Stop), 0);

        let to_send = choose!(command.action, I2cAction {
            Start => lit(9, 0x1ff),
            Write => cat![command.byte, lit(1, 1)],
            Read => cat![lit(8, 0xff), command.last],
            Stop => lit(9, 0),
        });
        word.when(command.taken, to_send).when(bit_ends, cat![word.trunc(8), sda.level]);
        let is_nack = !starts & !reads & sda.level;
        let has_lost = lost | (without_bus & !begins) | (moves.leaves(End) & !sda.level);
        def!(answered = has_lost | moves.enters(Own) | moves.leaves(End));
        result
            .when(has_lost, I2cResult::Lost)
            .when(moves.goes(High, Own), mux(is_nack, I2cResult::Nack, I2cResult::Done))
            .when(answered, I2cResult::Done);
        full.when(answered, 1).when(sent, 0);
        state_that_it_stays(m, &answers.packed());

        def!(scl_low = m.reg(bit()).reset(0));
        scl_low.when(moves.enters(Own) | moves.enters(Low), 1).when(moves.leaves(Low), 0);
        def!(sda_low = m.reg(bit()).reset(0));
        let changes = phase.is(Low) & count.eq(low / 2);
        sda_low.when(changes, !word.msb()).when(moves.enters(Begin), 1).when(moves.enters(End) | lost, 0);
        let may_change = scl_low & m.past(*scl_low) | phase.is(Begin) | phase.is(End) | m.past(lost);
        m.assert(m.stable(sda_low) | may_change, "SDA changes where SCL is low, or for a START or a STOP");
        m.cover("a slave stretches the clock", phase.is(Rise) & m.past(phase.is(Rise)) & !i.scl);
        m.cover("another master wins", lost);
        I2cMasterOut { answers, scl_low: *scl_low, sda_low: *sda_low, busy: *busy }
    }
}
