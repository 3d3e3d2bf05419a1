//! The page of all machines: the same scenes on each machine, and links to the machines' pages.

use super::effort::Effort;
use super::right;
use crate::compare::Comparison;
use crate::engine::EngineArguments;
use crate::machine::{ENTRANTS, Entrant, Figures, Run};
use crate::shell::Failure;
use crate::trace::TraceOptions;
use tilewright_report::{Cell, Link, Origin, Page, Picture, Provenance, Rule, Section, Statement, Table, Verdicts};
use tilewright_scenes::{Scene, Size};

/// The scenes: two of triangles, two of lines.
const SCENES: [&str; 4] = ["teapot", "ter1k", "wireframe", "star"];

/// The frames of a quick look.
const SMALL: [u32; 2] = [64, 48];

/// Renders the scenes on all machines, and makes the page.
///
/// # Errors
/// A machine cannot draw one; Ctrl-C.
pub fn page(effort: Effort, links: Vec<Link>) -> Result<Page, Failure> {
    let compared = SCENES.into_iter().map(|name| compared(name, effort, &ENTRANTS)).collect::<Result<Vec<_>, _>>()?;
    let provenance = Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("all", "--polygons"))
        .seeds([effort.seed]);
    let page = Page::new("Parallel rendering machines of the 1990s", provenance)
        .paragraph(
            "The hardware of each machine draws the same triangles and lines, simulated clock by clock. Each frame is compared with that of a plain software \
             rasterizer, in depth and in colour.",
        )
        .section(Section::new("Machines").links(links).paragraph(
            "Each page compares what a paper states about its machine with what is measured here.",
        ))
        .section(compared.iter().filter_map(picture).fold(Section::new("Frames"), |section, (claim, picture)| section.figure(claim, picture)))
        .section(table_section(&compared))
        .section(Section::new("Checks").part(Verdicts::new("checks", "Checks").states(checks(&compared))));
    Ok(page)
}

fn compared(name: &str, effort: Effort, entrants: &[Entrant]) -> Result<Comparison, Failure> {
    let scene = Scene::builtin(name).expect("a built-in scene");
    let size = if effort.is_quick() { Size::new(SMALL[0], SMALL[1])? } else { scene.size };
    let (engine, filters) = (EngineArguments::default(), TraceOptions::default());
    Comparison::of(&Scene { size, ..scene }, entrants, &Run::new(engine, &filters))
}

fn table_section(compared: &[Comparison]) -> Section {
    let columns = [
        "machine",
        "processors",
        "clocks",
        "MHz",
        "ms",
        "pixels tested",
        "pixels drawn",
        "at work, %",
        "limited by",
        "of the time, %",
    ];
    let section = Section::new("Each scene on each machine").paragraph(
        "“Tested” counts the pixels that processors test for some primitive, and “drawn” the pixels that it covers. “At work” is the mean share of the time in which the processors work; \
             for a pipe, that of its busiest part. What takes longest limits the machine.",
    );
    let section = compared.iter().fold(section, |section, it| {
        let table = Table::new(format!("{}-machines", it.scene()), it.scene(), columns);
        section.part(it.machines().fold(table, |table, (machine, _, figures)| table.row(cells(machine, figures))))
    });
    let section = compared.first().map(state).into_iter().fold(section, Section::part);
    let first = compared.first().into_iter().flat_map(|it| it.machines().map(|machine| (it.scene(), machine)));
    first.fold(section, |section, (scene, (machine, _, figures))| {
        section.paragraph(format!("The clocks of {scene} on {machine}: {}.", figures.time))
    })
}

/// The registers and memories of each machine, for the screen of a scene.
fn state(it: &Comparison) -> Table {
    let title = format!("Bits of each machine’s state, built for {}", it.scene());
    let table = Table::new("state", title, ["machine", "registers, bits", "memories, bits"]);
    let table = table.note("Counted over all instances of the circuit; only memories that are written count.");
    it.machines().fold(table, |table, (machine, _, figures)| {
        table.row([machine.into(), (figures.register_bits as f64).into(), (figures.memory_bits as f64).into()])
    })
}

fn cells(machine: &str, figures: &Figures) -> [Cell; 10] {
    [
        machine.into(),
        format!("{} {}", figures.processors, figures.processor).into(),
        (figures.clocks as f64).into(),
        figures.megahertz().round().into(),
        figures.milliseconds().into(),
        (figures.tested as f64).into(),
        (figures.drawn as f64).into(),
        (100.0 * figures.at_work).into(),
        figures.limit.as_str().into(),
        (100.0 * figures.limit_share).into(),
    ]
}

/// The frame that all machines have drawn, or a note that they differ.
fn picture(it: &Comparison) -> Option<(&'static str, Picture)> {
    let (name, frame) = (it.scene(), it.frame()?);
    let alt = format!("the scene {name}, {} pixels", frame.size());
    let differing = it.machines().map(|(_, differing, _)| differing).sum();
    let claim = match differing {
        0 => "All machines draw this frame, bit for bit.",
        _ => "The machines do not draw the same frame.",
    };
    let picture = Picture::new(format!("{name}-frame"), name, alt, frame.to_png());
    Some((claim, picture.note(right::in_words(differing))))
}

/// The checks that frames are right, and that machines count the same pixels.
fn checks(compared: &[Comparison]) -> [Statement; 2] {
    let each = || {
        compared.iter().flat_map(|it| {
            it.machines().map(move |(machine, differing, figures)| {
                (format!("{}, {machine}", it.scene()), differing, figures.drawn)
            })
        })
    };
    let spread = compared.iter().map(|it| {
        let drawn = || it.machines().map(|(.., figures)| figures.drawn);
        (it.scene().to_owned(), drawn().max().unwrap_or(0) as f64 - drawn().min().unwrap_or(0) as f64)
    });
    let same = Statement::new(
        "DES-MIN",
        "All machines draw the same number of pixels; a pixel counts once for each primitive that covers it.",
        Rule::Zero,
    );
    [
        right::statement("DES-MIN", each().map(|(name, differing, _)| (name, differing))),
        same.unit("pixels between the greatest and the least number").found(Origin::rtl([]), spread),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_frame_and_a_wrong_count_are_found() {
        let effort = Effort { seed: 1, most: Some(1) };
        let verdicts = |entrants: &[Entrant]| {
            let compared = [compared("star", effort, entrants).expect("it can be drawn")];
            checks(&compared).map(|check| check.verdict().to_string())
        };
        assert_eq!(verdicts(&ENTRANTS), ["holds", "holds"]);
        let broken = Entrant {
            draw: |scene, run| {
                let (mut frame, mut figures) = (ENTRANTS[1].draw)(scene, run)?;
                frame.words[7] ^= 1;
                figures.drawn += 5;
                Ok((frame, figures))
            },
            ..ENTRANTS[1]
        };
        let expected = ["differs by 1 from 0 (star, quadtree)", "differs by 5 from 0 (star)"];
        assert_eq!(verdicts(&[ENTRANTS[0], broken]), expected);
    }
}
