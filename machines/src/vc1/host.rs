//! The host's program: commands frame after frame, and looks on until each is shown.
//!
//! Source: VC1-FLOW, VC1-SW1 to SW4. The host broadcasts a command. All processing elements draw, through overflows. When all have
//! ended, the sync line rises, and the hardware's swap control does the rest; the host commands the next frame. So frame k + 1 is
//! drawn while frame k is merged and frame k - 1 is shown.

use std::collections::VecDeque;
use std::rc::Rc;

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{Frame, Projection};

use super::assignment::Assignment;
use super::config::Config;
use super::hardware::Hardware;
use super::job::{View, Views};
use super::processor::Processor;
use super::report::{FrameReport, ProcessorReport, Shown, Times};
use super::words::{Message, Word};
use crate::error::Error;
use crate::run::{PROGRESS_CLOCKS, Watch};

/// The host and what it sees.
pub(crate) struct Host<'a, 'w> {
    config: Config,
    hardware: &'a mut Hardware,
    watch: &'a mut Watch<'w>,
    views: Views,
    /// Words of the command that it sends.
    words: VecDeque<Word>,
    /// Frames that are commanded and not yet seen, the oldest first.
    frames: VecDeque<InFlight>,
    /// Frames that have been commanded, and shown.
    commanded: u32,
    shown: u32,
    /// When the frame before was shown, in refreshes.
    refresh: u64,
    first: Option<Assignment>,
}

/// A frame from its command until it has been seen.
struct InFlight {
    number: u32,
    view: Rc<View>,
    times: Times,
    /// By processing element, when it had drawn.
    pages: Vec<u32>,
    refreshes: u64,
    /// What the display gets in its first refresh, and the words that the bank has.
    colours: Vec<u32>,
    words: Vec<u64>,
}

impl<'a, 'w> Host<'a, 'w> {
    pub fn new(config: Config, hardware: &'a mut Hardware, watch: &'a mut Watch<'w>, views: Views) -> Host<'a, 'w> {
        Host {
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

    /// Draws a frame of each view, until there is none more; `seen` gets each frame, and says whether to go on.
    pub fn run(
        &mut self,
        processors: &mut [Processor],
        views: &mut dyn FnMut() -> Option<Projection>,
        seen: &mut dyn FnMut(Shown) -> bool,
    ) -> Result<(), Error> {
        let mut next = views();
        for clock in 0.. {
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
            }
            let pixels = self.config.size.pixels();
            let display = self.frames.front_mut().filter(|it| it.times.shown.is_some() && it.colours.len() < pixels);
            let line = self.hardware.clock(processors, display.map(|frame| &mut frame.colours))?;
            self.watch_frames(processors, line);
            if let Some(frame) = self.frames.pop_front_if(|frame| frame.is_seen(pixels, self.shown)) {
                self.views.remove(frame.number);
                let shown = self.shown(frame, processors)?;
                if !seen(shown) || self.frames.is_empty() && next.is_none() {
                    return Ok(());
                }
            }
        }
        unreachable!("the frames end before the clocks")
    }

    /// Begins to send the command of the next frame.
    fn command(&mut self, view: Projection) -> Result<(), Error> {
        let (asked, size) = (view.size, self.config.size);
        if asked != size {
            let problem = format!("a projection of {asked} pixels on a machine of {size}: project the scene again");
            return Err(ParameterError(problem).into());
        }
        let view = View::new(&self.config, view, self.first.as_ref())?;
        self.first.get_or_insert_with(|| view.assignment.clone());
        let number = self.commanded;
        self.words.extend(Message::Command { frame: number }.words());
        let times = Times { command: self.hardware.time(), ..Times::default() };
        self.frames.push_back(InFlight {
            number,
            view: self.views.insert(number, view),
            times,
            pages: Vec::new(),
            refreshes: 0,
            colours: Vec::new(),
            words: Vec::new(),
        });
        self.commanded += 1;
        Ok(())
    }

    /// Notes what has become of the frames in the clock that is over, and whether the line was high in it.
    fn watch_frames(&mut self, processors: &[Processor], line: bool) {
        let time = self.hardware.time();
        for frame in &mut self.frames {
            let times = &mut frame.times;
            let is_over = |it: &Processor| it.frames().len() > frame.number as usize;
            if times.drawn.is_none() {
                if line {
                    times.drawn = Some(time);
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
                    frame.words = self.hardware.displayed();
                    self.shown += 1;
                }
            }
        }
    }

    /// What has become of a frame that has been shown for a refresh.
    fn shown(&self, frame: InFlight, processors: &[Processor]) -> Result<Shown, Error> {
        let InFlight { number, view, times, pages, refreshes, colours, words } = frame;
        let size = self.config.size;
        let differs = colours.iter().zip(&words).position(|(colour, word)| u64::from(*colour) != word & 0xff_ffff);
        if let Some(place) = differs {
            let width = size.width() as usize;
            return Err(Error::Displayed { x: (place % width) as u32, y: (place / width) as u32 });
        }
        let report = |(k, it): (usize, &Processor)| {
            let tally = it.frames()[number as usize];
            ProcessorReport {
                polygons: view.polygons(k as u32).len() as u32,
                expected: view.assignment.loads[k],
                pixels: tally.pixels,
                pages: pages[k],
                overflows: tally.overflows,
                broadcast: tally.broadcast,
                clocks: tally.clocks,
            }
        };
        let processors: Vec<ProcessorReport> = processors.iter().enumerate().map(report).collect();
        let report = FrameReport { packets: view.packets.len() as u64, times, refreshes, processors };
        let frame = Frame::from_words(size, words).expect("there is a word of 48 bits for each pixel");
        Ok(Shown { number, frame, report })
    }

    /// Tells the caller how far the oldest frame is, and stops if the caller wants it.
    fn progress(&mut self, processors: &[Processor]) -> Result<(), Error> {
        let time = self.hardware.time();
        let Some(frame) = self.frames.front() else { return Ok(()) };
        let (phase, fraction) = match frame.times {
            Times { shown: Some(_), .. } => ("showing", frame.colours.len() as f64 / self.config.size.pixels() as f64),
            Times { swapped: Some(swapped), .. } => {
                let t_m = self.hardware.merge_clocks * tilewright_rtl::clocks::MERGE.period.picoseconds();
                ("merging", ((time - swapped) as f64 / t_m as f64).min(1.0))
            }
            Times { drawn: Some(_), .. } => ("swapping", 0.0),
            _ => {
                let left = |(k, it): (usize, &Processor)| it.polygons_left(frame.view.polygons(k as u32).len());
                let left: usize = processors.iter().enumerate().map(left).sum();
                ("drawing", 1.0 - left as f64 / f64::from(frame.view.count.max(1)))
            }
        };
        self.watch.go_on(phase, fraction, time)
    }
}

impl InFlight {
    /// Whether the display has had all of it, or has nothing of it as another frame came within the same blanking.
    fn is_seen(&self, pixels: usize, shown: u32) -> bool {
        let is_missed = self.colours.is_empty() && shown > self.number + 1;
        self.times.shown.is_some() && (self.colours.len() == pixels || is_missed)
    }
}
