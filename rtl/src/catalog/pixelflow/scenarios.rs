//! Scenarios of PixelFlow's blocks. A scenario ignores the block's outputs. So it keeps a waiting input for as many
//! clocks as the block needs.

use tilewright_hdl::{Bits, Codes, Scenario, Script, Stream};

use super::super::shared::idle;
use crate::pixelflow::command_dma::{CommandDma, CommandDmaIn, Commands, Store};
use crate::pixelflow::compositor::{Compositor, CompositorIn, Mode};
use crate::pixelflow::controller::{ArrayController, ArrayControllerIn};
use crate::pixelflow::frame_buffer::{FrameBuffer, FrameBufferIn};
use crate::pixelflow::instruction::{Instruction, Sync};
use crate::pixelflow::linear_evaluator::{Coefficients, LinearEvaluator, LinearEvaluatorIn};
use crate::pixelflow::machine::{PixelFlow, PixelFlowIn};
use crate::pixelflow::network::{self, Network, NetworkIn};
use crate::pixelflow::network_port::{NetworkPort, NetworkPortIn, Transfer};
use crate::pixelflow::network_sequencer::{Job, NetworkSequencer, NetworkSequencerIn};
use crate::pixelflow::node::{DirectionIn, Node, NodeIn};
use crate::pixelflow::pixel::{
    Begin, Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, PixelProcessorIn, Source,
};
use crate::pixelflow::registers::PortAccess;
use crate::pixelflow::texture_memory::{
    Describe, TexelAddress, TexelWrite, TextureMemory, TextureMemoryIn, TexturePlace,
};
use crate::pixelflow::texture_unit::{TextureUnit, TextureUnitIn};
use crate::pixelflow::{ARRAY, TRANSFER};

/// Words of two bytes, from upstream and from the node, cycling over three kinds of pixels. In the first, upstream is
/// less; in the second, its second byte is greater; in the third, both are equal.
const WORDS: [[[u64; 2]; 2]; 3] =
    [[[0x10, 0x99], [0x20, 0x11]], [[0x30, 0x55], [0x30, 0x44]], [[0x40, 0x40], [0x40, 0x40]]];

/// The bytes of all pixels, in the sequence of arrival. Each item has four parts: whether the byte is the first of its
/// word, the pixel, the upstream byte, and the node's byte.
fn bytes(pixels: u32) -> impl Iterator<Item = (u64, u64, [u64; 2])> {
    let byte = move |number: usize| {
        (0..u64::from(pixels)).map(move |pixel| {
            let words = WORDS[pixel as usize % WORDS.len()];
            (u64::from(number == 0), pixel, words.map(|word| word[number]))
        })
    };
    (0..2).flat_map(byte)
}

pub(super) fn two_bytes(compositor: &Compositor) -> Scenario {
    let mut script = Script::new(compositor, TRANSFER);
    let mode = Mode::Composite.code();
    for (first, pixel, [upstream, own]) in bytes(compositor.pixels) {
        script.clock(&CompositorIn { mode, advances: 1, first, pixel, upstream, own });
    }
    script.wait(1);
    script.finish("words of two bytes for three pixels: upstream is less, the node's own is less, both are equal")
}

pub(super) fn composed_and_unloaded(port: &NetworkPort) -> Scenario {
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
                    bytes: in_each_chip(port.chips, port.width, upstream),
                },
                own: in_each_chip(port.chips, port.width, own),
            });
        }
    }
    script.clock_bits(&idle(port));
    script.finish(
        "words of two bytes are composed with the node's; then the node receives other words, and sends its own",
    )
}

pub(super) fn from_the_first_to_the_last(network: &Network) -> Scenario {
    let Network { nodes, ref port } = *network;
    let bytes: Vec<_> = bytes(port.pixels).collect();
    let mut script = Script::new(network, TRANSFER);
    for clock in 0..bytes.len() + nodes as usize {
        let node = |number: u32| {
            // Each node is one clock behind its predecessor.
            let turn = clock.checked_sub(number as usize).and_then(|turn| bytes.get(turn));
            let (first, own) = turn.map_or((0, 0), |(first, _, words)| (*first, words[number as usize % 2]));
            let mode = match number {
                0 => Mode::Load,
                _ if number + 1 == nodes => Mode::Unload,
                _ => Mode::Composite,
            };
            network::NodeIn {
                mode: Bits::new(2, mode.code()),
                sends: Bits::new(1, u64::from(number == 0 && turn.is_some())),
                first: Bits::new(1, first),
                own: in_each_chip(port.chips, port.width, own),
            }
        };
        script.clock_bits(&NetworkIn { nodes: (0..nodes).map(node).collect() });
    }
    script.finish("words of two bytes: the first node sends, those after it compose, and the last one gets the least")
}

