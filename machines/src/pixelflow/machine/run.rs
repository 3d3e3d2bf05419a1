//! A frame in progress: the words between nodes, in the ticks of the model.

use std::collections::{BTreeMap, VecDeque};

use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_scenes::Frame as Picture;
use tilewright_sim::EngineKind;

use super::jobs::{Composed, Composition, Job, Target, Worker};
use crate::error::Error;
use crate::history::History;
use crate::pixelflow::config::Config;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::{Found, NetworkObserver, Pixel, TextureObserver};
use crate::pixelflow::hardware::{Access, Beside, FrameStore, Node, Spare, TextureLookUp, Way, Words};
use crate::pixelflow::history::{Recording, Worked};
use crate::pixelflow::model::{Built, Timing};
use crate::pixelflow::report::Report;
use crate::pixelflow::works::Works;
use crate::threads::{all_threads, each_mut};
use crate::tracer::Tracer;

/// Turns that rasterizers draw before the network composes them. Memory has the words of up to twice this number.
const TURNS: usize = 8;
/// Ticks after which a frame with a followed pixel does not end any more, beside twice those of the model.
const FOLLOWED_LONGER: Ticks = 10_000;

/// A frame in progress.
pub(super) struct Run<'a> {
    config: &'a Config,
    spare: &'a Spare,
    works: &'a Works,
    timing: Timing,
    rasterizers: Vec<Node>,
    shaders: Vec<Worker>,
    holder: Worker,
    ways: Vec<Way>,
    /// The numbers of turns that rasterizers have drawn, and whose words were sent.
    drawn: usize,
    gone: usize,
    /// The turns whose colours each shader will send, and those whose colours the node of the frame buffer will get, in sequence.
    colours: Vec<VecDeque<usize>>,
    held: VecDeque<usize>,
    /// The next work of the network.
    waiting: Vec<Composition>,
    /// Colours that are ready before those of an earlier turn.
    early: BTreeMap<usize, Words>,
    /// The words of each region at the node of the frame buffer, if they have depths.
    came: Vec<Words>,
    /// The recorded history, if there is one.
    recording: Option<Recording>,
    /// The pixel that is followed.
    pixel: Option<Pixel>,
}

impl<'a> Run<'a> {
    /// A frame that begins.
    ///
    /// # Errors
    /// As [`Machine::render`](super::Machine::render).
    pub fn new(
        config: &'a Config,
        engine: EngineKind,
        spare: &'a Spare,
        works: &'a Works,
        records: bool,
        pixel: Option<Pixel>,
    ) -> Result<Run<'a>, Error> {
        let (array, roles) = (config.pixels()?, config.roles()?);
        let shaders = if works.is_shaded() { roles.shaders as usize } else { 0 };
        let mut nodes = build(&array, (engine, spare), config.side_by_side, shaders, works)?;
        // Any rasterizer may send any word.
        let ways = (0..all_threads()).map(|_| Way::new(&array, config.nodes as usize, engine));
        let ways = ways.collect::<Result<_, _>>()?;
        let shading = nodes.split_off(1 + works.shares());
        let rasterizers = nodes.split_off(1);
        let holder = nodes.remove(0);
        let built = Built {
            array: &array,
            shaders,
            side_by_side: config.side_by_side,
            set_up: config.set_up,
            looks_up: TextureLookUp::clocks(&array),
            loads: works.frame_buffer()?.clocks(),
        };
        let timing = Timing::new(&built, works);

