//! The machine as a picture: its pixels wait in a buffer of two lines for the screen to ask for them.

use tilewright_hdl::{Clock, Module, ReadUnderWrite, Signal, Stream, below, bit, block, cat, def, lit, row, up_to};
use tilewright_rtl::quadtree::banks::Banks;
use tilewright_rtl::quadtree::controller::Show;
use tilewright_rtl::quadtree::format::Format;
use tilewright_rtl::quadtree::generator::{Probe, QuadtreeGenerator, QuadtreeGeneratorIn};

use super::compact::{CompactGenerator, CompactGeneratorIn, LanePlayer, LanePlayerIn, Lanes};
use super::host::{Host, HostIn};
use super::player::{Player, PlayerIn};
use super::store::Store;
use crate::picture::{Colour, Picture, PictureIn};

/// The machine, and the scene in the memory that feeds it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Machine {
    /// That of the paper.
    Paper(QuadtreeGenerator, Store),
    /// One of compact video processors.
    Compact(CompactGenerator, Lanes),
}

impl Machine {
    fn format(&self) -> Format {
        match self {
            Machine::Paper(generator, _) => generator.format(),
            Machine::Compact(generator, _) => generator.format,
        }
    }
}

block! {
    /// A quadtree generator that draws a stored turning scene.
    ///
    /// ```text
    ///  .--------.      .-----------.  p pixels  .-----------.
    ///  | player |=====>| generator |===========>| 2 lines   |====> colour
    ///  '--------'      '-----------'            '-----------'
    ///       ^ go            ^ swap, show             ^ x, y
    ///       '----[ host ]---'                   retrace, next line
    /// ```
    ///
    /// While a line is shown, the machine's controller fills the buffer with the next one.
    pub struct QuadtreePicture {
        /// The machine, with the scene.
        pub machine: Machine,
        /// The colour where nothing is drawn, with the bits of the machine's colours.
        pub background: u64,
        /// How often a step is shown.
        pub refreshes: u32,
        /// The binary logarithm of the columns and rows of the screen that a pixel takes.
        pub scale: u32,
        /// The machine's clock, unless it is that of the pixels.
        pub clock: Option<Clock>,
    }
    ranges { scale: 0..=3 }
    in = PictureIn;
    out = Colour::widths(8);
}

impl QuadtreePicture {
    fn build(&self, m: Module, i: PictureIn) -> Colour {
        let format = self.machine.format();
        let (p, colour, screen) = (format.matrix().columns(), format.precision().colour, format.screen());

        // The screen tells the machine when a frame ends, and when it can fill the other line of the buffer.
        let is_above = |side: u32| i.y.lt(lit(10, side << self.scale));
        let begins = if self.scale == 0 { lit(1, 1) } else { i.y.part(0, self.scale).eq(0) };
        def!(ended = m.toggle(i.ends));
        def!(first = i.runs & i.x.eq(0) & begins & is_above(screen.height - 1));
        def!(was_first = m.reg(bit()).reset(0));
        was_first.next(first);
        def!(asked = m.toggle(first & !was_first));

        let here = self.clock.map_or(m, |clock| m.on(clock));
        let crossed = |name: &str, toggles: Signal| {
            let toggles = self.clock.map_or(toggles, |_| here.synchronize(name, toggles));
            let was = here.reg(&format!("{name}_was"), bit()).reset(0);
            was.next(toggles);
            toggles ^ *was
        };
        def!(retrace = crossed("ended_here", ended));
        def!(next = crossed("asked_here", asked));
        let pixels = self.machine(here, retrace);

        // The machine fills a line.
        let groups = format.columns();
        let lines = m.memory("lines", 2 << below(groups).bits(), p * 3 * colour, ReadUnderWrite::Any);
        def!(begun = here.reg(bit()).reset(0));
        def!(fills = here.reg(bit()).reset(0));
        def!(half = here.reg(1).reset(0));
        def!(column = here.reg(below(groups)).reset(0));
        // A bank with one port is cleared where it was read, before it is read again.
        def!(waited = here.reg(bit()).reset(0));
        let is_free = if format.banks() == Banks::Spram { *waited } else { lit(1, 1) };
        let valid = pixels.valid;
        let group = pixels.take_when(fills & is_free);
        waited.next(valid & !group.taken);
        def!(filled = group.taken & column.eq(groups - 1));
        def!(begins_line = retrace | (next & begun));
        here.assert(begins_line.implies(!fills), "a line is filled before the next one is asked for");
        begun.when(retrace, 1);
        fills.when(begins_line, 1).when(filled, 0);
        half.when(retrace, 0).when(begins_line, !half);
        column.when(filled, 0).when(group.taken, column + 1);
        let to = self.clock.map_or(lines, |clock| lines.on(clock));
        to.write(group.taken, cat![half, column], group.part(0, 3 * colour).pack());

        // The screen reads the other one.
        let from = self.scale + p.trailing_zeros();
        let shown = lines.read(cat![i.y.bit(self.scale), i.x.part(from, below(groups).bits())]);
        let pixel = match p {
            1 => shown,
            _ => shown.unpack(row(p)).pick(m.pipe("pixel_of_group", i.x.part(self.scale, p.trailing_zeros()))),
        };
        let channel = |number: u32| full(pixel.part(number * colour, colour));
        m.pipe("answer", Colour { red: channel(2), green: channel(1), blue: channel(0) })
    }

