//! Figure 6 in the circuit: three frames of four processing elements, one of which overflows in the last frame.

use super::observed::observed;
use tilewright_machines::vc1::{Assign, Config, CostTable, Machine};
use tilewright_machines::{Error, Watch};
use tilewright_report::{Lane, Origin, Rule, Section, Statement, Timeline, Verdict};
use tilewright_rtl::swap::SwapState;
use tilewright_scenes::{Projection, ScreenVertex, Size};

const PROCESSORS: usize = 4;
/// Pages of each processing element, and patches that it draws on. The first one draws on more in the last frame.
pub const PAGES: u32 = 2;
const PATCHES: i32 = 2;
const TOO_MANY: i32 = 4;

/// The eight events of the figure, as in the paper.
const EVENTS: [&str; 8] = [
    "the local frame buffers swap",
    "the next frame is begun",
    "the frame is merged",
    "the global frame buffer swaps",
    "a swap that waited for it",
    "an overflow",
    "its swap",
    "drawing goes on",
];

/// The states of the processing elements, the merger and the display.
#[derive(Default)]
pub struct Figure6 {
    /// By processing element: its activities, with begin and end in ms.
    lanes: Vec<Vec<(Doing, f64, f64)>>,
    /// The times at which a frame is stored, and at which the banks change.
    merged: Vec<f64>,
    shown: Vec<f64>,
    end: f64,
}

/// The activity of a processing element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doing {
    Clearing,
    Drawing,
    /// It has drawn, and waits for the others.
    Synchronizing,
    /// All have drawn, and its swap waits.
    Due,
    Overflow,
}

impl Doing {
    fn name(self) -> &'static str {
        match self {
            Doing::Clearing => "clearing the table",
            Doing::Drawing => "drawing",
            Doing::Synchronizing => "waiting for all",
            Doing::Due => "waiting for its swap",
            Doing::Overflow => "out of pages",
        }
    }
}

impl Figure6 {
    /// Runs the machine.
    ///
    /// # Errors
    /// The simulator's.
    pub fn ran(pages: u32, watch: &mut Watch) -> Result<Figure6, Error> {
        let views = [PATCHES, PATCHES, TOO_MANY].map(view);
        let mut views = views.into_iter().collect::<Result<Vec<_>, Error>>()?.into_iter();
        let signals = (0..PROCESSORS).flat_map(|k| ["state", "done"].map(|name| format!("processors_{k}_{name}")));
        let signals: Vec<String> = signals.chain(["is_merged", "shown"].map(str::to_owned)).collect();
        let mut figure = Figure6 { lanes: vec![Vec::new(); PROCESSORS], ..Figure6::default() };
        let (mut before, mut was) = (0.0, [0; 2]);
        let seen = |time: u64, values: &[u64]| {
            let now = time as f64 / 1e9;
            figure.take(&values[..2 * PROCESSORS], before, now);
            let is = [values[2 * PROCESSORS], values[2 * PROCESSORS + 1]];
            if (was[0], is[0]) == (0, 1) {
                figure.merged.push(before);
            }
            if was[1] != is[1] {
                figure.shown.push(before);
            }
            (before, was, figure.end) = (now, is, now);
        };
        observed(Machine::new(config(pages)?)?, &signals, seen, |machine| {
            machine.render_frames([0; 3], watch, || views.next(), |_| true)
        })?;
        Ok(figure)
    }

    /// States and flags of all processing elements in that time.
    fn take(&mut self, values: &[u64], from: f64, to: f64) {
        for (lane, values) in self.lanes.iter_mut().zip(values.chunks(2)) {
            let doing = match (SwapState::of_code(values[0]), values[1]) {
                (SwapState::Clear, _) => Doing::Clearing,
                (SwapState::Draw, 0) => Doing::Drawing,
                (SwapState::Draw, _) => Doing::Synchronizing,
                (SwapState::Due, _) => Doing::Due,
                (SwapState::Overflow, _) => Doing::Overflow,
            };
            match lane.last_mut().filter(|(before, ..)| *before == doing) {
                Some((.., end)) => *end = to,
                None => lane.push((doing, from, to)),
            }
        }
    }

    /// The first time after `after` at which a processing element goes from one activity to another.
    fn first(&self, processor: usize, after: f64, change: (Doing, Doing)) -> Option<f64> {
        let pairs = self.lanes[processor].windows(2).map(|pair| (pair[1].1, (pair[0].0, pair[1].0)));
        pairs.filter(|(at, found)| *at >= after && *found == change).map(|(at, _)| at).next()
    }

    /// The first time of each event in ms, or `None`. The events are those of the first processing element, which overflows at the end.
    fn events(&self) -> [Option<f64>; 8] {
        let swap = self.first(0, 0.0, (Doing::Due, Doing::Clearing));
        let begun = swap.and_then(|at| self.first(0, at, (Doing::Clearing, Doing::Drawing)));
        let [merged, shown] = [&self.merged, &self.shown].map(|all| all.first().copied());
        // It was due before the global frame buffer swapped, and came after that.
        let postponed = shown.and_then(|shown| {
            let lane = self.lanes[0].windows(2);
            let waited = lane.filter(|pair| pair[0].0 == Doing::Due && pair[0].1 < shown && pair[0].2 >= shown);
            waited.map(|pair| pair[0].2).next()
        });
        let overflow = self.lanes[0].iter().find(|(doing, ..)| *doing == Doing::Overflow).map(|(_, at, _)| *at);
        let swapped = overflow.and_then(|at| self.first(0, at, (Doing::Overflow, Doing::Clearing)));
        let resumed = swapped.and_then(|at| self.first(0, at, (Doing::Clearing, Doing::Drawing)));
        [swap, begun, merged, shown, postponed, overflow, swapped, resumed]
    }

