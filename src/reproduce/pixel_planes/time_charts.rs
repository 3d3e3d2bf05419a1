//! The update time of random vectors by renderers, regions and vectors, and the influence of the ring.

use super::bins::EXAMPLE;
use super::plan::{Plan, RENDERERS, Spec};
use super::times::{Run, Times, Took};
use crate::reproduce::words::{percent, short};
use tilewright_machines::pixel_planes::{Config, PERIOD, Row, Shape, Table, VECTOR_CYCLES, least_load};
use tilewright_report::{Axis, Cell, Chart, Origin, Section, Series};

/// The section of the update time.
pub fn section(plan: &Plan, times: &Times, table: &Table) -> Section {
    let charts = Charts { plan, times };
    Section::new("Update time")
        .paragraph(
            "By the paper a frame takes N P_w T: N clocks of 25 ns for each of the P_w primitives of the busiest renderer. Its 239 ns a vector mean N = 94. It does not say how many bits the edges, \
             depth and colour of its vectors had. The table has N of the programs here. The figures show random vectors in one colour with a depth test, so that the nearest stays.",
        )
        .part(cycles(table))
        .paragraph(format!(
            "The line of N = 94 is the paper’s, with its H_v. The other lines have N of our program and bins of the vectors themselves. With an ample ring instructions come in time, so the line is N \
             P_w T in perfect balance. A ring of {} has to bring {} bits for each instruction, and all pixels of finished regions, a line of one bit a clock. Where that takes longer than drawing, the \
             line shows the ring. Hollow marks are the transaction model’s clocks until the last vector is drawn; filled marks are the circuit’s.",
            ring_in_words(),
            tilewright_rtl::pixel_planes::ring::Ring::INSTRUCTION
        ))
        .figure(charts.by_ring(), charts.against(&BY_RENDERERS))
        .figure(charts.best_side(), charts.against(&BY_SIDE))
        .paragraph(
            "The formula leaves out a fixed time of each frame: every region is cleared, saved and sent, even an empty one. With few vectors that is most of the frame. With \
             many renderers, or small regions, renderers also wait until their last region is sent.",
        )
        .figure(charts.few_and_many(), charts.against(&BY_VECTORS))
        .paragraph(format!(
            "The formula assumes that renderers never wait for primitives. With many renderers and the ring of {} they do. “Waiting” is the share of their clocks in which they could have begun an \
             instruction that had not arrived; “ring” is the share of the ring’s capacity that is used.",
            ring_in_words()
        ))
        .figure(charts.starved(), charts.waiting())
}

/// The usual bandwidth of the ring.
pub fn ring_in_words() -> String {
    format!("{} Gbit/s", f64::from(Config::RING) / 1000.0)
}

/// N of the programs.
fn cycles(table: &Table) -> tilewright_report::Table {
    let columns = ["program", "primitives", "edges", "one at a time, worst", "mean", "side by side, worst", "mean "];
    let note = format!(
        "Clocks per primitive, with regions of 128x128. “Worst” is that of the worst possible primitive; “mean” is over random vectors of 50 pixels, or over the teapot’s triangles. The paper’s \
         239 ns a vector are {VECTOR_CYCLES} clocks."
    );
    let empty = tilewright_report::Table::new("cycles", "N of each program", columns).note(note);
    table.rows.chunks_exact(2).filter(|pair| pair[0].mean.is_some()).fold(empty, |printed, pair| {
        let [alone, beside] = [&pair[0], &pair[1]];
        let words = [alone.program.to_owned(), alone.primitives.to_string(), alone.edges.to_owned()].map(Cell::from);
        let worst = |row: &Row| Cell::Number(row.worst as f64);
        let mean = |row: &Row| row.mean.map_or(Cell::from("–"), Cell::Number);
        let numbers = [worst(alone), mean(alone), worst(beside), mean(beside)];
        printed.row(words.into_iter().chain(numbers))
    })
}

