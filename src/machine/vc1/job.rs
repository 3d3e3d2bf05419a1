//! A picture on the VC-1.

use crate::golden;
use crate::machine::figures::{Compared, Figures, elaborated, state};
use crate::machine::job::{Job, Run};
use crate::machine::viewed::Viewed;
use crate::shell::Failure;
use tilewright_hdl::Design;
use tilewright_machines::vc1::{Config, Machine, Report, Shown, Times};
use tilewright_rtl::clocks::PE;
use tilewright_scenes::golden::{average, render_watched};
use tilewright_scenes::{Frame, Projection, Size};
use tilewright_view::{Clock, Grid};

/// A picture of a scene, and the machine for it.
pub struct Vc1Job {
    pub(super) config: Config,
    /// One view, or that of each pass.
    pub(super) views: Vec<Projection>,
    pub(super) background: [u8; 3],
}

impl Job for Vc1Job {
    type Report = Report;

    fn size(&self) -> Size {
        self.config.size
    }

    fn golden(&self) -> Result<Frame, Failure> {
        golden_of(&self.config, &self.views, self.background)
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        let mut machine = Machine::new(self.config)?.on(run.engine());
        if let Some(recorder) = run.recorder {
            machine = machine.recorded(recorder);
        }
        if let Some(follower) = run.follower {
            machine = machine.following(follower);
        }
        run.attach(machine.simulation())?;
        let (mut views, mut picture) = (self.views.iter().cloned(), None);
        let seen = |shown: Shown| {
            picture = Some(shown.average.unwrap_or(shown.frame));
            true
        };
        let report = run
            .watch(|watch| machine.render_frames(self.background, watch, || views.next(), seen), Report::picoseconds)?;
        Ok((picture.expect("a view has a frame"), report))
    }
}

impl Compared for Vc1Job {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let hardware = state(&self.config.hardware().map_err(tilewright_machines::Error::from)?)?;
        let (picoseconds, processors) =
            (report.picoseconds() - report.frames[0].times.command, report.machine.processors);
        let clocks = picoseconds / PE.period.picoseconds();
        let frame = report.frames.last().expect("a picture has a frame");
        let Times { command, drawn, swapped, merged, shown, averaged } = frame.times;
        let parts = [
            ("drawing", Some(command), drawn),
            ("swapping", drawn, swapped),
            ("merging", swapped, merged),
            ("blanking", merged, shown),
            ("averaging", shown, averaged.or(shown)),
        ];
        let parts = parts.map(|(name, from, to)| (name, to.unwrap_or_default() - from.unwrap_or_default()));
        let (limit, longest) = parts.into_iter().max_by_key(|(_, time)| *time).unwrap_or_default();
        let of_processors = report.frames.iter().flat_map(|frame| &frame.processors);
        let working: u64 = of_processors.map(|it| it.clocks.work()).sum();
        let pixels = report.frames.iter().map(|frame| frame.pixels()).sum();
        Ok(Figures {
            processors,
            processor: "processing elements".to_owned(),
            register_bits: hardware.registers,
            memory_bits: hardware.memories,
            clocks,
            picoseconds,
            time: "from the command until the display shows the frame; drawing includes geometry, and blanking is the wait for the display"
                .to_owned(),
            // Spans are computed, so every tested pixel is drawn.
            tested: pixels,
            drawn: pixels,
            at_work: working as f64 / (clocks.max(1) * u64::from(processors)) as f64,
            limit: limit.to_owned(),
            limit_share: longest as f64 / frame.picoseconds().max(1) as f64,
        })
    }
}

/// The software rasterizer's picture: a frame, or the average of passes, and the cursor.
pub(super) fn golden_of(config: &Config, views: &[Projection], background: [u8; 3]) -> Result<Frame, Failure> {
    let count = views.len() as f64;
    golden::draw(|watch| {
        let pass = |(number, view): (usize, &Projection)| {
            render_watched(view.size, &view.triangles, background, |done| watch((number as f64 + done) / count))
        };
        let passes: Vec<Frame> = views.iter().enumerate().map(pass).collect::<Option<_>>()?;
        let mut picture = average(&passes);
        if let Some(cursor) = config.cursor {
            cursor.draw(&mut picture);
        }
        Some(picture)
    })
}

impl Viewed for Vc1Job {
    fn clock(&self, _: &Report) -> Clock {
        Clock { name: "the processing elements".to_owned(), picoseconds: PE.period.picoseconds() }
    }

    fn grid(&self) -> Option<Grid> {
        let side = self.config.patch;
        Some(Grid { name: format!("patches of {side}x{side}, each a page"), size: [side; 2] })
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        elaborated(&self.config.hardware().map_err(tilewright_machines::Error::from)?).map(Some)
    }
}
