//! The renderer of the pixel in each clock.

mod tell;

use std::collections::{BTreeMap, VecDeque};

use tilewright_hdl::Bits;
use tilewright_hdl::Codes;
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::pixel::{Enabling, Mask, PixelProcessor, Source};
use tilewright_rtl::pixel_planes::renderer::{Renderer, RendererIn, RendererOut};
use tilewright_sim::{Memory, Simulation};

use super::commands::{CURVE, Commands, NETS, SAVES, Taken};
use super::units::{CONTROL, Expressions, Pixel, Store, Stored, TICK};
use super::wires::Wires;
use crate::looks::Looks;
use crate::told::{Checks, Told, Unit, value};

/// Clocks at the beginning in which all wires are looked at.
const CLOCKS_OF_ALL: u64 = 256;

pub(super) type Sim = Simulation<RendererIn, RendererOut>;

/// The clock of a renderer.
const CLOCK: (&str, u64) = ("clk", TICK);

/// An instruction of the renderer: the primitive that it is a part of, if it is one's of the pixel's region.
#[derive(Clone, Copy)]
pub(in crate::pixel_planes) struct Part<'a> {
    pub instruction: &'a Instruction<u64>,
    pub primitive: Option<u32>,
    pub here: bool,
}

/// What the machine drew for a primitive.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::pixel_planes) struct Drawn {
    enabled: bool,
    depth: u64,
    rgb: u64,
}

/// All units of a renderer, and what is known of the pixel so far.
pub(in crate::pixel_planes) struct Observer<'a> {
    parts: Vec<Part<'a>>,
    /// The instructions that the controller took.
    taken: usize,
    units: [Unit; 6],
    queue: VecDeque<Bits>,
    capacity: usize,
    commands: Commands,
    expressions: Expressions,
    pixel: Option<Pixel>,
    store: Store,
    wires: Wires,
    looks: Looks,
    /// The tree's bit and the flags of the pixel, which are looked at only when they matter: all pixels' are made together.
    wide: [Looks; 2],
    /// Where the nets of the units begin: the queue, the controller, the tree, the pixel and the store.
    places: [usize; 5],
    memory: Option<Memory>,
    quadratic: bool,
    lag: u64,
    /// The pixel's region, and its line there.
    region: u64,
    line: u64,
    pub told: Told,
    pub drawn: BTreeMap<u32, Drawn>,
}

impl<'a> Observer<'a> {
    /// Of a renderer of that number and its instructions, for a pixel at a column and a line of its regions.
    pub fn new(
        number: usize,
        renderer: &Renderer,
        side_by_side: bool,
        at: [u32; 2],
        region: usize,
        parts: Vec<Part<'a>>,
    ) -> Observer<'a> {
        let [column, line] = at;
        let quadratic = renderer.quadratic;
        let (lane, value) = (format!("u_pixel[{line}][{column}]."), format!("u_tree.value[{line}][{column}]"));
        let unit =
            |name: &str, block, path: &str| Unit::new(format!("{name} of renderer {number}"), block, CLOCK, path);
        let units = [
            unit("queue", "fifo", "u_queue."),
            unit("controller", "image-generation-controller", "u_controller."),
            unit("tree", if quadratic { "quadratic-tree" } else { "linear-tree" }, "u_tree."),
            unit(&format!("pixel processor ({column}, {line})"), "pixel-processor", &lane),
            unit("backing store", "backing-store", "u_store."),
            Unit::new(
                format!("renderer {number}"),
                if quadratic { "quadratic-renderer" } else { "renderer" },
                CLOCK,
                "",
            ),
        ];
        let of_store = [
            "u_store.save_claim",
            "u_store.save_region",
            "u_store.save_plane",
            "u_store.number",
            "u_store.planes_ready",
            "u_store.free",
            "u_store.planes_valid",
            "u_store.planes_region",
            "u_store.planes_line",
            "u_store.planes_plane",
        ];
        let mut looks = Looks::default();
        let queue = looks.add("u_queue.", ["into_valid", "into_ready", "out_valid", "out_ready"]);
        let controller = looks.add("u_controller.", NETS.iter().map(String::as_str).chain(SAVES));
        let tree = looks.add("u_tree.", ["first", "coefficients_a", "coefficients_b", "coefficients_c"]);
        let mut wide = [Looks::default(), Looks::default()];
        wide[0].add("", [value.as_str()]);
        wide[1].add(&lane, CONTROL[12..].iter().map(String::as_str));
        if quadratic {
            looks.add("u_tree.", ["curve_d", "curve_e", "curve_f"]);
            looks.add("u_controller.", CURVE);
        }
        let pixel = looks.add("u_controller.", CONTROL[..11].iter().map(String::as_str));