    /// The machine with its host and player: the pixels of the picture that is shown.
    fn machine(&self, m: Module, retrace: Signal) -> Stream {
        let format = self.machine.format();
        let unknown = if format.banks() == Banks::Spram { 2 } else { 0 };
        def!(drawn = m.wire(bit()));
        let host = Host { refreshes: self.refreshes, unknown };
        def!(host = m.instance(&host, HostIn { retrace, drawn: *drawn }));
        let background = lit(3 * format.precision().colour, self.background);
        let show = Show { start: host.start, clear: host.clear, background };
        let (pixels, is_drawn, showing) = match &self.machine {
            Machine::Paper(generator, store) => {
                let player = Player { format, store: store.clone() };
                def!(player = m.instance(&player, PlayerIn { go: host.go }));
                let probe = Probe {
                    processor: lit(below(format.matrix().processors()), 0),
                    unit: lit(up_to(format.levels()), 0),
                };
                let into =
                    QuadtreeGeneratorIn { packets: player.packets, strict: lit(1, 0), swap: host.swap, show, probe };
                def!(generator = m.instance(generator, into));
                (generator.pixels, player.done & generator.idle, generator.showing)
            }
            Machine::Compact(generator, lanes) => {
                let player = LanePlayer { format, lanes: lanes.clone() };
                def!(player = m.instance(&player, LanePlayerIn { go: host.go }));
                let into = CompactGeneratorIn { words: player.words, swap: host.swap, show };
                def!(generator = m.instance(generator, into));
                (generator.pixels, player.done & generator.idle, generator.showing)
            }
        };
        drawn.drive(is_drawn);
        m.assert(retrace.implies(!showing), "a picture is read before the next retrace");
        pixels
    }
}

/// A channel in 8 bits: the stored bits, repeated from the upper end.
fn full(stored: Signal) -> Signal {
    let times = 8_u32.div_ceil(stored.width());
    let repeated = (1..times).fold(stored, |all, _| cat![all, stored]);
    repeated.part(repeated.width() - 8, 8)
}

/// A stored channel as the screen shows it, in plain numbers.
pub fn shown(channel: u8, bits: u32) -> u8 {
    let times = 8_u32.div_ceil(bits);
    let repeated = (0..times).fold(0_u32, |all, _| all << bits | u32::from(channel));
    (repeated >> (times * bits - 8)) as u8
}

impl Picture for QuadtreePicture {
    fn latency(&self) -> u32 {
        2
    }
}
