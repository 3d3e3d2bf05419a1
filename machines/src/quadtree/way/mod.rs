//! The way of a pixel through the generator: each unit's values in the pixel's video processor, beside those of plain numbers.
//!
//! A window that contains the pixel's sample is followed from unit to unit. All other windows are watched alone for whether they turn into such
//! a window. Windows of one polygon follow those of the polygons before it, so the model knows which one comes next.

mod buffer;
mod idle;
mod nets;
mod numbers;
mod packets;
mod pixels;
mod queue;
mod reading;
mod sequence;
mod units;

use std::rc::Rc;

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::format::Format;
use tilewright_rtl::quadtree::generator::{QuadtreeGeneratorIn, QuadtreeGeneratorOut};
use tilewright_scenes::Polygon;
use tilewright_scenes::frame::{blank, depth_of};
use tilewright_sim::Simulation;

use super::config::Config;
use crate::error::Error;
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared};
use crate::way::{Follower, Primitive, Way};
use buffer::Buffer;
use idle::Idle;
use packets::Packets;
use pixels::Pixels;
use reading::Reading;
use units::Link;

/// The simulation that is observed.
type Sim = Simulation<QuadtreeGeneratorIn, QuadtreeGeneratorOut>;

/// The simulation before an edge, and the nets that are looked at in each clock.
struct Seen<'a> {
    sim: &'a mut Sim,
    nets: &'a Looks,
}

/// The name of the machine's clock.
const CLOCK: &str = "clk";

/// The followed pixel, a sample of a video processor.
#[derive(Clone)]
struct Followed {
    format: Format,
    /// The pixel's number in raster order.
    pixel: u32,
    /// The video processor, and its place in the matrix.
    processor: u32,
    column: u32,
    row: u32,
    /// The sample among those of the video processor.
    x: u32,
    y: u32,
}

/// The observer of a pixel. It leaves the way when it goes, also after an error.
pub(crate) struct Following {
    follower: Follower,
    primitives: Vec<Primitive>,
    told: Told,
    period: u64,
    looks: Looks,
    packets: Packets,
    links: Vec<Link>,
    idle: Idle,
    pixels: Pixels,
    buffer: Buffer,
    reading: Reading,
    is_reading: bool,
    /// Clocks since the last packet was taken, and the most that any packet can take.
    still: u64,
    most: u64,
}

impl Following {
    /// One for a frame of these packets.
    pub fn new(
        follower: &Follower,
        config: &Config,
        polygons: &[Polygon],
        background: [u8; 3],
        period: u64,
    ) -> Result<Following, ParameterError> {
        let (format, [x, y]) = (config.format()?, follower.pixel);
        let (p, q) = config.matrix;
        let (column, row) = (x % p, y % q);
        let pixel = y * config.size.width() + x;
        let followed = Followed { format, pixel, processor: row * p + column, column, row, x: x / p, y: y / q };
        let polygons: Rc<[Polygon]> = polygons.into();
        let mut looks = Looks::default();
        let links = units::of(&mut looks, &followed, &config.parsed_form()?, &polygons);
        // Each window takes a clock for each edge of each quarter, and more for those that pass.
        let windows = (4_u64.pow(format.levels() + 1) + 64) / 3 * u64::from(4 * config.edges + 16);
        let queues = config.queues.broadcast + config.queues.packets + 2;
        Ok(Following {
            follower: follower.clone(),
            primitives: primitives(&polygons, follower.pixel, background, config.strict),
            told: Told::default(),
            period,
            packets: Packets::new(&mut looks, &followed, polygons.clone()),
            links,
            idle: Idle::new(&mut looks, &followed, &config.parsed_form()?),
            pixels: Pixels::new(&mut looks, &followed, polygons, follower.pixel),
            looks,
            buffer: Buffer::new(&followed, config.strict),
            reading: Reading::new(&followed, background),
            is_reading: false,
            still: 0,
            most: windows * u64::from(queues),
        })
    }

    fn edge(&self, clock: u64) -> Edge {
        Edge { clock: CLOCK, number: clock, time: clock * self.period }
    }

    /// Looks at the units before that edge.
    pub fn look(&mut self, sim: &mut Sim, clock: u64) {
        let edge = self.edge(clock);
        if self.is_reading {
            self.reading.look(sim, edge, &self.buffer, &mut self.told);
            return;
        }
        self.looks.look(sim);
        let mut seen = Seen { sim, nets: &self.looks };
        self.still += 1;
        // What is wrong in a queue is so behind it, too, in the same clock.
        for queue in self.links.iter_mut().filter(|it| it.is_queue()) {
            queue.look(&mut seen, edge, &mut self.told);
        }
        if self.packets.look(&mut seen, edge, &mut self.told) {
            self.still = 0;
        }
        for link in self.links.iter_mut().filter(|it| !it.is_queue()) {
            link.look(&mut seen, edge, &mut self.told);
        }
        self.idle.look(&self.looks, edge, &mut self.told);
        self.buffer.look(seen.sim, edge, &mut self.told);
        let fragment = self.pixels.look(&mut seen, edge, (&mut self.primitives, &mut self.told));
        if let Some(fragment) = fragment {
            self.buffer.draws(fragment, edge.number);
        }
    }

    /// Notes what ended the run.
    pub fn fails(&mut self, error: &Error) {
        self.told.fails(error, &[CLOCK], |instance| match instance {
            "u_processor" => "video-processor",
            "u_set_up" => "quadtree-set-up",
            "u_raster" => "raster-processor",
            "u_test" => "coverage-test",
            "u_pixel" => "quadtree-pixel",
            "u_buffer" => "video-buffer",
            "u_controller" => "video-controller",
            "u_arbiter" => "round-robin-arbiter",
            "u_branch" => "quadtree-tree",
            name if name.starts_with("u_queue") => "fifo",
            name if name.starts_with("u_test") => "coverage-test",
            name if name.starts_with("u_stack") => "quadtree-stack",
            name if name.starts_with("u_pipe") => "quadtree-pipe",
            name if name.starts_with("u_tree") => "quadtree-tree",
            _ => "quadtree-generator",
        });
    }

