//! A whole generator: built for a configuration, it renders frames and reports.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::generator::{QuadtreeGeneratorIn, QuadtreeGeneratorOut};
use tilewright_scenes::{Frame, Polygon};
use tilewright_sim::{EngineKind, Simulation};

use super::config::Config;
use super::counters::Counters;
use super::hardware::Hardware;
use super::history::Recording;
use super::host::Host;
use super::report::Report;
use super::way::Following;
use crate::error::Error;
use crate::history::Recorder;
use crate::run::Watch;
use crate::way::Follower;

/// A generator of p x q video processors, and its host.
///
/// ```
/// use tilewright_machines::{Watch, quadtree};
/// use tilewright_scenes::{Scene, Size, golden, project_polygons};
///
/// let (scene, size) = (Scene::builtin("teapot").expect("a built-in scene"), Size::new(16, 12)?);
/// let packets = project_polygons(&scene, size)?.polygons;
/// let mut machine = quadtree::Machine::new(quadtree::Config::for_packets(size, &packets))?;
/// let (frame, report) = machine.render(&packets, scene.background, &mut Watch::default())?;
/// assert_eq!(frame, golden::render(size, &packets, scene.background));
/// println!("{report}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Machine {
    config: Config,
    hardware: Hardware,
    state: State,
    recorder: Option<Recorder>,
    follower: Option<Follower>,
}

/// The last activity of the machine.
enum State {
    /// Nothing.
    New,
    /// A frame that ended with those counters.
    Idle(Counters),
    /// A frame that did not end: parts of it are in the pictures.
    BrokenOff,
}

impl Machine {
    /// Builds the machine.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        let hardware = Hardware::new(&config.generator()?)?;
        Ok(Machine { config, hardware, state: State::New, recorder: None, follower: None })
    }

    /// The same machine on that engine of the simulator; the compiled one is the default.
    ///
    /// # Panics
    /// A trace is attached.
    #[track_caller]
    pub fn on(mut self, engine: EngineKind) -> Machine {
        self.hardware.sim = self.hardware.sim.on(engine);
        self
    }

    /// The same machine with a recorder. It is then observed in each clock, which is slower.
    pub fn recorded(mut self, recorder: &Recorder) -> Machine {
        self.recorder = Some(recorder.clone());
        self
    }

    /// The same machine with a follower of a pixel on its screen. It is then observed in each clock, which is slower.
    ///
    /// # Panics
    /// The pixel is outside of the screen.
    #[track_caller]
    pub fn following(mut self, follower: &Follower) -> Machine {
        let (size, [x, y]) = (self.config.size, follower.pixel);
        assert!(x < size.width() && y < size.height(), "pixel {x},{y} is outside of a screen of {size}");
        self.follower = Some(follower.clone());
        self
    }

    /// The simulated hardware, for attaching traces. [`Machine::render`] ends them, also on errors.
    pub fn simulation(&mut self) -> &mut Simulation<QuadtreeGeneratorIn, QuadtreeGeneratorOut> {
        &mut self.hardware.sim
    }

    /// Renders a frame. Returns the picture that the video controller reads, and the report. Further frames may follow on the same machine.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a packet is not for this machine; [`Error::Cancelled`]; [`Error::Simulation`]; [`Error::Untraced`].
    pub fn render(
        &mut self,
        packets: &[Polygon],
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        for (number, packet) in packets.iter().enumerate() {
            self.check(number, packet)?;
        }
        let state = std::mem::replace(&mut self.state, State::BrokenOff);
        let rendered = self.run(state, packets, background, watch);
        Error::of_both(rendered, self.hardware.sim.finish())
    }

    fn run(
        &mut self,
        state: State,
        packets: &[Polygon],
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let size = self.config.size;
        // Each packet is sent, and then each pixel is read, neighbours together.
        let groups = size.pixels() as u64 / u64::from(self.config.matrix.0);
        self.hardware.sim.expect(packets.len() as u64 + groups);
        let before = match state {
            State::Idle(counters) => counters,
            State::New => self.reset()?,
            State::BrokenOff => {
                let counters = self.reset()?;
                // Reading both banks empties them.
                let mut host = Host::new(&mut self.hardware, watch);
                host.read_out(size, background)?;
                host.read_out(size, background)?;
                counters
            }
        };
        let (time, period) = (self.hardware.sim.time(), self.hardware.sim.program().clocks[0].period);
        let recording = self.recorder.as_ref().map(|recorder| {
            let recording = Recording::new(&self.config, background, before.clone(), time, period);
            if recorder.has_areas { recording.with_visits(&self.config) } else { Ok(recording) }
        });
        let recording = recording.transpose()?;
        let following = |it: &Follower| Following::new(it, &self.config, packets, background, period).map(Box::new);
        let following = self.follower.as_ref().map(following).transpose()?;
        let mut host = Host::new(&mut self.hardware, watch);
        (host.recording, host.following) = (recording, following);
        let drawn = host.draw(packets);
        let recording = host.recording.take().map(|recording| (recording, host.time()));
        let words = drawn.and_then(|()| host.read_out(size, background));
        if let (Some(mut following), Err(error)) = (host.following.take(), &words) {
            following.fails(error);
        }
        let words = words?;
        let phases = host.phases;

        let end = self.hardware.sim.time();
        let frame = Frame::from_words(size, words).expect("a word of 48 bits was read for each pixel");
        let now = self.hardware.counters();
        let (each, waited) = (now.each_since(&before), now.broadcast_stalls_since(&before));
        let report =
            Report::new(self.config.built()?, &self.config.parsed_form()?, packets.len(), each, waited, phases);
        if let (Some(recorder), Some((recording, drawn))) = (&self.recorder, recording) {
            recorder.put(recording.into_history(&report, &now, drawn, end));
        }
        self.state = State::Idle(now);
        Ok((frame, report))
    }

    fn reset(&mut self) -> Result<Counters, Error> {
        self.hardware.reset(self.config.strict)?;
        Ok(self.hardware.counters())
    }

    /// Checks that a packet fits the hardware.
    fn check(&self, number: usize, packet: &Polygon) -> Result<(), ParameterError> {
        let (edges, most, size) = (packet.edges.len(), self.config.edges, self.config.size);
        let bounds = packet.bounds;
        let is_slope = |slope: i32| (-(1 << 16)..1 << 16).contains(&slope);
        let problem = if !(3..=most as usize).contains(&edges) {
            format!(
                "it has {edges} edges, and the machine is built for 3 to {most}: build it with `edges` of that number"
            )
        } else if bounds.right.max(bounds.left) >= size.width() || bounds.bottom.max(bounds.top) >= size.height() {
            format!("it extends beyond the machine's {size} pixels: set it up for that size")
        } else if !packet.edges.iter().all(|edge| is_slope(edge.a) && is_slope(edge.b)) {
            "an edge is steeper than 17 bits: set it up from vertices of 16 bits".to_owned()
        } else {
            return Ok(());
        };
        Err(ParameterError(format!("packet {number} cannot be drawn: {problem}")))
    }
}
