//! The kind of reset is a property of a clock, and a block has a module for each kind that it is built for.

use tilewright_hdl::*;

block! {
    /// Counts up.
    struct Counter;
    out CounterOut { count: bits(4) }
}

impl Counter {
    fn build(&self, m: Module, _: ()) -> CounterOut {
        def!(count = m.reg(4).reset(9));
        count.next(count + 1);
        CounterOut { count: *count }
    }
}

block! {
    /// A word, a clock later.
    struct Delay;
    in DelayIn { word: bits(4) }
    out DelayOut { late: bits(4) }
}

impl Delay {
    fn build(&self, m: Module, i: DelayIn) -> DelayOut {
        DelayOut { late: m.pipe("late", i.word) }
    }
}

const VIDEO: Clock = Clock::new("video", Period::ns(40)).reset(Reset::AsynchronousLow);
const HOST: Clock = Clock::new("host", Period::ns(30)).reset(Reset::PowerOn);

block! {
    /// The same two blocks on three clocks.
    struct Thrice;
    out ThriceOut { own: bits(4), video: bits(4), host: bits(4) }
}

impl Thrice {
    fn build(&self, m: Module, _: ()) -> ThriceOut {
        let on = |m: Module, name: &str| {
            let count = m.instance(&format!("u_{name}"), &Counter, ()).count;
            m.instance(&format!("u_{name}_late"), &Delay, DelayIn { word: count }).late
        };
        ThriceOut { own: on(m, "own"), video: on(m.on(VIDEO), "video"), host: on(m.on(HOST), "host") }
    }
}

fn modules(design: &Design) -> Vec<String> {
    let with_ports = |module: &ir::Module| {
        let ports = module.clocks.iter().flat_map(|clock| [Some(clock.port.clone()), clock.reset.clone()]).flatten();
        format!("{}: {}", module.name, ports.collect::<Vec<_>>().join(" "))
    };
    design.modules().iter().map(with_ports).collect()
}

#[test]
fn a_block_has_a_module_for_each_kind_of_reset() {
    let of_all = |own: &str, video: &str, host: &str, rst: &str| {
        let top = format!("thrice: clk {rst}video_clk video_rst_n host_clk");
        [own, "delay: clk", video, host, &top].map(str::to_owned)
    };
    let usual = of_all("counter: clk rst", "counter_asynchronous_low: clk rst_n", "counter_power_on: clk", "rst ");
    assert_eq!(modules(&elaborate(&Thrice).unwrap()), usual);
    // The kind of the top's own clock is in no name.
    let own = |reset| elaborate_at(&Thrice, DefaultClock::new(DEFAULT_PERIOD).reset(reset)).unwrap();
    assert_eq!(
        modules(&own(Reset::SynchronousLow)),
        of_all("counter: clk rst_n", "counter_asynchronous_low: clk rst_n", "counter_power_on: clk", "rst_n ")
    );
    let two = [
        "counter: clk rst_n",
        "delay: clk",
        "counter_power_on: clk",
        "thrice: clk rst_n video_clk video_rst_n host_clk",
    ];
    assert_eq!(modules(&own(Reset::AsynchronousLow)), two);
    let two = [
        "counter: clk",
        "delay: clk",
        "counter_asynchronous_low: clk rst_n",
        "thrice: clk video_clk video_rst_n host_clk",
    ];
    assert_eq!(modules(&own(Reset::PowerOn)), two);
}

#[test]
fn a_clock_among_the_parameters_is_in_the_name_of_a_module_by_its_own_name() {
    block! {
        /// Takes a clock.
        struct Timed { clock: Clock }
        out TimedOut { count: bits(4) }
    }
    impl Timed {
        fn build(&self, m: Module, _: ()) -> TimedOut {
            TimedOut { count: m.on(self.clock).instance("u_count", &Counter, ()).count }
        }
    }
    let design = elaborate(&Timed { clock: VIDEO }).unwrap();
    assert_eq!(modules(&design), ["counter_asynchronous_low: clk rst_n", "timed_clock_video: video_clk video_rst_n"]);
    let shown = "Timed { clock: Clock { name: \"video\", period: Period(40000), reset: AsynchronousLow } }";
    assert_eq!(design.top().parameters, shown);
}

#[test]
fn a_clock_that_only_an_instance_resets_is_of_that_kind_in_the_top() {
    const BOARD: Clock = Clock::new("board", Period::ns(4)).reset(Reset::PowerOn);
    block! {
        /// Counts.
        struct Inner;
        out InnerOut { count: bits(4) }
    }
    impl Inner {
        fn build(&self, m: Module, _: ()) -> InnerOut {
            def!(count = m.on(BOARD).reg(4).reset(3));
            count.next(count + 1);
            InnerOut { count: *count }
        }
    }
    block! {
        /// Has a counter.
        struct Outer;
        out OuterOut { count: bits(4) }
    }
    impl Outer {
        fn build(&self, m: Module, _: ()) -> OuterOut {
            OuterOut { count: m.instance("u_inner", &Inner, ()).count }
        }
    }
    let design = elaborate(&Outer).unwrap();
    assert_eq!((design.top().clocks[0].kind, &design.top().clocks[0].reset), (Reset::PowerOn, &None));
}

#[test]
fn a_block_has_a_module_for_each_edge() {
    const FALLING: Clock = Clock::new("video", Period::ns(40)).falling();
    block! {
        /// The same two blocks on both edges.
        struct Both;
        out BothOut { own: bits(4), video: bits(4) }
    }
    impl Both {
        fn build(&self, m: Module, _: ()) -> BothOut {
            let on = |m: Module, name: &str| {
                let count = m.instance(&format!("u_{name}"), &Counter, ()).count;
                m.instance(&format!("u_{name}_late"), &Delay, DelayIn { word: count }).late
            };
            BothOut { own: on(m, "own"), video: on(m.on(FALLING), "video") }
        }
    }
    let names = |clock: DefaultClock| {
        let design = elaborate_at(&Both, clock).unwrap();
        design.modules().iter().map(|module| format!("{} {:?}", module.name, module.clocks[0].edge)).collect::<Vec<_>>()
    };
    let rising = DefaultClock::new(DEFAULT_PERIOD);
    let both = ["counter Rising", "delay Rising", "counter_falling Falling", "delay_falling Falling", "both Rising"];
    assert_eq!(names(rising), both);
    // The edge of the top's own clock is in no name.
    assert_eq!(names(rising.falling()), ["counter Falling", "delay Falling", "both Falling"]);
}