fn in_each_chip(chips: u32, width: u32, byte: u64) -> Bits {
    Bits::join(&vec![Bits::new(width, byte); chips as usize])
}

/// A byte of depth inside an edge, in the bank that the network gets next.
fn depth_inside_an_edge() -> [Instruction<u64>; 4] {
    let (source, everybody) = (Source::Expression.code(), Mask::Everybody.code());
    let fill = Instruction { mask: everybody, stores: 1, length: 2, write: 256, c: 0xffff, ..Instruction::NOTHING };
    let edge = Instruction {
        source,
        condition: Condition::Positive.code(),
        enabling: Enabling::Replace.code(),
        skip: 1,
        a: 1,
        c: (1 << 40) - 3,
        ..Instruction::NOTHING
    };
    let mask = Mask::Enabled.code();
    let depth = Instruction {
        source,
        mask,
        stores: 1,
        skip: 1,
        length: 2,
        write: 256,
        a: 0x180,
        b: 0x2000,
        ..Instruction::NOTHING
    };
    let give = Instruction { sync: Sync::GiveBank.code(), ..Instruction::NOTHING };
    [fill, edge, depth, give]
}

pub(super) fn drawn_and_given(controller: &ArrayController) -> Scenario {
    let inputs = |valid, instruction, bank_done| ArrayControllerIn {
        instructions: Stream::of(valid, instruction),
        side_by_side: 0,
        bank_done,
        texture_done: 0,
    };
    let mut script = Script::new(controller, ARRAY.period);
    let mut before = 1;
    for instruction in depth_inside_an_edge() {
        script.hold(&inputs(1, instruction, 0), before);
        before = instruction.clocks();
    }
    // The controller waits for the bank; the network releases it after these clocks.
    let wait = Instruction { sync: Sync::AwaitBank.code(), ..Instruction::NOTHING };
    script.hold(&inputs(1, wait, 0), 4);
    script.clock(&inputs(1, wait, 1));
    script.clock(&inputs(1, wait, 0));
    script.clock(&inputs(0, wait, 0));
    script.wait(controller.width.max(controller.height).trailing_zeros() + 2);
    script.finish("a word is cleared, and evaluated inside an edge; its bank is given to the network and awaited")
}

pub(super) fn two_expressions(evaluator: &LinearEvaluator) -> Scenario {
    let mut script = Script::new(evaluator, ARRAY.period);
    for expression in [[0x00c0, 0, 0x0105], [0xffff, 2, 1]] {
        for byte in 0..2 {
            let [a, b, c] = expression.map(|number| number >> (8 * byte) & 0xff);
            script.clock(&LinearEvaluatorIn {
                coefficients: Coefficients { a, b, c },
                first: u64::from(byte == 0),
                sends: 1,
            });
        }
    }
    script.clock(&LinearEvaluatorIn { coefficients: Coefficients { a: 0, b: 0, c: 0 }, first: 0, sends: 0 });
    script.wait(evaluator.latency());
    script.finish("0xc0 x + 0x105, and immediately after it -x + 2 y + 1, in two bytes each, the lower byte first")
}

pub(super) fn add_compare_and_copy(pixel: &PixelProcessor) -> Scenario {
    let everybody = Control { mask: Mask::Everybody.code(), stores: 1, ..Control::ZERO };
    let add = Control { function: Function::Add.code(), begin: Begin::Zero.code(), ..everybody };
    let subtract = Control { function: Function::Compare.code(), begin: Begin::One.code(), ..Control::ZERO };
    let source = Source::Expression.code();
    let edge = Control { source, by_sign: 1, enabling: Enabling::Replace.code(), ..Control::ZERO };
    let (flagging, condition) = (Flagging::EnabledCondition.code(), Condition::Carry.code());
    let copy = Control { function: Function::Word.code(), mask: Mask::Flagged.code(), stores: 1, ..Control::ZERO };
    let word = |control: Control<u64>, read: u64, write: u64, constant: u64| {
        [0, 1].map(|byte| {
            let begin = if byte == 0 { control.begin } else { Begin::Kept.code() };
            let constant = constant >> (8 * byte) & 0xff;
            Control { begin, constant, read: read + byte, write: write + byte, ..control }
        })
    };
    let compare = word(subtract, 0, 0, 0x0210);
    let program = [
        &word(everybody, 0, 0, 0x01f0)[..],
        &word(add, 0, 0, 0x0020),
        &[edge],
        &[compare[0], Control { flagging, condition, ..compare[1] }],
        &word(copy, 0, 256, 0),
        &[Control::ZERO],
    ];
    let mut script = Script::new(pixel, ARRAY.period);
    for &control in program.iter().copied().flatten() {
        script.clock(&PixelProcessorIn { control, expression: 0x3c, register_byte: 0 });
    }
    script.wait(1);
    script.finish(
        "0x01f0 is written and 0x20 added; inside an edge, the sum is at least 0x0210 and goes to the registers",
    )
}

