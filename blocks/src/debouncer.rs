//! A line that bounces.

use tilewright_hdl::{Module, below, bit, block, def, mux};

block! {
    /// Follows a switch, and ignores how its contact bounces.
    ///
    /// ```text
    ///         .--------------.         .-------.
    /// line -->| synchronizer |--+->(^)>| count |--changes--.
    ///         '--------------'  |   ^  '-------'           v
    ///                           '---|------------------>[ level ]--+--> level
    ///                               '------------------------------'
    /// ```
    ///
    /// Latency: 2 clocks of the synchronizer, and `clocks` more. `level` changes once the line has differed from
    /// `level` for `clocks` clocks without a break. A shorter pulse is ignored. The line needs no other synchronizer.
    ///
    /// ```
    /// # use tilewright_blocks::{Debouncer, DebouncerIn};
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&Debouncer { clocks: 3, idle: false })?;
    /// let wave = sim.record(["line", "level", "rises"]);
    /// sim.reset();
    /// for line in [1, 0, 1, 1, 1, 1, 1, 1, 1] {
    ///     sim.drive(DebouncerIn { line });
    ///     sim.step();
    /// }
    /// wave.expect(r"
    ///     clk   |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
    ///     line  |___/~~~\___/~~~~~~~~~~~~~~~~~~~~~~~~~~~~
    ///     level |_______________________________/~~~~~~~~
    ///     rises |_______________________________/~~~\____");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct Debouncer {
        /// The number of clocks in succession that a new level must last before it counts.
        pub clocks: u64,
        /// The level after a reset, which is that of the switch at rest.
        pub idle: bool,
    }
    ranges { clocks: 1.. }
    latency(self) = format!("{} clocks", self.clocks.saturating_add(2));
    in DebouncerIn {
        /// The line of the switch, which is asynchronous.
        line: bit(),
    }
    out DebouncerOut {
        /// The level of the line, without the bounces.
        level: bit(),
        /// High in the first clock of a high `level`.
        rises: bit(),
        /// High in the first clock of a low `level`.
        falls: bit(),
    }
}

impl Debouncer {
    fn build(&self, m: Module, i: DebouncerIn) -> DebouncerOut {
        def!(seen = m.synchronize_from(self.idle, i.line));
        def!(level = m.reg(bit()).reset(self.idle));
        def!(differs = seen ^ level);
        def!(count = m.reg(below(self.clocks)).reset(0));
        def!(changes = differs & count.eq(self.clocks - 1));
        count.next(mux(differs & !changes, count + 1, 0));
        level.when(changes, seen);
        def!(rises = m.reg(bit()).reset(0));
        rises.next(changes & seen);
        def!(falls = m.reg(bit()).reset(0));
        falls.next(changes & !seen);
        m.assert(rises.implies(level) & falls.implies(!level), "an edge is reported beside its level");
        // A change of one clock counts at once where one clock suffices.
        if self.clocks > 1 {
            m.cover("a pulse is ignored", m.fell(differs) & m.stable(level));
        }
        DebouncerOut { level: *level, rises: *rises, falls: *falls }
    }
}
