//! The entries of PixelFlow's node and its parts.

use tilewright_hdl::{Bits, Codes, Scenario, Script, elaborate_at};

use super::shared::idle;
use super::{Entry, Parameter, Values};
use crate::pixelflow::TRANSFER;
use crate::pixelflow::compositor::{Compositor, CompositorIn, Mode};
use crate::pixelflow::network_port::{NetworkPort, NetworkPortIn, Transfer};

const CHIPS: Parameter = Parameter { name: "chips", default: 2, min: 1, max: 64, meaning: "chips of the node" };
const PIXELS: Parameter = Parameter { name: "pixels", default: 4, min: 1, max: 1024, meaning: "pixels of a chip" };

/// The bits of a byte.
const WIDTH: u32 = 8;

pub(super) const NETWORK_PORT: Entry = Entry {
    name: "network-port",
    summary: "connects a node to the network that composes images",
    parameters: &[CHIPS, PIXELS],
    design: |values| Ok(elaborate_at(&network_port(values), TRANSFER)?),
    scenario: |values| Ok(composed_and_unloaded(&network_port(values))),
};

pub(super) const COMPOSITOR: Entry = Entry {
    name: "compositor",
    summary: "sends on the lesser of two words of each pixel, byte by byte",
    parameters: &[PIXELS],
    design: |values| Ok(elaborate_at(&compositor(values), TRANSFER)?),
    scenario: |values| Ok(two_bytes(&compositor(values))),
};

fn network_port(values: &Values) -> NetworkPort {
    NetworkPort { chips: values.get_u32("chips"), pixels: values.get_u32("pixels"), width: WIDTH }
}

fn compositor(values: &Values) -> Compositor {
    Compositor { pixels: values.get_u32("pixels"), width: WIDTH }
}

/// Words of two bytes, of upstream and of the node, which pixels have in turn: the first is less than the other, then its second
/// byte is more, then they are equal.
const WORDS: [[[u64; 2]; 2]; 3] =
    [[[0x10, 0x99], [0x20, 0x11]], [[0x30, 0x55], [0x30, 0x44]], [[0x40, 0x40], [0x40, 0x40]]];

/// The bytes of all pixels as they come: whether it is the first of its word, the pixel, the bytes of upstream and of the node.
fn bytes(pixels: u32) -> impl Iterator<Item = (u64, u64, [u64; 2])> {
    let byte = move |number: usize| {
        (0..u64::from(pixels)).map(move |pixel| {
            let words = WORDS[pixel as usize % WORDS.len()];
            (u64::from(number == 0), pixel, words.map(|word| word[number]))
        })
    };
    (0..2).flat_map(byte)
}

fn two_bytes(compositor: &Compositor) -> Scenario {
    let mut script = Script::new(compositor, TRANSFER);
    let mode = Mode::Composite.code();
    for (first, pixel, [upstream, own]) in bytes(compositor.pixels) {
        script.clock(&CompositorIn { mode, advances: 1, first, pixel, upstream, own });
    }
    script.wait(1);
    script.finish("words of two bytes: of three pixels the first is less, then the node's own, then they are equal")
}

fn composed_and_unloaded(port: &NetworkPort) -> Scenario {
    let mut script = Script::new(port, TRANSFER);
    for mode in [Mode::Composite, Mode::Unload, Mode::Load] {
        for (first, _, [upstream, own]) in bytes(port.pixels) {
            let comes = u64::from(mode != Mode::Load);
            script.clock_bits(&NetworkPortIn {
                mode: Bits::new(2, mode.code()),
                sends: Bits::new(1, 1 - comes),
                first: Bits::new(1, (1 - comes) & first),
                upstream: Transfer {
                    valid: Bits::new(1, comes),
                    first: Bits::new(1, comes & first),
                    bytes: in_each_chip(port, upstream),
                },
                own: in_each_chip(port, own),
            });
        }
    }
    script.clock_bits(&idle(port));
    script
        .finish("words of two bytes come and are composed with the node's, then it takes others, then it sends its own")
}

fn in_each_chip(port: &NetworkPort, byte: u64) -> Bits {
    let byte = Bits::new(WIDTH, byte);
    (1..port.chips).fold(byte.clone(), |bytes, _| bytes.concat(&byte))
}