pub(super) fn two_frames(dma: &CommandDma) -> Scenario {
    let mut script = Script::new(dma, ARRAY.period);
    let none = Commands { base: 0, length: 0 };
    let program = depth_inside_an_edge();
    let words = u64::from(dma.words).min(program.len() as u64);
    let inputs = |store: Option<u64>, frame: Option<u64>| CommandDmaIn {
        store: Store {
            writes: store.is_some().into(),
            address: store.unwrap_or(0),
            instruction: program[store.unwrap_or(0) as usize],
        },
        frames: Stream::of(frame.is_some().into(), frame.map_or(none, |length| Commands { base: 0, length })),
    };
    (0..words).for_each(|address| script.clock(&inputs(Some(address), None)));
    script.ready("instructions", true);
    script.clock(&inputs(None, Some(words)));
    script.clock(&inputs(None, Some(1)));
    script.clock(&inputs(None, None));
    script.wait(words + 6);
    script.finish("instructions are written; a frame with all of them is fetched, then one with only the first")
}

pub(super) fn loaded_and_forwarded(sequencer: &NetworkSequencer) -> Scenario {
    let mut script = Script::new(sequencer, TRANSFER);
    let none = NetworkSequencerIn {
        jobs: Stream::of(0, Job { mode: Mode::Forward.code(), bank: 0, bytes: 2 }),
        given: 1,
        go: 0,
        pixel: 0,
        advances: 0,
    };
    for mode in [Mode::Load, Mode::Forward] {
        script
            .clock(&NetworkSequencerIn { jobs: Stream::of(1, Job { mode: mode.code(), ..none.jobs.payload }), ..none });
        script.hold(&none, sequencer.setup + 3);
        script.clock(&NetworkSequencerIn { go: 1, ..none });
        for pixel in (0..2).flat_map(|_| 0..u64::from(sequencer.pixels)) {
            script.clock(&NetworkSequencerIn { advances: 1, pixel, ..none });
        }
    }
    script.clock(&none);
    script.wait(1);
    script.finish("a word of two bytes is loaded from a bank; then another is forwarded")
}

pub(super) fn drawn_and_sent(node: &Node) -> Scenario {
    let program = depth_inside_an_edge();
    let written = program.len().min(node.words as usize);
    let no_job = Job { mode: Mode::Load.code(), bank: 0, bytes: 2 };
    let direction = |job: u64| DirectionIn {
        jobs: Stream::of(job, no_job),
        go: 1,
        upstream: Transfer { valid: 0, first: 0, bytes: 0 },
    };
    let quiet = NodeIn {
        store: Store { writes: 0, address: 0, instruction: Instruction::NOTHING },
        frames: Stream::of(0, Commands { base: 0, length: written as u64 }),
        side_by_side: 1,
        texture: PortAccess { pixel: 0, address: 0, writes: 0, bytes: 0 },
        texture_done: 0,
        network: vec![direction(0), direction(0)],
    };

    let mut script = Script::new(node, ARRAY.period);
    for (address, &instruction) in (0..).zip(&program[..written]) {
        script.clock(&NodeIn { store: Store { writes: 1, address, instruction }, ..quiet.clone() });
    }
    script.clock(&NodeIn { frames: Stream::of(1, quiet.frames.payload), ..quiet.clone() });
    // The network's clock is twice as fast: a job is shown for only one of its edges.
    script.in_clocks_of(TRANSFER);
    script.clock(&NodeIn { network: vec![direction(1), direction(0)], ..quiet.clone() });
    script.clock(&quiet);
    let array = program.iter().map(Instruction::clocks).sum::<u64>() + u64::from(node.array.latency()) + 10;
    let network = u64::from(node.setup + 2 * node.port().pixels) + 10;
    script.wait(2 * array + network);
    script.finish(
        "instructions are written and fetched; a word is drawn, and its bank is given to the network, which sends it",
    )
}

