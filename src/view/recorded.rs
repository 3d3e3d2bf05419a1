//! A circuit and a waveform of it: its units, each with its diagram and the values of its nets.

use super::nets::{Net, scope, scopes, values};
use crate::shell::{Exit, Failure};
use serde::Serialize;
use std::fs::File;
use std::io::{self, Read, Seek};
use tilewright_gen::{Diagram, DiagramOptions, diagram};
use tilewright_hdl::Design;
use tilewright_hdl::ir::Module;
use tilewright_scenes::SceneError;
use vcd::{Header, Parser};

/// The most units that a page can open: a circuit with more has these first.
const MOST_UNITS: usize = 4096;

/// A circuit and a waveform of it.
pub struct Recorded {
    design: Design,
    vcd: Vec<u8>,
    /// The units of the waveform, each before those inside it; the first is the outermost.
    units: Vec<Unit>,
}

/// A unit: the top, an instance, or one lane of an array.
struct Unit {
    /// The instances below the top that lead to it.
    path: Vec<String>,
    /// The number of its module in the design.
    module: usize,
}

/// A unit as the page links it.
#[derive(Serialize)]
pub struct Link {
    pub name: String,
    pub number: usize,
}

/// What the page shows of a unit.
#[derive(Serialize)]
pub struct Shown {
    pub name: String,
    /// What it is.
    pub summary: String,
    /// Where it is described: `FILE:LINE`.
    pub source: String,
    pub diagram: String,
    /// The diagram for a narrow window.
    pub narrow: String,
    /// The times in picoseconds: the beginning, and each rising edge of a clock of the unit.
    pub times: Vec<u64>,
    /// The number of the first time, as its clock counts.
    pub first: u64,
    /// The place of the time that is shown first, unless that is the beginning.
    pub step: Option<usize>,
    pub nets: Vec<Net>,
    /// The units inside of it.
    pub units: Vec<Link>,
    /// Those around it, the outermost first.
    pub outer: Vec<Link>,
    /// Those of the same array, itself included.
    pub siblings: Vec<Link>,
}

impl Recorded {
    /// A waveform of a circuit, as the simulation writes it, from that unit on: a path of instances below the top.
    pub fn new(design: Design, vcd: Vec<u8>, from: &[String]) -> Recorded {
        let header = Parser::new(&*vcd).parse_header().expect("the simulation writes sound headers");
        let units = units(&design, &header, from);
        Recorded { design, vcd, units }
    }

    /// How many units there are.
    pub fn count(&self) -> usize {
        self.units.len()
    }

    /// Whether all of a unit has one clock.
    pub fn has_one_clock(&self, number: usize) -> bool {
        self.design.modules()[self.units[number].module].clocks.len() == 1
    }

    /// What the page shows of the unit of that number; `None` if there is none.
    ///
    /// # Errors
    /// Its diagram cannot be drawn.
    pub fn unit(&self, number: usize) -> Result<Option<Shown>, Failure> {
        let Some(unit) = self.units.get(number) else { return Ok(None) };
        let module = &self.design.modules()[unit.module];
        let (times, nets) = values(&self.vcd, &unit.path, module);
        let drawn = drawn(&self.design, unit.module)?;
        let depth = unit.path.len();
        let is_inside = |it: &Unit| it.path.len() == depth + 1 && it.path.starts_with(&unit.path);
        let is_around = |it: &Unit| it.path.len() < depth && unit.path.starts_with(&it.path);
        let array = |it: &Unit| it.path.last().and_then(|name| name.split_once('[')).map(|(name, _)| name.to_owned());
        let is_beside = |it: &Unit| {
            it.path.len() == depth && array(it).is_some() && array(it) == array(unit) && parent(it) == parent(unit)
        };
        Ok(Some(Shown {
            name: self.name(unit),
            summary: module.about.summary.to_string(),
            source: source(module),
            diagram: drawn.svg(),
            narrow: drawn.narrow_svg(),
            times,
            first: 0,
            step: None,
            nets,
            units: self.links(is_inside),
            outer: self.links(is_around),
            siblings: self.links(is_beside),
        }))
    }

    fn links(&self, which: impl Fn(&Unit) -> bool) -> Vec<Link> {
        let chosen = self.units.iter().enumerate().filter(|(_, unit)| which(unit));
        chosen.map(|(number, unit)| Link { name: self.name(unit), number }).collect()
    }

    fn name(&self, unit: &Unit) -> String {
        unit.path.last().unwrap_or(&self.design.top().name).clone()
    }
}

fn parent(unit: &Unit) -> Option<&[String]> {
    unit.path.split_last().map(|(_, outer)| outer)
}

/// Where a module is described.
pub fn source(module: &Module) -> String {
    format!("{}:{}", module.loc.file(), module.loc.line())
}

/// The diagram of a module of a design.
///
/// # Errors
/// It cannot be drawn.
pub fn drawn(design: &Design, module: usize) -> Result<Diagram, Failure> {
    let mut modules = design.modules()[..=module].to_vec();
    // Inside of a design a clock has the period of the clock that drives it. A diagram shows none.
    let any = design.top().clocks.iter().find_map(|clock| clock.period);
    for clock in modules.iter_mut().next_back().into_iter().flat_map(|top| &mut top.clocks) {
        clock.period = clock.period.or(any);
    }
    let part = Design::new(modules).map_err(|problems| Failure::new(Exit::Crash, problems.to_string()))?;
    Ok(diagram(&part, &DiagramOptions::default())?)
}

/// The module of a path of instances below the top.
pub fn module_at(design: &Design, path: &[String]) -> Option<usize> {
    path.iter().try_fold(design.modules().len() - 1, |module, name| {
        let name = name.split('[').next().unwrap_or(name);
        let instance = design.modules()[module].instances.iter().find(|it| it.name == name)?;
        Some(instance.module.0 as usize)
    })
}

/// The units of a waveform from a path on, level by level.
fn units(design: &Design, header: &Header, from: &[String]) -> Vec<Unit> {
    let unit = |path: Vec<String>| Some(Unit { module: module_at(design, &path)?, path });
    let mut units: Vec<Unit> = unit(from.to_vec()).into_iter().collect();
    let mut next = 0;
    while next < units.len() && units.len() < MOST_UNITS {
        let path = units[next].path.clone();
        let inner = scope(header, &path).into_iter().flat_map(|scope| scopes(&scope.items));
        units.extend(inner.filter_map(|it| unit([path.as_slice(), std::slice::from_ref(&it.identifier)].concat())));
        next += 1;
    }
    units
}

/// What a run writes to a temporary file.
///
/// # Errors
/// Those of the run, and of the file.
pub fn written(run: impl FnOnce(File) -> Result<(), Failure>) -> Result<Vec<u8>, Failure> {
    let unwritable = |error: io::Error| Failure::from(SceneError::unwritable(&std::env::temp_dir(), &error));
    let mut file = tempfile::tempfile().map_err(unwritable)?;
    run(file.try_clone().map_err(unwritable)?)?;
    let mut bytes = Vec::new();
    file.rewind().and_then(|()| file.read_to_end(&mut bytes)).map_err(unwritable)?;
    Ok(bytes)
}
