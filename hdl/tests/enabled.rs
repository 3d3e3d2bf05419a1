//! Enabled parts, as they stand in the circuit.

use tilewright_hdl::*;

const VIDEO: Clock = Clock::new("video", Period::ns(40));

block! {
    /// A register, also on a clock of its own.
    struct Late { clock: Clock }
    in LateIn { x: bit() }
    out LateOut { y: bit(), z: bit() }
}

impl Late {
    fn build(&self, m: Module, i: LateIn) -> LateOut {
        def!(y = m.pipe(i.x));
        LateOut { y, z: m.on(self.clock).pipe("z", lit(1, 1)) }
    }
}

block! {
    /// No register.
    struct Invert;
    in InvertIn { clk_en: bit() }
    out InvertOut { y: bit() }
}

impl Invert {
    fn build(&self, _: Module, i: InvertIn) -> InvertOut {
        InvertOut { y: !i.clk_en }
    }
}

block! {
    /// An input with the name that the enable would have.
    struct Taken;
    in TakenIn { clk_en: bit() }
    out TakenOut { y: bit() }
}

impl Taken {
    fn build(&self, m: Module, i: TakenIn) -> TakenOut {
        def!(invert = m.instance(&Invert, InvertIn { clk_en: i.clk_en }));
        TakenOut { y: m.pipe("late", invert.y) }
    }
}

fn modules<B: Block>(block: &B) -> Vec<String> {
    let design = elaborate(block).unwrap();
    design.modules().iter().map(|module| module.name.clone()).collect()
}

block! {
    /// Places blocks in and outside of enabled parts.
    struct Places;
    in PlacesIn { a: bit(), b: bit(), v: bit().on(VIDEO) }
    out PlacesOut { y: bits(6), z: bits(6) }
}

impl Places {
    fn build(&self, m: Module, i: PlacesIn) -> PlacesOut {
        let late = |name: &str| m.instance(name, &Late { clock: VIDEO }, LateIn { x: i.a });
        let video = m.on(VIDEO);
        let all = [
            late("u_plain"),
            m.enabled(i.a, || late("u_a")),
            m.enabled(i.b, || m.enabled(i.a, || late("u_both"))),
            video.enabled(i.v, || late("u_video")),
            video.enabled(i.v, || m.enabled(i.b, || late("u_two"))),
            m.enabled(i.b, || m.array("u_row", 2, &Late { clock: VIDEO }, |_| LateIn { x: i.b })).lane(1),
        ];
        PlacesOut { y: concat(&all.map(|late| late.y)), z: concat(&all.map(|late| late.z)) }
    }
}

#[test]
fn a_block_has_a_module_for_each_set_of_clocks_that_are_enabled() {
    let names = modules(&Places);
    let plain = names[0].clone();
    let suffixes: Vec<_> = names.iter().map(|name| name.strip_prefix(&plain).unwrap_or(name)).collect();
    assert_eq!(suffixes, ["", "_enabled", "_enabled_video", "_enabled_clk_video", "places"]);
    let design = elaborate(&Places).unwrap();
    let inputs =
        |index: usize| design.modules()[index].inputs.iter().map(|input| input.name.clone()).collect::<Vec<_>>();
    assert_eq!(inputs(0), ["x"]);
    assert_eq!(inputs(1), ["x", "clk_en"]);
    assert_eq!(inputs(2), ["x", "video_clk_en"]);
    assert_eq!(inputs(3), ["x", "clk_en", "video_clk_en"]);
    // An instance is fed the enables of its place.
    let top = design.top();
    let fed = |index: usize| top.instances[index].inputs[1..].to_vec();
    let [a, b, v] = [0, 1, 2].map(|input| top.inputs[input].node);
    assert_eq!((fed(1), fed(3), fed(4)), (vec![a], vec![v], vec![b, v]));
    assert!(matches!(top.node(fed(2)[0]).op, ir::Op::Binary(ir::Binary::And, ..)));
}

block! {
    /// A block without a register, in an enabled part and outside.
    struct Plain;
    in PlainIn { a: bit(), b: bit() }
    out PlainOut { y: bits(3) }
}

impl Plain {
    fn build(&self, m: Module, i: PlainIn) -> PlainOut {
        let first = m.enabled(i.a, || m.instance("u_first", &Invert, InvertIn { clk_en: i.b }));
        let second = m.instance("u_second", &Invert, InvertIn { clk_en: first.y });
        let taken = m.enabled(i.a, || m.instance("u_taken", &Taken, TakenIn { clk_en: i.b }));
        PlainOut { y: cat![first.y, second.y, taken.y] }
    }
}

#[test]
fn a_block_without_state_has_one_module_and_the_enable_a_free_name() {
    assert_eq!(modules(&Plain), ["invert", "taken_enabled", "plain"]);
    let design = elaborate(&Plain).unwrap();
    let inputs: Vec<_> = design.modules()[1].inputs.iter().map(|input| &*input.name).collect();
    assert_eq!(inputs, ["clk_en", "clk_en_1"]);
}

/// `pipe` adds a stage within an enabled part, too.
#[test]
fn stages_of_a_pipeline_are_known_within_an_enabled_part() {
    tilewright_sim::example(|m| {
        bundle! { struct Pair<T> { x: T, y: T } }
        def!(on = m.reg(1).reset(0));
        on.next(!on);
        m.enabled(on, || {
            def!(count = m.reg(4).reset(0));
            count.next(count + 1);
            let start = Pair { x: *count, y: lit(4, 4) };
            let pairs = m.stages(2, None, start.cleared(|pair| [pair.x, pair.y]), |_, pair| pair);
            let beside = m.pipe("second", m.pipe("first", *count));
            m.assert(m.past(m.past(lit(1, 1))).implies((pairs.x ^ beside).eq(0)), "both are two enabled clocks late");
        });
    });
}
