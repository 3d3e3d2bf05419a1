//! The host's program: it commands frame after frame, and waits until each is shown.
//!
//! Source: VC1-FLOW, VC1-SW1 to SW4. The host broadcasts a command. All processing elements draw, through overflows. When all have
//! ended, the sync line rises, and the hardware's swap control does the rest; the host commands the next frame. So frame k + 1 is
//! drawn while frame k is merged and frame k - 1 is shown.

use std::collections::{HashSet, VecDeque};
use std::sync::Arc;

use tilewright_rtl::gfb::Passes;
use tilewright_scenes::{Frame, Projection};

use super::comparison::Comparison;
use super::config::Config;
use super::display::Viewer;
use super::hardware::Hardware;
use super::job::{View, Views};
use super::model::{Event, Model};
use super::processor::Processor;
use super::report::{FrameReport, ProcessorReport, Shown, Times};
use super::words::{Message, Word};
use crate::error::Error;
use crate::run::{PROGRESS_CLOCKS, Watch};

/// The host and its view of the machine.
pub(crate) struct Host<'a, 'w> {
    config: Config,
    hardware: &'a mut Hardware,
    watch: &'a mut Watch<'w>,
    views: Views,
    viewer: Viewer,
    /// The model, with which everything is compared.
    comparison: Comparison<'a>,
    /// The first difference from the model's clocks, after which a machine that follows a pixel still runs until that time.
    differed: Option<(Error, u64)>,
    /// The edge at which a blanking ended last.
    dawn: u64,
    /// Words of the command that it is sending.
    words: VecDeque<Word>,
    /// The scene's assignment from its first view on.
    pub scene: Loaded,
    /// Frames that are commanded and not checked yet, the oldest first.
    frames: VecDeque<InFlight>,
    /// The numbers of commanded and of shown frames.
    commanded: u32,
    shown: u32,
    /// The refresh in which the frame before was shown.
    refresh: u64,
    first: Option<Arc<View>>,
}

/// A scene in the processing elements' memories.
#[derive(Clone, Copy, Default)]
pub(crate) struct Loaded {
    pub polygons: u32,
    /// Words to load it: 24 bytes a vertex, 12 a triangle.
    pub words: u64,
}

impl Loaded {
    pub fn of(view: &Projection) -> Loaded {
        let vertices: HashSet<_> = view.corners.iter().flatten().collect();
        Loaded { polygons: view.counts.polygons, words: 6 * vertices.len() as u64 + 3 * view.corners.len() as u64 }
    }
}

/// A frame from its command until it has been checked.
struct InFlight {
    number: u32,
    view: Arc<View>,
    times: Times,
    /// By processing element, the state at the end of its drawing.
    pages: Vec<u32>,
    refreshes: u64,
    /// Words that the host sent for it.
    words: u64,
    /// The displayed frame.
    frame: Option<Frame>,
    average: Option<Frame>,
}

impl<'a, 'w> Host<'a, 'w> {
    /// Checks every refresh, or the first one of each frame.
    pub fn new(
        config: Config,
        hardware: &'a mut Hardware,
        watch: &'a mut Watch<'w>,
        views: Views,
        every: bool,
        model: &'a Model,
    ) -> Host<'a, 'w> {
        let passes = config.accumulate.map(Passes::count);
        Host {
            viewer: Viewer::new(config.size, passes, config.cursor, (every, hardware.following.is_some())),
            comparison: Comparison::new(model),
            differed: None,
            dawn: 0,
            scene: Loaded::default(),
            config,
            hardware,
            watch,
            views,
            words: VecDeque::new(),
            frames: VecDeque::new(),
            commanded: 0,
            shown: 0,
            refresh: 0,
            first: None,
        }
    }