        let turns =
            |of: &dyn Fn(usize) -> bool| -> VecDeque<usize> { (0..works.turns()).filter(|turn| of(*turn)).collect() };
        let is_of = |turn: usize, shader: usize| works.shader_of(turn, shaders) == Some(shader);
        let held = turns(&|turn| works.comes_to_holder(turn));
        let shader = |(number, node)| Worker::new(node, turns(&|turn| is_of(turn, number)).len());
        let mut run = Run {
            config,
            spare,
            works,
            timing,
            rasterizers,
            shaders: shading.into_iter().enumerate().map(shader).collect(),
            holder: Worker::new(holder, held.len()),
            ways,
            drawn: 0,
            gone: 0,
            colours: (0..shaders)
                .map(|number| turns(&|turn| is_of(turn, number) && works.comes_to_holder(turn)))
                .collect(),
            held,
            waiting: Vec::new(),
            early: BTreeMap::new(),
            came: Vec::new(),
            recording: records.then(|| Recording::new(works)),
            pixel,
        };
        run.follow(&array, config.side_by_side)?;
        run.schedule();
        Ok(run)
    }

    /// Begins the waveform of a unit.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer) -> Result<(), Error> {
        let shaders = self.shaders.iter_mut().map(|shader| &mut shader.node);
        let array = self.config.pixels()?;
        let mut nodes = self.rasterizers.iter_mut().chain(shaders).chain([&mut self.holder.node]);
        nodes.try_for_each(|node| node.trace(tracer, &array))?;
        (1..).zip(&mut self.ways).try_for_each(|(number, way)| way.trace(tracer, number))
    }

    /// Gives banks to the network before the first turn.
    ///
    /// # Errors
    /// [`Error::Simulation`]; [`Error::Differs`].
    pub fn begin(&mut self) -> Result<(), Error> {
        self.holder.node.run(&Works::first_of_holder(), &[])?;
        self.shaders.iter_mut().try_for_each(|shader| shader.node.run(&Works::first_of_shader(), &[]))
    }

    /// Has all nodes, and both ways of the network, follow the pixel.
    fn follow(&mut self, array: &PixelArray, side_by_side: bool) -> Result<(), Error> {
        let (works, Some(pixel)) = (self.works, self.pixel) else { return Ok(()) };
        // A frame that takes twice as long does not end.
        let limit = 2 * self.timing.turns.last().map_or(0, |turn| turn.loaded.end) + FOLLOWED_LONGER;
        self.holder.node.follow(pixel.of_array("the node of the frame buffer", array, side_by_side), limit);
        self.holder.node.follow_store(pixel.of_store(works)?);
        for (number, node) in (1..).zip(&mut self.rasterizers) {
            node.follow(pixel.of_array(&format!("rasterizer {number}"), array, side_by_side), limit);
        }
        for (number, shader) in (1..).zip(&mut self.shaders) {
            let name = format!("shader {number}");
            shader.node.follow(pixel.of_array(&name, array, side_by_side), limit);
            let starts = self.colours[number - 1].iter().map(|turn| works.region(*turn) == pixel.region).collect();
            shader.node.follow_textures(TextureObserver::new(&name, array, &works.textures, pixel.place, starts));
        }
        for (number, way) in (1..).zip(&mut self.ways) {
            let observer =
                NetworkObserver::new(number, self.config.nodes as usize, works.pixels_of_chip(), pixel.place);
            way.observer = Some(Box::new(observer));
        }
        Ok(())
    }

    /// What was found of the pixel that is followed.
    pub fn found(&mut self) -> Found {
        let mut found = Found::default();
        let rasterizers = self.rasterizers.iter_mut();
        let nodes =
            rasterizers.chain(self.shaders.iter_mut().map(|shader| &mut shader.node)).chain([&mut self.holder.node]);
        nodes.for_each(|node| node.take_found(&mut found));
        let observers = self.ways.iter_mut().filter_map(|way| way.observer.take());
        observers.for_each(|mut observer| found.steps.extend(observer.told.take()));
        found
    }

    /// Tells all nodes the ticks in which the network accesses their banks, and in which they have to give them.
    fn schedule(&mut self) {
        let (works, timing, pixel) = (self.works, &self.timing, self.pixel);
        let is_followed = |turn: usize| pixel.is_some_and(|pixel| works.region(turn) == pixel.region);
        for (shader, tick) in self.shaders.iter_mut().zip(&timing.first_words) {
            shader.node.expect(0, *tick);
        }
        timing.first_stores.iter().enumerate().for_each(|(bank, tick)| self.holder.node.expect(bank, *tick));
        let first = if works.is_shaded() { 0 } else { self.rasterizers.len() - 1 };
        for (turn, (done, given)) in timing.turns.iter().zip(&timing.given).enumerate() {
            let (bank, bytes, is_followed) = (turn % 2, works.bytes(), is_followed(turn));
            for (number, node) in self.rasterizers.iter_mut().enumerate() {
                // A tick from node to node.
                let from = done.composed.start + first.abs_diff(number) as Ticks;
                node.access(Access { from, bank, bytes, comes: None, is_followed });
                node.expect(bank, given.words[number]);
            }
            if let Some(number) = works.shader_of(turn, self.shaders.len()) {
                let node = &mut self.shaders[number].node;
                node.expect(0, given.next_word);
                if works.comes_to_holder(turn) {
                    let from = done.sent.start;
                    node.access(Access { from, bank: 1, bytes: Works::COLOUR, comes: None, is_followed });
                    node.expect(1, done.shaded.end);
                }
            }
            if works.comes_to_holder(turn) {
                self.holder.node.expect(works.holders_bank(turn), given.stored);
            }
        }
    }

    /// Simulated ticks until the last region that is in the frame buffer now.
    pub fn time(&self) -> Ticks {
        let turns = self.held.front().map_or(self.works.turns(), |turn| *turn);
        turns.checked_sub(1).map_or(0, |turn| self.timing.turns[turn].loaded.end)
    }

    /// Advances all nodes and the network in parallel, each with the words that the others had for it before. Returns the part of the frame that is done, or
    /// `None` if it is complete.
    ///
    /// # Errors
    /// [`Error::Simulation`]; [`Error::Differs`].
    pub fn go_on(&mut self) -> Result<Option<f64>, Error> {
        if self.holder.is_done() {
            return Ok(None);
        }
        let (works, all) = (self.works, self.works.turns());
        let next = self.drawn..all.min(self.drawn + TURNS);
        let mut words: Vec<Vec<Composition>> = self.ways.iter().map(|_| Vec::new()).collect();
        let ways = words.len();
        self.waiting.drain(..).enumerate().for_each(|(number, word)| words[number % ways].push(word));

        // The longest jobs come first.
        let mut jobs: Vec<Job> = vec![Job::Holds(&mut self.holder)];
        jobs.extend(self.shaders.iter_mut().map(Job::Shades));
        jobs.extend(self.ways.iter_mut().zip(words).map(|(way, words)| Job::Composes(way, words, Vec::new())));
        if !next.is_empty() {
            let region = self.pixel.map(|pixel| pixel.region);
            let draws = |(number, node)| Job::Draws(node, number, next.clone(), region);
            jobs.extend(self.rasterizers.iter_mut().enumerate().map(draws));
        }
        each_mut(&mut jobs, |_, job| job.run(works))?;
        let composed = |job| if let Job::Composes(_, _, composed) = job { composed } else { Vec::new() };
        let mut composed: Vec<Composed> = jobs.into_iter().flat_map(composed).collect();

        self.drawn = next.end;
        composed.sort_by_key(|it| it.turn);
        composed.into_iter().for_each(|it| self.deliver(it));
        self.take_what_went();
        Ok(Some(1.0 - self.held.len() as f64 / all as f64))
    }

    /// Brings composed words to their receivers, in the sequence of turns.
    fn deliver(&mut self, Composed { turn, target, words, winners }: Composed) {
        if let Some(recording) = self.recording.as_mut().filter(|_| !winners.is_empty()) {
            // On the way to the frame buffer, the last rasterizer is the first.
            let is_back = target == Target::Holder;
            let last = self.rasterizers.len() as u16 - 1;
            let rasterizer = |winner: u16| if is_back { last - winner } else { winner };
            recording.see(self.works, turn, &words, winners.into_iter().map(rasterizer));
        }
        let rasterizers = self.rasterizers.len() as Ticks;
        match target {
            Target::Shader(number) => {
                let from = self.timing.turns[turn].composed.start + rasterizers + number as Ticks;
                let is_followed = self.is_followed(turn);
                let access = Access { from, bank: 0, bytes: self.works.bytes(), comes: Some(words), is_followed };
                self.shaders[number].gets(turn, access);
            }
            Target::Holder => {
                self.early.insert(turn, words);
                while let Some((turn, words)) = self.held.front().and_then(|turn| self.early.remove_entry(turn)) {
                    self.held.pop_front();
                    self.hold(turn, words);
                }
            }
        }
    }

    /// Whether a turn has the pixel that is followed.
    fn is_followed(&self, turn: usize) -> bool {
        self.pixel.is_some_and(|pixel| self.works.region(turn) == pixel.region)
    }

    fn hold(&mut self, turn: usize, words: Words) {
        let (works, done) = (self.works, &self.timing.turns[turn]);
        let rasterizers = self.rasterizers.len();
        let from = match works.shader_of(turn, self.shaders.len()) {
            Some(number) => done.sent.start + (1 + rasterizers + number) as Ticks,
            None => done.composed.start + rasterizers as Ticks,
        };
        if works.has_depths() {
            self.came.push(words.clone());
        }
        let (bank, is_followed) = (works.holders_bank(turn), self.is_followed(turn));
        let access = Access { from, bank, bytes: works.stored(), comes: Some(words), is_followed };
        self.holder.gets(turn, access);
    }

    /// Passes words and colours that left their nodes to the network.
    fn take_what_went(&mut self) {
        let asks = self.recording.is_some();
        let (works, pixel) = (self.works, self.pixel);
        let followed =
            |turn: usize, from: Ticks| pixel.filter(|pixel| works.region(turn) == pixel.region).map(|_| from);
        // Places are counted from the frame buffer's node, or to it.
        let (last, first_shader) = (self.config.nodes as usize - 1, 1 + self.rasterizers.len());
        while self.gone < self.drawn && self.rasterizers.iter().all(|node| node.has_sent(self.gone % 2)) {
            let turn = self.gone;
            let followed = followed(turn, self.timing.turns[turn].composed.start);
            let words = self.rasterizers.iter_mut().map(|node| node.sent(turn % 2).expect("it has sent them"));
            let own = (1..).zip(words);
            self.waiting.push(match self.works.shader_of(turn, self.shaders.len()) {
                Some(number) => {
                    let (target, to) = (Target::Shader(number), first_shader + number);
                    Composition { turn, target, own: own.collect(), to, asks, followed }
                }
                None => {
                    let mut own: Vec<_> = own.map(|(place, words)| (last - place, words)).collect();
                    own.reverse();
                    Composition { turn, target: Target::Holder, own, to: last, asks, followed }
                }
            });
            self.gone += 1;
        }
        for (number, (shader, turns)) in self.shaders.iter_mut().zip(&mut self.colours).enumerate() {
            while let Some(words) = shader.node.sent(1) {
                let turn = turns.pop_front().expect("it sends colours of its turns alone");
                let own = vec![(last - first_shader - number, words)];
                let followed = followed(turn, self.timing.turns[turn].sent.start);
                self.waiting.push(Composition { turn, target: Target::Holder, own, to: last, asks: false, followed });
            }
        }
    }

    /// The displayed frame over that background, the report, and the history if it is recorded.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn end(&mut self, background: [u8; 3]) -> Result<(Picture, Report, Option<History>), Error> {
        let picture = self.works.picture(&self.holder.node.scan()?, &self.came);
        let rasterizers = self.rasterizers.iter().map(Node::busy).collect();
        let shaders = self.shaders.iter().map(|shader| shader.node.busy()).collect();
        let held = self.holder.node.busy();
        let report =
            Report::new(self.config, self.works, std::mem::take(&mut self.timing.turns), [rasterizers, shaders], held)?;
        let history = self.recording.take().map(|recording| {
            let worked = |node: &Node| node.worked().to_vec();
            let nodes = Worked {
                rasterizers: self.rasterizers.iter().map(worked).collect(),
                shaders: self.shaders.iter().map(|shader| worked(&shader.node)).collect(),
                holder: worked(&self.holder.node),
            };
            recording.into_history(self.works, &report, (&picture, background), nodes)
        });
        Ok((picture, report, history))
    }

    /// Keeps the arrays for another frame.
    pub fn keep(self) {
        let shaders = self.shaders.into_iter().map(|shader| shader.node);
        let nodes = [self.holder.node].into_iter().chain(self.rasterizers).chain(shaders);
        nodes.for_each(|node| self.spare.keep(node.into_array()));
    }
}