/// A figure: its axis and its runs.
struct Figure {
    id: &'static str,
    title: &'static str,
    x: fn() -> Axis,
    y: fn() -> Axis,
    /// Whether one of the usual runs belongs to it.
    is_of: fn(&Spec, &Spec) -> bool,
    at: fn(&Spec) -> f64,
    /// Its unit, in nanoseconds of a frame.
    of: fn(&Spec, f64) -> f64,
}

const PER_VECTOR: fn(&Spec, f64) -> f64 = |spec, time| time / spec.vectors as f64;

const BY_RENDERERS: Figure = Figure {
    id: "time-by-renderers",
    title: "Update time by the number of renderers",
    x: || Axis::linear("renderers B"),
    y: || Axis::log("ns a vector"),
    is_of: |spec, usual| (spec.side, spec.vectors) == (usual.side, usual.vectors),
    at: |spec| f64::from(spec.renderers),
    of: PER_VECTOR,
};

const BY_SIDE: Figure = Figure {
    id: "time-by-side",
    title: "Update time by the side of regions",
    x: || Axis::linear("side of a region S, pixels"),
    y: || Axis::linear("ns a vector"),
    is_of: |spec, usual| (spec.renderers, spec.vectors) == (usual.renderers, usual.vectors),
    at: |spec| f64::from(spec.side),
    of: PER_VECTOR,
};

const BY_VECTORS: Figure = Figure {
    id: "time-by-vectors",
    title: "Time of a frame by the number of its vectors",
    x: || Axis::log("vectors V"),
    y: || Axis::log("ms a frame"),
    is_of: |spec, usual| (spec.renderers, spec.side) == (usual.renderers, usual.side),
    at: |spec| spec.vectors as f64,
    of: |_, time| time / 1e6,
};

struct Charts<'a> {
    plan: &'a Plan,
    times: &'a Times,
}