    /// Draws a frame of each view. `seen` gets each frame, and returns whether to go on.
    pub fn run(
        &mut self,
        processors: &mut [Processor],
        views: &mut dyn FnMut() -> Option<Projection>,
        seen: &mut dyn FnMut(Shown) -> bool,
    ) -> Result<(), Error> {
        let mut next = views();
        let mut clock = 0;
        loop {
            if self.frames.back().is_none_or(|frame| frame.times.drawn.is_some())
                && let Some(view) = next.take()
            {
                self.command(view)?;
                next = views();
            }
            if self.hardware.takes_command() {
                let word = self.words.pop_front();
                self.hardware.command(word);
            }
            if clock % PROGRESS_CLOCKS == 0 {
                self.progress(processors)?;
                self.compare()?;
                let is_late = |it: u64| self.hardware.time() > it + self.hardware.frame_time();
                if self.hardware.following.is_some()
                    && self.frames.front().and_then(|it| it.times.shown).is_some_and(is_late)
                {
                    self.viewer.give_up()?;
                }
            }
            clock += self.rest(PROGRESS_CLOCKS - 1 - clock % PROGRESS_CLOCKS)? + 1;
            let had_begun = self.viewer.has_begun();
            let line = self.hardware.clock(processors, self.viewer.colours())?;
            if self.viewer.has_begun() && !had_begun {
                let compared = self.comparison.refresh(self.dawn, self.hardware.edge());
                self.tolerate(compared)?;
            }
            self.watch_frames(processors, line);
            self.watch_display()?;
            let is_seen = |it: &mut InFlight| it.times.shown.is_some() && self.viewer.has_seen(it.number);
            if let Some(frame) = self.frames.pop_front_if(is_seen) {
                self.views.remove(frame.number);
                let shown = self.shown(frame, processors);
                self.comparison.show(shown.report.clone());
                if !seen(shown) || self.frames.is_empty() && next.is_none() {
                    self.compare()?;
                    return self.differed.take().map_or(Ok(()), |(error, _)| Err(error));
                }
            }
        }
    }

    /// Compares all events with the model.
    fn compare(&mut self) -> Result<(), Error> {
        #[cfg(test)]
        if self.hardware.flips != 0 {
            return Ok(());
        }
        let events = std::mem::take(&mut self.hardware.notes.events);
        if self.differed.is_none() {
            self.comparison.see(events);
            let compared = self.comparison.compare(self.hardware.edge());
            self.tolerate(compared)?;
        }
        match &self.differed {
            Some((_, until)) if self.hardware.time() > *until => Err(self.differed.take().expect("it is there").0),
            _ => Ok(()),
        }
    }

    /// Stops at a difference from the model, unless a pixel is followed, whose way is to be told to its end. The machine has the time for that.
    fn tolerate(&mut self, compared: Result<(), Error>) -> Result<(), Error> {
        match compared {
            Err(error) if self.hardware.following.is_some() => {
                let until = 2 * self.hardware.time() + self.hardware.frame_time();
                self.differed.get_or_insert((error, until));
                Ok(())
            }
            other => other,
        }
    }

    /// The number of events compared with the model.
    pub fn compared(&self) -> u64 {
        self.comparison.compared
    }

    /// Advances through clocks, at most this number, in which no frame can progress. Returns their number.
    fn rest(&mut self, clocks: u64) -> Result<u64, Error> {
        if self.viewer.is_looking() || !self.words.is_empty() {
            return Ok(0);
        }
        let is_due = |frame: &&InFlight| frame.times.shown.is_none();
        let until = match self.frames.iter().find(is_due).map(|frame| frame.times) {
            None => u64::MAX,
            Some(Times { merged: Some(_), .. }) => self.hardware.next_blanking(),
            Some(Times { swapped: Some(swapped), .. }) => swapped + self.hardware.merge_time(),
            Some(_) => return self.hardware.compute(clocks, u64::MAX),
        };
        match self.hardware.rest(clocks, until)? {
            0 => self.hardware.compute(clocks, until),
            clocks => Ok(clocks),
        }
    }

    /// The number of refreshes compared with the frame buffer.
    pub fn judged(&self) -> u64 {
        self.viewer.judged
    }

    /// Begins to send the command of the next frame.
    fn command(&mut self, view: Projection) -> Result<(), Error> {
        let view = Arc::new(View::new(&self.config, Arc::new(view), self.first.as_deref().map(|it| &it.assignment))?);
        self.first.get_or_insert_with(|| view.clone());
        let number = self.commanded;
        if number == 0 {
            self.scene = Loaded::of(&view.projection);
        }
        self.views.insert(number, view.clone());
        self.comparison.command(view.clone());
        if let Some(following) = &mut self.hardware.following {
            following.command(&view);
        }
        let packets = Message::begin(number, self.config.immediate.then_some(self.scene.words));
        self.words.extend(packets.iter().flat_map(Message::words));
        let times = Times { command: self.hardware.time(), ..Times::default() };
        self.frames.push_back(InFlight {
            number,
            view,
            times,
            pages: Vec::new(),
            refreshes: 0,
            words: self.words.len() as u64,
            frame: None,
            average: None,
        });
        self.commanded += 1;
        Ok(())
    }