    /// Whether drawing has taken longer than it can.
    pub fn is_stuck(&self) -> bool {
        self.still > self.most
    }

    /// Drawing has ended, or does not end: what should have happened until then has not.
    pub fn ends(&mut self, sim: &mut Sim, clock: u64) {
        let edge = self.edge(clock);
        let told = &mut self.told;
        let is_over = self.packets.ends(edge, told) && self.links.iter_mut().all(|it| it.ends(sim, edge, told));
        if !is_over || !self.pixels.ends(edge, told) || self.still <= self.most {
            return;
        }
        // Everything has been drawn, and some unit does not say so.
        self.idle.ends(sim, edge, told);
    }

    /// The banks are exchanged at the coming edge.
    pub fn swaps(&mut self) {
        self.is_reading = true;
    }

    /// The banks were exchanged at that edge, and the picture is read from the next one on.
    pub fn reads(&mut self, sim: &mut Sim, clock: u64) {
        let edge = self.edge(clock);
        self.buffer.swaps(sim, edge, &mut self.told);
    }

    /// The host gets a group of pixels, the first of them with that number.
    pub fn group(&mut self, sim: &mut Sim, clock: u64, first: usize, count: usize) {
        let edge = self.edge(clock);
        self.reading.group(sim, edge, ([first, count], &self.buffer), &mut self.told);
    }

    /// All pixels have been read.
    pub fn read(&mut self, clock: u64) {
        let edge = self.edge(clock);
        self.reading.ends(edge, &mut self.told);
    }
}

/// The polygons that cover the pixel.
fn primitives(polygons: &[Polygon], [x, y]: [u32; 2], background: [u8; 3], strict: bool) -> Vec<Primitive> {
    let of = |(number, packet): (usize, &Polygon)| {
        (packet.bounds.contains(x, y) && packet.covers(x, y)).then(|| Primitive {
            number,
            name: format!("polygon {}", packet.polygon),
            golden: Some(packet.word(x, y)),
            hardware: None,
            wins: false,
        })
    };
    let mut all: Vec<Primitive> = polygons.iter().enumerate().filter_map(of).collect();
    let (mut kept, mut winner) = (blank(background), None);
    for (at, word) in all.iter().enumerate().filter_map(|(at, it)| Some((at, it.golden?))) {
        let is_nearer = if strict { depth_of(word) < depth_of(kept) } else { word < kept };
        if is_nearer {
            (kept, winner) = (word, Some(at));
        }
    }
    if let Some(winner) = winner {
        all[winner].wins = true;
    }
    all
}

impl Drop for Following {
    fn drop(&mut self) {
        let steps = self.told.take();
        self.follower.put(Way { primitives: std::mem::take(&mut self.primitives), steps });
    }
}

/// A step that never came.
fn nothing(unit: String, block: &'static str, edge: Edge, does: String, expected: &'static str) -> crate::way::Step {
    At { unit, block, edge }.step(does, vec![compared("result", "nothing", expected)])
}

/// The settled value of a net.
fn net(sim: &mut Sim, name: &str) -> u64 {
    let value = sim.peek(name).unwrap_or_else(|unknown| panic!("{unknown}"));
    value.to_u64().expect("it has at most 64 bits")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadtree::hardware::Hardware;
    use crate::quadtree::host::Host;
    use crate::run::Watch;
    use tilewright_scenes::{Scene, Size, project_polygons};

    /// The first difference in a machine of one processor that gets other packets than its model: the block, the net, and the value.
    fn first(change: impl Fn(&mut Vec<Polygon>)) -> Option<(&'static str, String, String)> {
        let (scene, size) = (Scene::builtin("star").unwrap(), Size::new(8, 6).unwrap());
        let packets = project_polygons(&scene, size).unwrap().polygons;
        let config = Config { matrix: (1, 1), ..Config::for_packets(size, &packets) };
        let mut hardware = Hardware::new(&config.generator().unwrap()).unwrap();
        hardware.reset(false).unwrap();
        let follower = Follower::new([4, 3]);
        let mut watch = Watch::default();
        let mut host = Host::new(&mut hardware, &mut watch);
        let following = Following::new(&follower, &config, &packets, [0; 3], 10_000).unwrap();
        host.following = Some(Box::new(following));
        let mut sent = packets.clone();
        change(&mut sent);
        host.draw(&sent).unwrap();
        host.read_out(size, [0; 3]).unwrap();
        host.following = None;
        let way = follower.take().unwrap();
        way.first_difference().map(|step| {
            let value = step.values.iter().find(|it| it.differs()).unwrap();
            (step.block, step.net.clone().unwrap(), value.hardware.clone())
        })
    }

    #[test]
    fn a_packet_that_is_changed_or_lost_on_the_way_is_the_first_difference() {
        assert_eq!(first(|_| {}), None);
        let changed = first(|packets| packets[3].rgb[1].origin ^= 1 << 20);
        let (block, net, _) = changed.unwrap();
        assert_eq!((block, net.as_str()), ("quadtree-generator", "u_processor[0].packets_planes_origin[2]"));
        let lost = first(|packets| drop(packets.pop()));
        let (block, net, value) = lost.unwrap();
        assert_eq!(
            (block, net.as_str(), value.as_str()),
            ("quadtree-generator", "u_processor[0].packets_valid", "nothing")
        );
    }
}
