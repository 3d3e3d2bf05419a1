//! The block at a step of a pixel's way: its units, and the values of their nets around that clock.

use super::nets::Net;
use super::recorded::{Recorded, Shown, drawn, module_at, source, written};
use crate::block::entries;
use crate::engine::EngineArguments;
use crate::machine::{
    Job, Machine, Run, Viewed, Visitor, render_traced, signals_of, times_around, unit_and_name, visit,
};
use crate::shell::output::Waveform;
use crate::shell::{Exit, Failure, progress};
use crate::trace::TraceOptions;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use tilewright_hdl::Design;
use tilewright_machines::{Apart, Step, Tracer};
use tilewright_scenes::Scene;

/// The most lanes of a net of a unit that is simulated by itself: an array of pixels has tens of thousands, and a page does not list them.
const MOST_LANES: usize = 64;

const NO_UNIT: &str = "the circuit has no such unit, so there is no wave of it";

/// The block of a step.
pub enum Moment {
    /// The machine's own unit, in a waveform around the step of a pixel.
    Recorded { step: Step, unit: Vec<String>, recorded: Box<Recorded> },
    /// The block alone.
    Alone(Value),
}

/// The block at that step of a pixel's way through a machine. The machine draws again, and stops soon after `cancel` becomes true.
///
/// # Errors
/// The machine cannot draw the scene, or it was stopped.
pub fn moment(
    scene: &Scene,
    machine: Machine,
    (pixel, step): ([u32; 2], &Step),
    cancel: &AtomicBool,
) -> Result<Moment, Failure> {
    visit(scene, machine, Asked { pixel, step, cancel })
}

struct Asked<'a> {
    pixel: [u32; 2],
    step: &'a Step,
    cancel: &'a AtomicBool,
}

impl Visitor for Asked<'_> {
    type Output = Moment;

    fn visit(self, job: &impl Viewed) -> Result<Moment, Failure> {
        let Asked { step, cancel, .. } = self;
        if let Some(apart) = &step.apart {
            return self.recorded_apart(job, apart);
        }
        let Some(design) = job.design()? else {
            return alone(step, "no unit is simulated for this step, so there is no wave of it");
        };
        let Some((unit, name)) = unit_and_name(step) else {
            return alone(step, "this step is about no net, so there is no wave of it");
        };
        let Some(module) = module_at(&design, &unit) else {
            return alone(step, NO_UNIT);
        };
        let filters = filters(&design, module, (&unit, name), times_around(step));
        progress::phase("building");
        let vcd = written(|file| {
            let waveform = Waveform::temporary(file);
            let run = Run {
                waveform: Some(&waveform),
                cancel: Some(cancel),
                ..Run::new(EngineArguments::default(), &filters)
            };
            ended(job.render(&run))
        })?;
        Ok(self.recorded(design, vcd, unit))
    }
}

impl Asked<'_> {
    /// The unit of a machine that simulates its units one by one.
    fn recorded_apart(&self, job: &impl Job, apart: &Apart) -> Result<Moment, Failure> {
        let unit = unit_and_name(self.step).map(|(unit, _)| unit).unwrap_or_default();
        let filters = TraceOptions::of(vec![signals_of(&unit)], times_around(self.step));
        progress::phase("building");
        let mut design = None;
        let vcd = written(|file| {
            let tracer = Tracer::new(apart, filters.trace(&Waveform::temporary(file))?);
            ended(render_traced(job, &tracer, self.pixel, Some(self.cancel)))?;
            design = tracer.take_design();
            Ok(())
        })?;
        match design.filter(|design| module_at(design, &unit).is_some()) {
            Some(design) => Ok(self.recorded(design, vcd, unit)),
            None => alone(self.step, NO_UNIT),
        }
    }

    fn recorded(&self, design: Design, vcd: Vec<u8>, unit: Vec<String>) -> Moment {
        let recorded = Box::new(Recorded::new(design, vcd, &unit));
        Moment::Recorded { step: self.step.clone(), unit, recorded }
    }
}

/// A run that fails as the first one did has its waveform.
fn ended<T>(rendered: Result<T, Failure>) -> Result<(), Failure> {
    match rendered {
        Err(failure) if failure.exit != Exit::CheckFailed => Err(failure),
        _ => Ok(()),
    }
}

/// The signals of a unit, and the word of its memory that the step is about.
fn filters(design: &Design, module: usize, (unit, name): (&[String], &str), times: Range<u64>) -> TraceOptions {
    let filters = TraceOptions::of(vec![signals_of(unit)], times);
    let word = name.strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    let memories = &design.modules()[module].memories;
    match word.and_then(|(memory, address)| Some((memory, address.parse().ok()?))) {
        Some((memory, address)) if memories.iter().any(|it| it.name == memory) => {
            let path = unit.iter().map(String::as_str).chain([memory]).collect::<Vec<_>>().join(".");
            filters.with_word(&path, address)
        }
        _ => filters,
    }
}