impl Charts<'_> {
    /// The runs of a figure with that ring, from left to right.
    fn runs(&self, figure: &Figure, ring: u32) -> Vec<&Run> {
        let usual = self.times.usual(ring).spec;
        let is_of = |run: &&Run| run.spec.ring == ring && (figure.is_of)(&run.spec, &usual);
        let mut runs: Vec<&Run> = self.times.runs.iter().filter(is_of).collect();
        runs.sort_by(|one, other| (figure.at)(&one.spec).total_cmp(&(figure.at)(&other.spec)));
        runs
    }

    /// The time of a vector with either ring.
    fn by_ring(&self) -> String {
        let [ample, real] = [Config::AMPLE_RING, Config::RING].map(|ring| {
            let run = self.times.usual(ring);
            short(run.per_vector(&run.model))
        });
        format!(
            "On {RENDERERS} renderers a vector takes {ample} ns with an ample ring, and {real} ns with {}.",
            ring_in_words()
        )
    }

    /// The side of regions with which vectors are fastest.
    fn best_side(&self) -> String {
        let runs = self.runs(&BY_SIDE, Config::AMPLE_RING);
        let time = |run: &Run| run.per_vector(&run.model);
        let best = runs.iter().min_by(|one, other| time(one).total_cmp(&time(other))).expect("there are runs");
        format!(
            "With an ample ring, regions of {} pixels a side are fastest: {} ns a vector.",
            best.spec.side,
            short(time(best))
        )
    }

    /// The fixed time of a frame.
    fn few_and_many(&self) -> String {
        let runs = self.runs(&BY_VECTORS, Config::AMPLE_RING);
        let of = |run: &Run| [run.spec.vectors as f64, run.model.drawn as f64 * PERIOD / 1e6].map(short);
        if let [only] = runs.as_slice() {
            let [vectors, time] = of(only);
            return format!("A frame of {vectors} vectors takes {time} ms.");
        }
        let [[few, least], [many, most]] = [runs[0], runs[runs.len() - 1]].map(of);
        format!("A frame has a fixed time: {few} vectors take {least} ms, and {many} take {most} ms.")
    }

    /// The waiting of the most renderers.
    fn starved(&self) -> String {
        let runs = self.runs(&BY_RENDERERS, Config::RING);
        let run = runs[runs.len() - 1];
        let (waiting, load) = (percent(run.model.starved), percent(run.model.load));
        format!("{} renderers wait {waiting} of their clocks, while the ring is loaded to {load}.", run.spec.renderers)
    }

    fn against(&self, figure: &Figure) -> Chart {
        let usual = self.times.usual(Config::AMPLE_RING).spec;
        let chart = Chart::new(figure.id, figure.title, (figure.x)(), (figure.y)()).note(format!(
            "{RENDERERS} renderers, regions of {side}x{side} and {} vectors of {} pixels at 45 degrees, unless stated otherwise.",
            usual.vectors,
            EXAMPLE.length / f64::from(self.plan.scale()),
            side = usual.side
        ));
        let paper = self.runs(figure, Config::AMPLE_RING);
        let paper = paper.into_iter().map(|run| self.point(figure, run, self.by_paper(&run.spec)));
        let chart = chart.series(Series::new(format!("N = {VECTOR_CYCLES}"), Origin::Formula, paper));
        let chart = self.with_ring(chart, figure, "ample", Config::AMPLE_RING);
        self.with_ring(chart, figure, &ring_in_words(), Config::RING)
    }

    fn with_ring(&self, chart: Chart, figure: &Figure, name: &str, ring: u32) -> Chart {
        let runs = self.runs(figure, ring);
        let took = |took: &Took| took.drawn as f64 * PERIOD;
        let formula = runs.iter().map(|run| self.point(figure, run, self.by_formula(run)));
        let model = runs.iter().map(|run| self.point(figure, run, took(&run.model)));
        let hardware = runs.iter().filter_map(|run| Some(self.point(figure, run, took(run.hardware.as_ref()?))));
        let chart = chart.series(Series::new(name, Origin::Formula, formula)).series(Series::new(
            name,
            self.times.model(),
            model,
        ));
        let hardware: Vec<_> = hardware.collect();
        if hardware.is_empty() { chart } else { chart.series(Series::new(name, self.times.rtl(), hardware)) }
    }

    fn point(&self, figure: &Figure, run: &Run, time: f64) -> (f64, f64) {
        ((figure.at)(&run.spec), (figure.of)(&run.spec, time))
    }

    /// The vectors' shape on the paper's screen.
    fn side(&self, spec: &Spec) -> u32 {
        spec.side * self.plan.scale()
    }

    /// The paper's time of a frame in ns.
    fn by_paper(&self, spec: &Spec) -> f64 {
        self.balanced(spec, VECTOR_CYCLES as f64, Shape::by_box)
    }

    /// N P_w T in perfect balance, or the time of the ring if that is longer. The ring has to bring all instructions and all planes but those of
    /// the last regions.
    fn by_formula(&self, run: &Run) -> f64 {
        let Spec { renderers, side, ring, .. } = run.spec;
        let Took { bits, planes, .. } = run.model;
        let regions = run.regions as f64;
        let before = planes as f64 * (1.0 - f64::from(renderers) / regions).max(0.0);
        let bits = bits as f64 - f64::from(side) * (planes as f64 - before);
        let drawing = self.balanced(&run.spec, run.cycles, Shape::tight);
        drawing.max(bits / f64::from(ring) * 1000.0).max(before * PERIOD)
    }

    fn balanced(&self, spec: &Spec, cycles: f64, regions: fn(&Shape, u32) -> f64) -> f64 {
        let load = least_load(regions(&EXAMPLE, self.side(spec)) * spec.vectors as f64, spec.renderers as usize);
        cycles * load * PERIOD
    }

    fn waiting(&self) -> Chart {
        let runs = self.runs(&BY_RENDERERS, Config::RING);
        let curve = |of: fn(&Took) -> f64| runs.iter().map(move |run| ((BY_RENDERERS.at)(&run.spec), of(&run.model)));
        Chart::new("waiting", "Renderers that wait, and the ring’s load", (BY_RENDERERS.x)(), Axis::linear("part"))
            .series(Series::new("waiting", self.times.model(), curve(|it| it.starved)))
            .series(Series::new("ring", self.times.model(), curve(|it| it.load)))
    }
}