    /// Notes the progress of frames in the last clock, and whether the sync line was high in it.
    fn watch_frames(&mut self, processors: &[Processor], line: bool) {
        let time = self.hardware.time();
        for frame in &mut self.frames {
            let times = &mut frame.times;
            let is_over = |it: &Processor| it.frames().len() > frame.number as usize;
            if times.drawn.is_none() {
                if line {
                    times.drawn = Some(time);
                    if let Some(following) = &mut self.hardware.following {
                        following.drawn(time / Event::PE_PERIOD);
                    }
                    frame.pages = (0..processors.len()).map(|k| self.hardware.pages_used(k)).collect();
                }
            } else if times.swapped.is_none() {
                times.swapped = processors.iter().all(is_over).then_some(time);
            } else if times.shown.is_none() && frame.number == self.shown {
                if times.merged.is_none() && self.hardware.is_merged() {
                    times.merged = Some(time);
                }
                if self.hardware.shown() != (self.shown % 2 == 1) {
                    times.shown = Some(time);
                    let refresh = self.hardware.refresh();
                    frame.refreshes = refresh - std::mem::replace(&mut self.refresh, refresh);
                    let shown = self.viewer.show(frame.number, self.hardware.displayed());
                    (frame.frame, frame.average) = (Some(shown.frame.clone()), shown.average.clone());
                    if let Some(cursor) = self.config.cursor {
                        self.hardware.write(cursor.words(self.config.size));
                    }
                    self.shown += 1;
                }
            }
        }
    }

    /// Checks the refreshes of the display.
    fn watch_display(&mut self) -> Result<(), Error> {
        self.viewer.judge()?;
        if self.hardware.dawns() {
            self.dawn = self.hardware.edge();
        }
        // Pixels that the host still writes appear in the next refresh.
        if self.hardware.dawns() && self.hardware.has_written() && self.viewer.begin(self.hardware.averages()) {
            let time = self.hardware.time();
            let picture = self.frames.iter_mut().rfind(|frame| frame.average.is_some());
            if let Some(picture) = picture {
                picture.times.averaged = Some(time);
            }
        }
        Ok(())
    }

    /// The result of a frame that has been shown for a refresh.
    fn shown(&self, frame: InFlight, processors: &[Processor]) -> Shown {
        let InFlight { number, view, times, pages, refreshes, words, frame, average } = frame;
        let tallies = processors.iter().map(|it| &it.frames()[number as usize]);
        let processors = (0..).zip(tallies).zip(pages);
        let processors = processors.map(|((k, tally), pages)| ProcessorReport::of(&view, k, tally, pages)).collect();
        let report = FrameReport::of(&view, words, times, refreshes, processors);
        let mut frame = frame.expect("it has come on display");
        self.viewer.colour(&mut frame);
        Shown { number, frame, average, report }
    }

    /// Reports the progress of the oldest frame, and stops if the caller asks for it.
    fn progress(&mut self, processors: &[Processor]) -> Result<(), Error> {
        let time = self.hardware.time();
        let Some(frame) = self.frames.front() else { return Ok(()) };
        let (phase, fraction) = match frame.times {
            Times { shown: Some(_), .. } => ("showing", self.viewer.fraction()),
            Times { swapped: Some(swapped), .. } => {
                ("merging", ((time - swapped) as f64 / self.hardware.merge_time() as f64).min(1.0))
            }
            Times { drawn: Some(_), .. } => ("swapping", 0.0),
            _ => {
                let left = |(k, it): (usize, &Processor)| it.polygons_left(frame.view.polygons(k as u32).len());
                let left: usize = processors.iter().enumerate().map(left).sum();
                ("drawing", 1.0 - left as f64 / f64::from(frame.view.projection.counts.polygons.max(1)))
            }
        };
        self.watch.go_on(phase, fraction, time)
    }
}