/// The block of a step as the catalogue has it, with the value of the step's net.
fn alone(step: &Step, why: &str) -> Result<Moment, Failure> {
    let found = entries().find(|entry| entry.name == step.block);
    let design = found.map(|entry| entry.values([]).and_then(|values| entry.design(&values))).transpose()?;
    let Some(design) = design else {
        return Ok(Moment::Alone(json!({ "note": why, "unit": null })));
    };
    let (top, name) = (design.top(), unit_and_name(step).map(|(_, name)| name));
    let mut diagram = drawn(&design, design.modules().len() - 1)?;
    diagram.title = top.name.clone();
    let value = |name: &str| {
        let of_net = step.values.iter().find(|value| value.what == name);
        of_net.or(step.values.first().filter(|_| step.values.len() == 1)).map(|value| value.hardware.clone())
    };
    let net = |name: &str| Net {
        changes: value(name).map(|value| (0, value)).into_iter().collect(),
        asked: true,
        ..Net::described(top, name)
    };
    let shown = Shown {
        name: step.block.to_owned(),
        summary: top.about.summary.to_string(),
        source: source(top),
        diagram: diagram.svg(),
        narrow: diagram.narrow_svg(),
        times: vec![step.time],
        nets: name.map(net).into_iter().collect(),
        first: step.cycle,
        step: Some(0),
        units: Vec::new(),
        outer: Vec::new(),
        siblings: Vec::new(),
    };
    Ok(Moment::Alone(json!({ "note": why, "unit": shown })))
}

impl Moment {
    /// The data of the unit of that number; `None` if there is none.
    ///
    /// # Errors
    /// Its diagram cannot be drawn.
    pub fn unit(&self, number: usize) -> Result<Option<Value>, Failure> {
        match self {
            Moment::Alone(value) => Ok((number == 0).then(|| value.clone())),
            Moment::Recorded { step, unit, recorded } => {
                let Some(mut shown) = recorded.unit(number)? else { return Ok(None) };
                let edge = step.apart.as_ref().map_or(step.time, |apart| apart.time);
                // What the unit saw at the edge of the step stands before it.
                let before = shown.times.iter().rposition(|time| *time < edge).unwrap_or(0);
                shown.step = Some(before);
                if recorded.has_one_clock(number) && shown.times.get(before + 1) == Some(&edge) {
                    let cycle = if step.apart.is_some() { own_cycle(&shown.times, edge) } else { step.cycle };
                    shown.first = cycle.saturating_sub(before as u64 + 1);
                }
                let name = unit_and_name(step).map(|(_, name)| name).filter(|_| number == 0);
                shown.nets.iter_mut().for_each(|net| net.asked = Some(net.name.as_str()) == name);
                let note = step.apart.as_ref().map(|apart| {
                    let note = of_itself(apart);
                    match keep_first_lanes(&mut shown.nets) {
                        true => format!("{note}. Each net has its first {MOST_LANES} lanes here"),
                        false => note,
                    }
                });
                let path = unit.join(".");
                Ok(Some(json!({ "note": note, "path": path, "unit": shown })))
            }
        }
    }
}

/// Leaves out lanes of each net beyond the first [`MOST_LANES`], but not one that is asked about. Returns whether there were any.
fn keep_first_lanes(nets: &mut Vec<Net>) -> bool {
    let (all, mut lanes) = (nets.len(), BTreeMap::<String, usize>::new());
    nets.retain(|net| {
        let Some((name, _)) = net.name.split_once('[') else { return true };
        let count = lanes.entry(name.to_owned()).or_default();
        *count += 1;
        *count <= MOST_LANES || net.asked
    });
    nets.len() < all
}

/// The clock of an edge as a unit that is simulated by itself counts it: from the begin of its simulation.
fn own_cycle(times: &[u64], edge: u64) -> u64 {
    // The first time is the begin of the waveform, and not an edge.
    times.get(1..).and_then(|edges| edges.windows(2).next()).map_or(0, |edges| edge / (edges[1] - edges[0]))
}

/// Says whose clocks those of such a unit are.
fn of_itself(Apart { unit, time }: &Apart) -> String {
    format!("{unit} is simulated by itself: these clocks are of its own time, which has the step at {time} ps")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_lanes_and_the_asked_one_are_kept() {
        let net = |name: String| Net {
            asked: name == "word[99]",
            name,
            width: 1,
            source: None,
            port: false,
            changes: Vec::new(),
        };
        let mut nets: Vec<Net> =
            (0..100).map(|lane| net(format!("word[{lane}]"))).chain([net("sum".to_owned())]).collect();
        assert!(keep_first_lanes(&mut nets));
        let names: Vec<&str> = nets.iter().map(|net| net.name.as_str()).collect();
        assert_eq!((names.len(), &names[63..]), (66, &["word[63]", "word[99]", "sum"][..]));
        assert!(!keep_first_lanes(&mut nets[..64].iter().map(|it| net(it.name.clone())).collect()));
    }
}
