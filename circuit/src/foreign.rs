//! What a foreign module is made of, step by step.

use crate::clock::Clock;
use crate::ir::{Attribute, Foreign, Parameter};
use crate::loc::Loc;
use crate::names::port_name;

impl Foreign {
    /// The Verilog module of this name, such as `SB_PLL40_CORE`. `block!` has the clause `foreign` for
    /// this module. The block's ports are those of the module, and the block's `build` is a model of the module.
    ///
    /// In simulation the model stands for the module. Verilog has an instance of the module with its parameters. If the
    /// macro `TILEWRIGHT_MODELS` is defined, it has an instance of the model instead.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// The sum of two words, in a DSP slice of somebody's chip.
    ///     struct Adder { width: u32 }
    ///     foreign(self) = Foreign::module("DSP_ADD").parameter("WIDTH", self.width).parameter("MODE", "FAST").capitals();
    ///     in(self) AdderIn { a: bits(self.width), b: bits(self.width) }
    ///     out AdderOut { sum: _ }
    /// }
    ///
    /// impl Adder {
    ///     fn build(&self, _: Module, i: AdderIn) -> AdderOut {
    ///         AdderOut { sum: i.a + i.b }
    ///     }
    /// }
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { twice: bits(8) }
    ///
    /// def!(adder = m.instance(&Adder { width: 8 }, AdderIn { a: i.word, b: i.word }));
    /// #     ShownOut { twice: adder.sum }
    /// # };
    /// let text = &tilewright_gen::verilog(&design)[1].text;
    /// assert!(text.contains(".WIDTH (8),\n        .MODE  (\"FAST\")\n    ) u_adder ("));
    /// assert!(text.contains(".SUM (twice)"));
    /// ```
    #[track_caller]
    pub fn module(name: &str) -> Foreign {
        Foreign {
            module: name.to_owned(),
            parameters: Vec::new(),
            attributes: Vec::new(),
            capitals: false,
            ports: Vec::new(),
            clocks: Vec::new(),
            resets: Vec::new(),
            makes: Vec::new(),
            loc: Loc::caller(),
        }
    }

    /// Gives a parameter a value: an integer, a text, a real number, or [`Bits`](crate::Bits) for a constant of a
    /// certain width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let pll = Foreign::module("SB_PLL40_CORE").parameter("FEEDBACK_PATH", "SIMPLE").parameter("DIVF", Bits::new(7, 63));
    /// assert_eq!(pll.parameters[1], ("DIVF".to_owned(), ir::Parameter::Bits(Bits::new(7, 63))));
    /// ```
    #[must_use]
    pub fn parameter(mut self, name: &str, value: impl Into<Parameter>) -> Foreign {
        self.parameters.push((name.to_owned(), value.into()));
        self
    }

    /// Sets an attribute of each instance.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let pll = Foreign::module("EHXPLLL").attribute("FREQUENCY_PIN_CLKI", "25");
    /// assert_eq!(pll.attributes[0].value, "25");
    /// ```
    #[must_use]
    pub fn attribute(mut self, name: &str, value: &str) -> Foreign {
        self.attributes.push(Attribute { name: name.to_owned(), value: value.to_owned() });
        self
    }

    /// The module's ports are in capitals: `D_IN_0` for the block's `d_in_0`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(Foreign::module("SB_IO").capitals().capitals);
    /// ```
    #[must_use]
    pub fn capitals(self) -> Foreign {
        Foreign { capitals: true, ..self }
    }

    /// The module's name for a port of the block. Each element of a list has this name with the element's number: `A0`,
    /// `A1` for the list `a` if `name` is `A`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// A bit that passes a buffer of the chip.
    ///     struct Buffer;
    ///     foreign = Foreign::module("BUF").port("word", "I").port("same", "O");
    ///     in BufferIn { word: bit() }
    ///     out BufferOut { same: bit() }
    /// }
    /// # impl Buffer {
    /// #     fn build(&self, _: Module, i: BufferIn) -> BufferOut {
    /// #         BufferOut { same: i.word }
    /// #     }
    /// # }
    ///
    /// let buffer = elaborate(&Buffer)?;
    /// assert_eq!((&*buffer.top().inputs[0].name, &*buffer.top().outputs[0].name), ("I", "O"));
    /// # Ok::<(), Problems>(())
    /// ```
    #[must_use]
    pub fn port(mut self, port: &str, name: &str) -> Foreign {
        self.ports.push((port.to_owned(), name.to_owned()));
        self
    }

    /// The module's port for the clock of the block.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// A flip-flop of an iCE40.
    ///     struct FlipFlop;
    ///     foreign = Foreign::module("SB_DFFSR").clock("C").reset("R").capitals();
    ///     in FlipFlopIn { d: bit() }
    ///     out FlipFlopOut { q: bit() }
    /// }
    ///
    /// impl FlipFlop {
    ///     fn build(&self, m: Module, i: FlipFlopIn) -> FlipFlopOut {
    ///         def!(held = m.reg(1).reset(0));
    ///         held.next(i.d);
    ///         FlipFlopOut { q: *held }
    ///     }
    /// }
    ///
    /// let design = elaborate(&FlipFlop)?;
    /// let clock = &design.top().clocks[0];
    /// assert_eq!((&*clock.port, clock.reset.as_deref()), ("C", Some("R")));
    /// # Ok::<(), Problems>(())
    /// ```
    #[must_use]
    pub fn clock(mut self, name: &str) -> Foreign {
        self.clocks.push((None, name.to_owned()));
        self
    }