        let places = [queue, controller, tree, pixel, looks.add("", of_store)];
        Observer {
            parts,
            taken: 0,
            units,
            queue: VecDeque::new(),
            capacity: renderer.queue as usize,
            commands: Commands::new(renderer.lag(), quadratic, side_by_side),
            expressions: Expressions::new(at, renderer.lag()),
            pixel: None,
            store: Store::new(line, renderer.side),
            wires: Wires::new(&mut looks, at, quadratic),
            looks,
            wide,
            places,
            memory: None,
            quadratic,
            lag: renderer.lag().into(),
            region: region as u64,
            line: line.into(),
            told: Told::of(super::renderer(number)),
            drawn: BTreeMap::new(),
        }
    }

    /// Looks at all units before the edge of a clock.
    pub fn look(&mut self, sim: &mut Sim, clock: u64) {
        let mut checks = Checks::default();
        self.looks.look(sim);
        self.told.at(sim.time() + TICK);
        let [queue, controller, tree, _, _] = self.places;
        self.tell_what_ended(sim, clock);
        self.look_at_queue(sim, self.looks.from(queue), &mut checks);
        self.note(0, clock, "passes instructions on in their sequence", &mut checks);
        self.wires.look(&self.looks, self.parts.get(self.taken).map(|part| part.instruction), &mut checks);
        self.note(5, clock, "connects its units", &mut checks);
        let [curve, sent] =
            if self.quadratic { [tree + 4, tree + 7].map(|it| self.looks.from(it)) } else { [[0; 3]; 2] };
        let saves = self.looks.from(controller + NETS.len());
        let taken = self.commands.look(clock, &self.looks.from(controller), saves, sent, &mut checks);
        self.note(1, clock, "controls the tree, the pixels and the store", &mut checks);
        let expression = self.expression(sim);
        self.look_at_tree(clock, self.looks.from(tree), curve, expression, &mut checks);
        self.note(2, clock, "evaluates an expression", &mut checks);
        self.look_at_pixel(sim, clock, expression);
        if let Some(taken) = taken {
            self.takes(clock, &taken);
        }
    }

    fn note(&mut self, unit: usize, clock: u64, does: &str, checks: &mut Checks) {
        let step = self.units[unit].differing(clock, does, checks);
        self.told.extend(step);
    }

    fn look_at_queue(&mut self, sim: &mut Sim, [valid, ready, out_valid, out_ready]: [u64; 4], checks: &mut Checks) {
        checks.bit("into_ready", ready, self.queue.len() < self.capacity);
        checks.bit("out_valid", out_valid, !self.queue.is_empty());
        let mut word = |name: &str| sim.peek(name).expect("the queue has that net");
        if out_valid & out_ready == 1
            && let Some(first) = self.queue.pop_front()
        {
            let seen = word("u_queue.out_payload");
            if seen != first {
                checks.same("out_payload", format!("{seen:x}"), format!("{first:x}"));
            }
        }
        if valid & ready == 1 {
            self.queue.push_back(word("u_queue.into_payload"));
        }
    }

    fn look_at_tree(
        &mut self,
        clock: u64,
        [first, a, b, c]: [u64; 4],
        [d, e, f]: [u64; 3],
        seen: Option<u64>,
        checks: &mut Checks,
    ) {
        let is_sent = |it: &&Taken| it.is_expression() && (it.times.begins..it.times.ends).contains(&clock);
        let longest = self.commands.under_way.iter().find(is_sent);
        let longest = longest.map_or(0, |it| it.instruction.skip + it.instruction.length);
        self.expressions.look(first, [a, b, c, d, e, f], seen, longest, checks);
    }

    /// Looks at the pixel and the store. The wires to the pixel are looked at if something differs, or if the store takes a bit.
    fn look_at_pixel(&mut self, sim: &mut Sim, clock: u64, expression: Option<u64>) {
        let [.., place, store] = self.places;
        let control: [u64; 11] = self.looks.from(place);
        let has_ended = self.commands.under_way.iter().any(|it| it.times.ends + self.lag == clock);
        let flags = (has_ended || clock < CLOCKS_OF_ALL).then(|| self.flags(sim));
        let memory = self.memory(sim);
        let word = |address: u32| sim.word(memory, address).bit(0);
        let pixel = self.pixel.get_or_insert_with(|| {
            let flags = flags.unwrap_or_default().map(|bit| bit == 1);
            Pixel::new((0..PixelProcessor::BITS).map(word).collect(), flags)
        });
        let written = word(pixel.written as u32);
        let right = pixel.read(&control);
        let (mut checks, mut wired) = (Checks::default(), Checks::default());
        pixel.look(&control, expression.unwrap_or(0), (written, flags), &mut checks);
        let [claim, region, plane, number, ready, free, valid, of, line, number_out] = self.looks.from(store);
        let mut stored = 0;
        if checks.differ() || plane == 1 || clock < CLOCKS_OF_ALL {
            let words = self.wires.look_at_pixel(sim, &mut wired);
            checks.bit("word", words[0], right);
            stored = words[1];
        }
        self.note(5, clock, "connects its units", &mut wired);
        self.note(3, clock, "works on a bit", &mut checks);
        let bits = if valid == 1 && line == self.line { self.wires.look_at_planes(sim, &mut wired) } else { 0 };
        self.note(5, clock, "connects its units", &mut wired);
        let out = [valid, of, line, number_out, bits];
        self.look_at_store(clock, &Stored { claim, region, plane, number, word: stored, ready, free, out });
    }

    /// The tree's bit, if the pixel does something with it.
    fn expression(&mut self, sim: &mut Sim) -> Option<u64> {
        let [source, _, adds, _, mask, compares, _, enabling, ..] = self.looks.from::<11>(self.places[3]);
        let is_sign = [Enabling::Replace, Enabling::Restrict].iter().any(|it| it.code() == enabling);
        let is_bit = source == Source::Expression.code() && (mask != Mask::Nobody.code() || adds + compares > 0);
        (is_sign || is_bit).then(|| {
            self.wide[0].look(sim);
            self.wide[0].at(0)
        })
    }

    /// The pixel's carry, enable and flag.
    fn flags(&mut self, sim: &mut Sim) -> [u64; 3] {
        self.wide[1].look(sim);
        self.wide[1].from(0)
    }

    fn memory(&mut self, sim: &Sim) -> Memory {
        let path = &self.units[3].path;
        *self.memory.get_or_insert_with(|| sim.memory(&format!("{path}memory")).expect("a pixel has a memory"))
    }

    fn look_at_store(&mut self, clock: u64, it: &Stored) {
        let (out, mut checks) = (it.out, Checks::default());
        let leaves = self.store.look(clock, it, &mut checks);
        self.note(4, clock, "stores a region and sends it", &mut checks);
        if leaves && out[1] == self.region {
            let word = value("word", format!("{:012x}", self.store.word()));
            let region = value("region", out[1].to_string());
            let step =
                self.units[4].step_at("planes_valid", clock, None, "has sent the pixel's planes", vec![region, word]);
            self.told.tell(step);
        }
    }
}

impl Drawn {
    /// The word that the machine drew, if the pixel was inside.
    pub fn word(&self) -> Option<u64> {
        self.enabled.then_some(self.depth << 24 | self.rgb)
    }
}