    /// The events sorted by time.
    pub fn statement(&self) -> Statement {
        let mut order: Vec<(f64, usize)> =
            self.events().into_iter().zip(1..).filter_map(|(at, number)| Some((at?, number))).collect();
        order.sort_by(|one, other| one.0.total_cmp(&other.0));
        let place = |at: usize| format!("{}.", at + 1);
        Statement::new(
            "VC1-SW1 to SW4",
            "Buffers swap in the sequence of Figure 6: its events 1 to 8, sorted by time.",
            Rule::Equals,
        )
        .unit("event")
        .paper((0..8).map(|at| (place(at), at as f64 + 1.0)))
        .found(Origin::rtl([]), order.into_iter().enumerate().map(|(at, (_, number))| (place(at), number as f64)))
    }

    /// The times at which local frame buffers swapped.
    fn swaps(&self) -> impl Iterator<Item = f64> {
        let pairs = self.lanes.iter().flat_map(|lane| lane.windows(2));
        pairs.filter(|pair| pair[1].0 == Doing::Clearing).map(|pair| pair[1].1)
    }

    pub fn section(&self) -> Section {
        let size = size();
        Section::new("Figure 6 in the circuit")
            .paragraph(format!(
                "{PROCESSORS} processing elements draw three frames on a screen of {size} pixels, with T_m in the paper’s ratio to a refresh. Each draws on {PATCHES} patches and has \
                 {PAGES} pages, except that the first one draws on {TOO_MANY} in the last frame. The times are those of signals in the circuit."
            ))
            .figure(
                match self.statement().verdict() {
                    Verdict::Holds => "The eight events come in the paper’s sequence.",
                    _ => "The events do not come in the paper’s sequence.",
                },
                self.chart(),
            )
    }

    fn chart(&self) -> Timeline {
        let events = self.events();
        let event = |lane: Lane, number: usize| match events[number - 1] {
            Some(at) => lane.event(number.to_string(), EVENTS[number - 1], at),
            None => lane,
        };
        let lane = |(number, spans): (usize, &Vec<(Doing, f64, f64)>)| {
            let lane = Lane::new(format!("PE {number}"));
            // There is no command after the last frame.
            let last = spans.iter().rposition(|(doing, ..)| *doing == Doing::Due).unwrap_or_default();
            let lane = spans[..=last].iter().fold(lane, |lane, (doing, from, to)| lane.span(doing.name(), *from, *to));
            if number == 0 { [1, 2, 5, 6, 7, 8].into_iter().fold(lane, event) } else { lane }
        };
        let chart = Timeline::new("figure-6", "Swaps of local and global frame buffers", "time, ms", Origin::rtl([]));
        let chart = self.lanes.iter().enumerate().map(lane).fold(chart, Timeline::lane);
        // A frame is merged from the first swap of its own to the end of the last round.
        let before = |number: usize| if number == 0 { 0.0 } else { self.merged[number - 1] };
        let first = |number: usize| self.swaps().filter(|at| *at > before(number)).fold(f64::INFINITY, f64::min);
        let merger = self.merged.iter().enumerate();
        let merger = merger.fold(Lane::new("merger"), |lane, (number, end)| lane.span("merging", first(number), *end));
        let shown = self.shown.iter().copied().zip(self.shown.iter().copied().skip(1).chain([self.end])).enumerate();
        let display = shown.fold(Lane::new("display"), |lane, (number, (from, to))| {
            lane.span(format!("frame {}", number + 1), from, to)
        });
        chart.lane(event(merger, 3)).lane(event(display, 4))
    }
}

fn size() -> Size {
    Size::new(64, 48).expect("in range")
}

/// The cost of set-up makes drawing about as long as a refresh; the ratio of T_m to a refresh is that of the paper's screen.
fn config(pages: u32) -> Result<Config, Error> {
    let free = CostTable { vertex: 0, polygon: 0, area: 0, clip: 0, set_up: 2000, row: 0, ..CostTable::default() };
    let config = Config {
        processors: PROCESSORS as u32,
        pages: Some(pages),
        cluster: 1,
        assign: Assign::Count,
        apr: None,
        costs: free,
        ..Config::new(size())
    };
    let merge_clocks = config.hardware()?.gfb().sequencer().merge_clocks();
    Ok(Config { refresh: 60.0 * 316_864.0 / merge_clocks as f64, ..config })
}

/// Each processing element draws a bar of two triangles, four rows below the one before it. The first one's bar covers `patches` patches.
fn view(patches: i32) -> Result<Projection, Error> {
    let at = |x: i32, y: i32| ScreenVertex { x: 16 * x + 4, y: 16 * y - 8, z: 5, rgb: [200, 100, 50] };
    let bar = |number: usize| {
        let (row, right) = (1 + 8 * number as i32, 4 * if number == 0 { patches } else { PATCHES });
        [[at(0, row), at(right, row), at(right, row + 1)], [at(0, row), at(right, row + 1), at(0, row + 1)]]
    };
    let bars: Vec<_> = (0..PROCESSORS).map(bar).collect();
    let triangles = [0, 1].into_iter().flat_map(|half| bars.iter().map(move |bar| bar[half]));
    Ok(Projection::of_triangles(size(), triangles))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_events_come_in_the_papers_order() {
        let figure = Figure6::ran(PAGES, &mut Watch::default()).expect("it runs");
        assert_eq!(figure.statement().verdict().to_string(), "holds", "{:?} {:?}", figure.events(), figure.lanes);
        // Two swapped events are noticed.
        let other = Figure6 { merged: vec![figure.shown[0] + 1e-3], ..figure };
        assert!(other.statement().verdict().to_string().starts_with("differs"));
    }
}