    /// The module's port for the reset of the block, which is synchronous and active high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let flip_flop = Foreign::module("SB_DFFSR").clock("C").reset("R");
    /// assert_eq!(flip_flop.resets, [(None, "R".to_owned())]);
    /// ```
    #[must_use]
    pub fn reset(mut self, name: &str) -> Foreign {
        self.resets.push((None, name.to_owned()));
        self
    }

    /// The module's port for a clock by name.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let memory = Foreign::module("SB_RAM40_4K").clock("WCLK").clock_of(VIDEO, "RCLK");
    /// assert_eq!(memory.clocks[1], (Some(VIDEO), "RCLK".to_owned()));
    /// ```
    #[must_use]
    pub fn clock_of(mut self, clock: Clock, name: &str) -> Foreign {
        self.clocks.push((Some(clock), name.to_owned()));
        self
    }

    /// The module's port for the reset of a clock by name.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let queue = Foreign::module("FIFO").clock("WCLK").clock_of(VIDEO, "RCLK").reset_of(VIDEO, "RRST");
    /// assert_eq!(queue.resets, [(Some(VIDEO), "RRST".to_owned())]);
    /// ```
    #[must_use]
    pub fn reset_of(mut self, clock: Clock, name: &str) -> Foreign {
        self.resets.push((Some(clock), name.to_owned()));
        self
    }

    /// The module makes this clock at an output, as a PLL does. The module is instantiated in the top of the design,
    /// which then has no port for the clock. In simulation the clock has the period of its declaration, whatever the
    /// model does.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ps(39_722));
    ///
    /// block! {
    ///     /// A PLL of an iCE40 that makes 25.175 MHz of 12 MHz.
    ///     struct Pll;
    ///     foreign = Foreign::module("SB_PLL40_CORE")
    ///         .parameter("FEEDBACK_PATH", "SIMPLE")
    ///         .parameter("DIVR", Bits::new(4, 0))
    ///         .parameter("DIVF", Bits::new(7, 66))
    ///         .parameter("DIVQ", Bits::new(3, 5))
    ///         .parameter("FILTER_RANGE", Bits::new(3, 1))
    ///         .clock("REFERENCECLK")
    ///         .makes(VIDEO, "PLLOUTCORE")
    ///         .capitals();
    ///     in PllIn { resetb: bit(), bypass: bit() }
    ///     out PllOut { lock: bit() }
    /// }
    ///
    /// impl Pll {
    ///     fn build(&self, m: Module, i: PllIn) -> PllOut {
    ///         m.ignore(&i);
    ///         PllOut { lock: lit(1, 1) }
    ///     }
    /// }
    /// # let design = tilewright_sim::shown! { |m, i| in { enable: bit().on(VIDEO) } out { count: bits(8) }
    ///
    /// def!(pll = m.instance(&Pll, PllIn { resetb: lit(1, 1), bypass: lit(1, 0) }));
    /// # let _ = pll;
    /// def!(count = m.on(VIDEO).reg(8).reset(0));
    /// count.when(i.enable, count + 1);
    /// #     ShownOut { count: *count }
    /// # };
    /// assert!(tilewright_gen::verilog(&design)[1].text.contains(".PLLOUTCORE   (video_clk),"));
    /// ```
    #[must_use]
    pub fn makes(mut self, clock: Clock, name: &str) -> Foreign {
        self.makes.push((clock, name.to_owned()));
        self
    }

    /// The module's name for the port with this path in a bundle.
    #[doc(hidden)]
    pub fn port_called(&self, path: &str) -> String {
        let named = |(port, name): &(String, String)| match path.strip_prefix(port.as_str())?.strip_prefix('.') {
            None if path == port => Some(name.clone()),
            Some(number) if number.bytes().all(|digit| digit.is_ascii_digit()) => Some(format!("{name}{number}")),
            _ => None,
        };
        self.ports.iter().find_map(named).unwrap_or_else(|| match self.capitals {
            true => port_name("", path).to_ascii_uppercase(),
            false => port_name("", path),
        })
    }

    /// The port for a clock, if the module has one.
    #[doc(hidden)]
    pub fn clock_port(&self, clock: Option<Clock>) -> Option<&str> {
        of_clock(&self.clocks, clock)
    }

    /// The port for the reset of a clock, if the module has one.
    #[doc(hidden)]
    pub fn reset_port(&self, clock: Option<Clock>) -> Option<&str> {
        of_clock(&self.resets, clock)
    }
}

fn of_clock(ports: &[(Option<Clock>, String)], clock: Option<Clock>) -> Option<&str> {
    let name = |clock: Option<Clock>| clock.map(|clock| clock.name);
    ports.iter().find(|(of, _)| name(*of) == name(clock)).map(|(_, port)| port.as_str())
}
