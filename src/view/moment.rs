//! The block at a step of a pixel's way: its units, and the values of their nets around that clock.

use super::nets::Net;
use super::recorded::{Recorded, Shown, drawn, module_at, source, written};
use crate::block::entries;
use crate::engine::EngineArguments;
use crate::machine::{Machine, Run, Viewed, Visitor, signals_of, times_around, unit_and_name, visit};
use crate::shell::output::Waveform;
use crate::shell::{Exit, Failure, progress};
use crate::trace::TraceOptions;
use serde_json::{Value, json};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use tilewright_hdl::Design;
use tilewright_machines::Step;
use tilewright_scenes::Scene;

/// The block of a step.
pub enum Moment {
    /// The machine's own unit, in a waveform around the step.
    Recorded { step: Step, unit: Vec<String>, recorded: Box<Recorded> },
    /// The block alone.
    Alone(Value),
}

/// The block at that step of a scene on a machine. Where the machine is simulated as a whole it draws again, and stops soon after `cancel`
/// becomes true.
///
/// # Errors
/// The machine cannot draw the scene, or it was stopped.
pub fn moment(scene: &Scene, machine: Machine, step: &Step, cancel: &AtomicBool) -> Result<Moment, Failure> {
    visit(scene, machine, Asked { machine, step, cancel })
}

struct Asked<'a> {
    machine: Machine,
    step: &'a Step,
    cancel: &'a AtomicBool,
}

impl Visitor for Asked<'_> {
    type Output = Moment;

    fn visit(self, job: &impl Viewed) -> Result<Moment, Failure> {
        let Asked { machine, step, cancel } = self;
        let machine = machine.name();
        let Some(design) = job.design()? else {
            let why = format!("each unit of {machine} is simulated separately, so there is no wave of it in a frame");
            return alone(step, &why);
        };
        let Some((unit, name)) = unit_and_name(step) else {
            return alone(step, "this step is about no net, so there is no wave of it");
        };
        let Some(module) = module_at(&design, &unit) else {
            return alone(step, "the circuit has no such unit, so there is no wave of it");
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
            // A run that fails as the first one did has its waveform.
            match job.render(&run).map(|_| ()) {
                Err(failure) if failure.exit != Exit::CheckFailed => Err(failure),
                _ => Ok(()),
            }
        })?;
        let recorded = Box::new(Recorded::new(design, vcd, &unit));
        Ok(Moment::Recorded { step: step.clone(), unit, recorded })
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
                // What the unit saw at the edge of the step stands before it.
                let before = shown.times.iter().rposition(|time| *time < step.time).unwrap_or(0);
                shown.step = Some(before);
                if recorded.has_one_clock(number) && shown.times.get(before + 1) == Some(&step.time) {
                    shown.first = step.cycle.saturating_sub(before as u64 + 1);
                }
                let name = unit_and_name(step).map(|(_, name)| name).filter(|_| number == 0);
                shown.nets.iter_mut().for_each(|net| net.asked = Some(net.name.as_str()) == name);
                Ok(Some(json!({ "note": null, "path": unit.join("."), "unit": shown })))
            }
        }
    }
}
