//! Arrays, and arrays of arrays whose lanes have work to do.

use super::*;
use std::ops::Range;
use tilewright_hdl::ir::Reduction;

/// Parts of which each has arrays of the one before, with values that are mostly of one size.
pub fn nested() -> impl Strategy<Value = Vec<Part>> {
    let leaf = (vec(input(), 1..5), names_clocks(), vec(step(), 1..12));
    let outer = (vec(input(), 1..4), names_clocks(), vec(outer_step(), 1..6));
    let leaf = leaf.prop_map(|(inputs, names_clocks, steps)| Part { inputs, names_clocks, steps });
    let outer = outer.prop_map(|(inputs, names_clocks, steps)| Part { inputs, names_clocks, steps });
    let size =
        || prop_oneof![Just(Size::Any), Just(Size::Flags), Just(Size::Bytes), Just(Size::Halves), Just(Size::Words)];
    let sized = |part| (size(), part).prop_map(|(size, part)| resized(part, size));
    (sized(leaf.boxed()), vec(sized(outer.boxed()), 1..4)).prop_map(|(leaf, outer)| {
        let mut parts = vec![leaf];
        parts.extend(outer);
        parts
    })
}

/// A step of what surrounds other parts: half of them are arrays.
fn outer_step() -> impl Strategy<Value = Step> {
    let lanes = select(vec![2u32, 3, 4, 4, 5, 8, 8, 16, 16, 17, 33]);
    let array = lanes.prop_flat_map(|lanes| array(lanes..lanes + 1));
    prop_oneof![3 => on_a_clock(array.boxed()).boxed(), 2 => step().boxed()]
}

/// Of what size values mostly are.
#[derive(Debug, Clone, Copy)]
enum Size {
    Any,
    Flags,
    Bytes,
    Halves,
    Words,
}

impl Size {
    /// A width of that size, made of another one.
    fn fit(self, width: u32) -> u32 {
        match self {
            Size::Any => width,
            Size::Flags if width > 4 => 1 + width % 4,
            Size::Flags => 1,
            Size::Bytes => 1 + width % 8,
            Size::Halves => 9 + width % 8,
            Size::Words => 17 + width % 16,
        }
    }
}

/// The part with inputs and registers of some size. Memories keep their widths, so that there are some of another one.
fn resized(mut part: Part, size: Size) -> Part {
    part.inputs.iter_mut().for_each(|input| input.form.width = size.fit(input.form.width));
    for step in &mut part.steps {
        match &mut step.make {
            Make::Register { form: Form { width, .. }, .. } | Make::Chain { width, .. } => *width = size.fit(*width),
            Make::Lanes(work) => work.width = size.fit(work.width),
            Make::Records(records) => records.forms.iter_mut().for_each(|form| form.width = size.fit(form.width)),
            Make::Declared(declared) => declared.widths = declared.widths.map(|width| size.fit(width)),
            _ => {}
        }
    }
    part
}

/// An array with so many lanes.
pub fn array(lanes: Range<u32>) -> impl Strategy<Value = Make> {
    let reduction = || select(vec![Reduction::And, Reduction::Or, Reduction::Xor, Reduction::Add]);
    let feed = || {
        prop_oneof![
            2 => Just(Feed::Broadcast),
            2 => Just(Feed::Each),
            1 => Just(Feed::Index),
            1 => any::<u64>().prop_map(Feed::Table),
            4 => any::<u8>().prop_map(Feed::Link),
            1 => reduction().prop_map(Feed::Back),
            1 => any::<u8>().prop_map(Feed::Rotate),
            2 => (pick(), -3..4i8).prop_map(|(other, by)| Feed::Other(other, by)),
            2 => (binary(), pick()).prop_map(|(op, other)| Feed::Lifted(op, other)),
            1 => (binary(), pick()).prop_map(|(op, other)| Feed::LiftedTable(op, other)),
        ]
    };
    // The first value is often the same in all lanes.
    let first = prop_oneof![2 => Just(Feed::Broadcast), 1 => feed()];
    let inputs = ((first, pick()), vec((feed(), pick()), 0..5)).prop_map(|(first, mut rest)| {
        rest.insert(0, first);
        rest
    });
    let gather = prop_oneof![
        2 => reduction().prop_map(Gather::Reduce),
        1 => any::<u32>().prop_map(Gather::Lane),
        1 => Just(Gather::Concat),
    ];
    (part_pick(), lanes, any::<bool>(), inputs, vec(gather, 0..6)).prop_map(
        |(part, lanes, towards_lower, inputs, outputs)| Make::Array { part, lanes, towards_lower, inputs, outputs },
    )
}
