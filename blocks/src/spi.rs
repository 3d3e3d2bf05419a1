//! A master of a serial peripheral interface.

use crate::ports::state_that_it_stays;
use tilewright_hdl::{Module, below, bit, bits, block, cat, codes, def, when};

codes! {
    /// What an [`SpiMaster`] does with its slave.
    enum Phase {
        /// Nothing: the slave is not selected.
        Idle,
        /// A word is on the way.
        Shift,
        /// The slave stays selected until the next word.
        Between,
        /// The last word has passed, and the slave is still selected.
        Hold,
        /// The slave is deselected, long enough to notice.
        Gap,
    }
}

block! {
    /// Exchanges words with a slave of a serial peripheral interface (SPI).
    ///
    /// ```text
    ///           .----------.                  .----------.
    /// send ====>| outgoing |--> mosi  miso -->| incoming |====> received
    ///           '----------'                  '----------'
    ///                ^    .---------.    ^
    ///                '----| edges,  |----'
    ///             cs_n <--| phase   |--> sck
    ///                     '---------'
    /// ```
    ///
    /// ```text
    /// cs_n ~~\___________________________/~~~
    /// sck  ______/~~~\___/~~~\___/~~~\_______
    /// mosi --<   2   X   1   X   0   >-------    mode 0, words of 3 bits
    /// ```
    ///
    /// Both sides send the most significant bit first. Each word sent brings one word back. The slave stays selected
    /// from word to word, until a word with `last`. Then it is deselected for `half_period` clocks or more. A word
    /// waits until the word received before it has been taken, so nothing is lost.
    ///
    /// | mode | `sck` at rest | bits are sampled | bits change |
    /// |---|---|---|---|
    /// | 0 | low | where `sck` rises | where `sck` falls |
    /// | 1 | low | where `sck` falls | where `sck` rises |
    /// | 2 | high | where `sck` falls | where `sck` rises |
    /// | 3 | high | where `sck` rises | where `sck` falls |
    ///
    /// Latency: `2 * width * half_period + 1` clocks from a word to the word received for it. The next word can be sent
    /// after as many clocks. No `valid` waits for `ready`, and `received.ready` passes to `send.ready`. `miso` follows
    /// `sck`, so it is not synchronized. It must be stable at the clock edge that moves `sck` to a sampling edge.
    ///
    /// ```
    /// # use tilewright_blocks::{SpiMaster, SpiWord};
    /// # use tilewright_sim::{Pauses, Simulation, monitor};
    /// let mut sim = Simulation::of(&SpiMaster { width: 8, half_period: 2, mode: 0 })?;
    /// sim.reset();
    /// let (send, received, miso, mosi) = (sim.i.send, sim.o.received, sim.i.miso, sim.o.mosi);
    /// let t = &sim.testbench();
    /// let wire = async {
    ///     loop {
    ///         t.step().await;
    ///         t.set(miso, t.get_u64(mosi)); // the slave is a wire
    ///     }
    /// };
    /// let words = [SpiWord { word: 0xa5, last: 0 }, SpiWord { word: 0x3c, last: 1 }];
    /// let sender = t.send_all(send, words, Pauses::NONE);
    /// let receiver = t.expect_all(received, [0xa5, 0x3c], Pauses::NONE);
    /// t.run((sender, receiver, monitor(wire)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct SpiMaster {
        /// The bits of a word.
        pub width: u32,
        /// The clocks from one edge of `sck` to the next.
        pub half_period: u32,
        /// Twice the level of `sck` at rest (CPOL), plus 1 if bits are sampled at its second edge (CPHA).
        pub mode: u32,
    }
    ranges { width: 2..=64, half_period: 1.., mode: 0..=3 }
    latency(self) = format!("{} clocks", 2 * u64::from(self.width) * u64::from(self.half_period) + 1);
    in(self) SpiMasterIn {
        /// The words to send.
        ///
        /// ```
        /// # use tilewright_blocks::SpiWord;
        /// let read_id = [0x9f, 0, 0, 0].map(|word| SpiWord { word, last: 0 });
        /// # assert_eq!(read_id[0].word, 0x9f);
        /// ```
        send: stream(pub struct SpiWord {
            /// A word for the slave.
            word: bits(self.width),
            /// High if the slave is deselected after the word.
            last: bit(),
        }),
        /// The line from the slave.
        miso: bit(),
    }
    out(self) SpiMasterOut {
        /// The words from the slave, one for each word sent.
        received: stream(bits(self.width)),
        /// The clock of the interface.
        sck: bit(),
        /// The line to the slave.
        mosi: bit(),
        /// Low while the slave is selected.
        cs_n: bit(),
    }
}

impl SpiMaster {
    fn build(&self, m: Module, i: SpiMasterIn) -> SpiMasterOut {
        let (rests_high, samples_late) = (self.mode & 2 != 0, self.mode & 1 != 0);
        def!(phase = m.fsm(Phase::Idle));
        def!(full = m.reg(bit()).reset(0));
        def!(incoming = m.reg(self.width));
        let (received, taken) = m.offer(full, *incoming);
        def!(waits = phase.is(Phase::Idle) | phase.is(Phase::Between));
        let send = i.send.take_when(waits & (!full | taken));
        def!(last = m.reg(bit()).when(send.taken, send.last));

        def!(clocks = m.reg(below(self.half_period)).reset(0));
        def!(tick = !waits & clocks.eq(self.half_period - 1));
        clocks.when(tick, 0).when(!waits, clocks + 1);
        def!(edges = m.reg(below(2 * self.width)).reset(0));
        def!(shifts = tick & phase.is(Phase::Shift));
        def!(ends = shifts & edges.eq(2 * self.width - 1));
        edges.when(ends, 0).when(shifts, edges + 1);
        let moves = phase.next(|phase| match phase {
            Phase::Idle | Phase::Between => when(send.taken, Phase::Shift),
            Phase::Shift => when(ends & last, Phase::Hold).or_when(ends, Phase::Between),
            Phase::Hold => when(tick, Phase::Gap),
            Phase::Gap => when(tick, Phase::Idle),
        });
        full.when(ends, 1).when(taken, 0);
        m.assert(ends.implies(!full), "a word comes in only where there is room for it");
        state_that_it_stays(m, &received);

        let second = edges.bit(0);
        let (samples, changes) = if samples_late { (second, !second & edges.ne(0)) } else { (!second, second) };
        incoming.when(shifts & samples, cat![incoming.trunc(self.width - 1), i.miso]);
        def!(outgoing = m.reg(self.width));
        outgoing.when(send.taken, send.word).when(shifts & changes, outgoing << 1);
        // A pin comes straight from a register, as a slave would take a glitch of `sck` for an edge.
        def!(sck = m.reg(bit()).reset(rests_high));
        sck.when(shifts, !sck);
        def!(cs_n = m.reg(bit()).reset(1));
        cs_n.when(send.taken, 0).when(moves.leaves(Phase::Hold), 1);
        SpiMasterOut { received, sck: *sck, mosi: outgoing.msb(), cs_n: *cs_n }
    }
}