/// The node of the frame buffer, rasterizers and shaders, built on all processors of the computer.
fn build(
    array: &PixelArray,
    (engine, spare): (EngineKind, &Spare),
    side_by_side: bool,
    shaders: usize,
    works: &Works,
) -> Result<Vec<Node>, Error> {
    let rasterizers = works.shares();
    let mut nodes: Vec<Option<Node>> = (0..1 + rasterizers + shaders).map(|_| None).collect();
    each_mut(&mut nodes, |number, node| {
        let textures = works.textures.iter().map(AsRef::as_ref);
        let (name, beside) = match number.checked_sub(1 + rasterizers) {
            Some(shader) if works.textures.is_empty() => (format!("shader {}", shader + 1), Beside::Nobody),
            Some(shader) => {
                (format!("shader {}", shader + 1), Beside::Texture(TextureLookUp::new(array, textures, engine)?))
            }
            None if number == 0 => {
                ("the node of the frame buffer".to_owned(), Beside::Store(FrameStore::new(works, engine)?))
            }
            None => (format!("rasterizer {number}"), Beside::Nobody),
        };
        *node = Some(Node::new(name, array, spare.take(array, engine)?, side_by_side, beside)?);
        Ok::<(), Error>(())
    })?;
    Ok(nodes.into_iter().flatten().collect())
}
