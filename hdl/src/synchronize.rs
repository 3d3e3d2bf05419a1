//! Synchronizers: a bit of another clock, through two registers.

use crate::draft::Synchronizer;
use crate::elaboration;
use crate::module::Module;
use crate::select::condition;
use crate::signal::Signal;
use tilewright_circuit::Loc;

impl Module {
    /// Brings a 1-bit `signal` of another clock into this one through two registers, `NAME_meta` and `NAME`, which a
    /// reset sets to 0. The signal must come straight from a register or an input, because logic glitches.
    ///
    /// Both registers have the Verilog attribute `ASYNC_REG`, so that synthesizers do not change them.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const HOST: Clock = Clock::new("host", Period::ns(30));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    ///
    /// block! {
    ///     struct Start;
    ///     in StartIn { go: bit().on(HOST) }
    ///     out StartOut { running: bit() }
    /// }
    ///
    /// impl Start {
    ///     fn build(&self, m: Module, i: StartIn) -> StartOut {
    ///         let m = m.on(VIDEO);
    ///         let go = m.synchronize("go_here", i.go);
    ///         def!(running = m.reg(1).reset(0));
    ///         running.when(go, 1);
    ///         StartOut { running: *running }
    ///     }
    /// }
    ///
    /// let design = elaborate(&Start)?;
    /// let registers = design.top().registers.iter().map(|register| design.top().register_name(register));
    /// assert_eq!(registers.collect::<Vec<_>>(), ["go_here_meta", "go_here", "running"]);
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn synchronize(self, name: &str, signal: Signal) -> Signal {
        self.synchronize_from(false, name, signal)
    }

    /// Like [`Module::synchronize`], with a reset value: the idle level of the signal. A line that idles high, as a
    /// UART's does, would otherwise begin with an edge that nobody sent.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # const HOST: Clock = Clock::new("host", Period::ns(30));
    /// # const UART: Clock = Clock::new("uart", Period::ns(40));
    /// # block! {
    /// #     struct Receiver;
    /// #     in ReceiverIn { line: bit().on(HOST) }
    /// #     out ReceiverOut { start: bit() }
    /// # }
    /// # impl Receiver {
    /// #     fn build(&self, m: Module, i: ReceiverIn) -> ReceiverOut {
    /// let m = m.on(UART);
    /// let line = m.synchronize_from(true, "line_here", i.line);
    /// let start = m.pipe("line_was", line) & !line; // a falling edge
    /// #         ReceiverOut { start }
    /// #     }
    /// # }
    /// # let design = elaborate(&Receiver).unwrap();
    /// # let resets = design.top().registers.iter().filter_map(|register| register.reset.as_ref()).count();
    /// # assert_eq!(resets, 2);
    /// ```
    #[track_caller]
    pub fn synchronize_from(self, reset: bool, name: &str, signal: Signal) -> Signal {
        let loc = Loc::caller();
        let enters = condition(signal, "synchronize").id();
        let signal = elaboration::with(|e| {
            let name = e.draft().prefixed(name);
            e.draft().synchronizers.push(Synchronizer { name, enters, loc });
            Signal::at(e, enters)
        });
        let entered = signal.quasi_static("enters a synchronizer");
        let meta = self.reg(&format!("{name}_meta"), 1).reset(reset);
        let stable = self.reg(name, 1).reset(reset);
        elaboration::draft(|draft| {
            [meta, stable].into_iter().for_each(|register| draft.registers[register.index].is_synchronizer = true);
        });
        meta.next(entered);
        stable.next(meta);
        *stable
    }
}