pub(super) fn drawn_by_all_and_composed(machine: &PixelFlow) -> Scenario {
    let (node, nodes) = (&machine.node, machine.nodes);
    let program = depth_inside_an_edge();
    let written = program.len().min(node.words as usize);
    let job = |shown: u64, number: u32| {
        let mode = match number {
            0 => Mode::Load,
            _ if number + 1 == nodes => Mode::Unload,
            _ => Mode::Composite,
        };
        Stream::of(shown, Job { mode: mode.code(), bank: 0, bytes: 2 })
    };
    // All nodes draw the same; nothing goes back.
    let inputs = |store, frames, jobs| PixelFlowIn {
        stores: vec![store; nodes as usize],
        frames: vec![Stream::of(frames, Commands { base: 0, length: written as u64 }); nodes as usize],
        side_by_side: 1,
        textures: vec![PortAccess { pixel: 0, address: 0, writes: 0, bytes: 0 }; nodes as usize],
        textures_done: 0,
        forth: (0..nodes).map(|number| job(jobs, number)).collect(),
        back: (0..nodes).map(|number| job(0, number)).collect(),
    };
    let none = Store { writes: 0, address: 0, instruction: Instruction::NOTHING };
    let mut script = Script::new(machine, ARRAY.period);
    for (address, &instruction) in (0..).zip(&program[..written]) {
        script.clock(&inputs(Store { writes: 1, address, instruction }, 0, 0));
    }
    script.clock(&inputs(none, 1, 0));
    // The network's clock is twice as fast: a job is shown for only one of its edges.
    script.in_clocks_of(TRANSFER);
    script.clock(&inputs(none, 0, 1));
    script.clock(&inputs(none, 0, 0));
    let array = program.iter().map(Instruction::clocks).sum::<u64>() + u64::from(node.array.latency()) + 10;
    let network = u64::from(node.setup + 2 * node.port().pixels + nodes) + 10;
    script.wait(2 * array + network);
    script.finish(
        "all nodes draw a word; the first one sends its own, those after it compose, and the last one keeps the result",
    )
}

/// A texture of 2 x 2 texels and the level above it, as the memory gets them: the writes, and where the texture is.
fn checkers(memory: &TextureMemory) -> (Describe<u64>, Vec<TexelWrite<u64>>) {
    let finest = if u64::from(memory.texels) < TextureMemory::size(1) { 0 } else { 1 };
    let texels = (0..=finest).flat_map(|level| {
        let side = 1u64 << level;
        (0..side * side).map(move |number| {
            let (i, j) = (number % side, number / side);
            let TexelAddress { bank, address } = TextureMemory::place(0, level, i, j);
            let texel = if level == 0 { 0x80_8080 } else { 0x11_1111 * (1 + i + 2 * j) };
            TexelWrite { valid: 1, bank, address, texel }
        })
    });
    (Describe { valid: 1, texture: 0, base: 0, finest: finest.into() }, texels.collect())
}

pub(super) fn places(memory: &TextureMemory) -> Scenario {
    let (describe, texels) = checkers(memory);
    let quiet = TextureMemoryIn::default();
    let mut script = Script::new(memory, ARRAY.period);
    script.clock(&TextureMemoryIn { describe, ..quiet });
    texels.into_iter().for_each(|write| script.clock(&TextureMemoryIn { write, ..quiet }));
    for (u, level) in [(0x4000, 0), (0xc000, 0), (0x8000, 1)] {
        script.clock(&TextureMemoryIn { request: TexturePlace { valid: 1, u, v: 0x4000, level, texture: 0 }, ..quiet });
    }
    script.clock(&quiet);
    script.wait(3);
    script.finish("a texture of 2 x 2 texels is written, and the texels around three places are read")
}

pub(super) fn a_region_of_texels(unit: &TextureUnit) -> Scenario {
    let (describe, texels) = checkers(&unit.memory);
    // All pixels ask for a place at the left, on level 0.
    let quiet = TextureUnitIn::default();
    let mut script = Script::new(unit, ARRAY.period);
    script.clock(&TextureUnitIn { describe, ..quiet });
    texels.into_iter().for_each(|write| script.clock(&TextureUnitIn { write, ..quiet }));
    script.clock(&TextureUnitIn { start: 1, ..quiet });
    script.clock(&quiet);
    script.wait(unit.clocks().min(400) + 2);
    script.finish("a texture of 2 x 2 texels is written, and the pixels of a region get the texels around a place")
}

pub(super) fn a_frame_is_shown(buffer: &FrameBuffer) -> Scenario {
    let inputs = |start: u64, byte: u64| FrameBufferIn {
        start: Bits::new(1, start),
        seen: in_each_chip(buffer.chips(), 8, byte),
    };
    let mut script = Script::new(buffer, ARRAY.period);
    script.ready("pixels", true);
    let ([across, down], clocks) = (buffer.regions(), buffer.clocks());
    // One region of a large array takes long enough.
    let regions = u64::from(across * down).min((1000 / clocks).clamp(1, 4));
    for region in 0..regions {
        script.clock_bits(&inputs(1, 0));
        (0..clocks).for_each(|clock| script.clock_bits(&inputs(0, (0x40 * region + clock) & 0xff)));
    }
    script.clock_bits(&inputs(0, 0));
    script.wait(40);
    script.finish("regions are loaded, byte by byte from each chip; after the last one the frame is shown")
}
