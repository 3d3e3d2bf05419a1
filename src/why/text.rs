//! The way of a pixel, as text and as JSON.

use super::hint;
use crate::block::entries;
use crate::shell::{Exit, Failure};
use serde_json::{Value, json};
use std::fmt::Write;
use tilewright_machines::{Primitive, Step, Way};
use tilewright_scenes::Size;
use tilewright_scenes::frame::{depth_of, rgb_of};

/// What is told of a pixel.
pub struct Told<'a> {
    pub scene: &'a str,
    pub machine: &'static str,
    pub size: Size,
    pub pixel: [u32; 2],
    /// The word in the frame; `None` if there is no frame.
    pub shown: Option<u64>,
    /// The word in the golden image.
    pub golden: u64,
    pub way: &'a Way,
}

impl Told<'_> {
    /// Whether the frame has the golden image's pixel.
    pub fn is_right(&self) -> bool {
        self.shown == Some(self.golden)
    }

    /// How the command ends, also if the run failed, as a check of the machine itself did.
    ///
    /// # Errors
    /// The run failed.
    pub fn end(&self, failed: Option<Failure>) -> Result<Exit, Failure> {
        match failed {
            Some(failure) => Err(failure.with(Exit::CheckFailed)),
            None if self.is_right() => Ok(Exit::Done),
            None => Ok(Exit::CheckFailed),
        }
    }
}

/// The pixel, the first difference, the primitives, and the steps.
pub fn text(told: &Told) -> String {
    let Told { scene, machine, size, pixel: [x, y], shown, golden, way } = told;
    let verdict = match shown {
        None => "the machine showed no frame",
        Some(_) if told.is_right() => "as in the golden image",
        Some(_) => "NOT as in the golden image",
    };
    let mut text = format!("pixel {x},{y} of {scene} on {machine}, {size} pixels: {verdict}\n");
    text += &difference(way);
    if let Some(shown) = shown {
        let _ = writeln!(text, "shown   {}", pixel(*shown));
    }
    let _ = writeln!(text, "golden  {}\n", pixel(*golden));
    match way.primitives.len() {
        0 => text += "no primitive covers the pixel\n",
        1 => text += "1 primitive covers the pixel:\n",
        count => {
            let _ = writeln!(text, "{count} primitives cover the pixel:");
        }
    }
    way.primitives.iter().for_each(|it| text += &format!("  {}\n", primitive(it)));
    text += "\n";
    text += &steps(way);
    text
}

/// A pixel of a frame.
fn pixel(word: u64) -> String {
    let [r, g, b] = rgb_of(word);
    format!("colour {r:02x}{g:02x}{b:02x}, depth {:06x}", depth_of(word))
}

fn primitive(it: &Primitive) -> String {
    let word = |word: Option<u64>| word.map_or("nothing".to_owned(), |word| format!("{word:012x}"));
    let Primitive { name, golden, hardware, wins, .. } = it;
    let drawn = match hardware == golden {
        true => word(*hardware),
        false => format!("{} (golden: {})", word(*hardware), word(*golden)),
    };
    format!("{name}: {drawn}{}", if *wins { ", visible" } else { "" })
}

/// The most steps of a kind, one after the other, that each have a line.
const MOST_ALIKE: usize = 20;

/// A line for each step, by time: the clock, what the unit does, and the values. Of many alike, a line says how many more
/// there are.
fn steps(way: &Way) -> String {
    let is_alike = |(a, _): &(&Step, String), (b, _): &(&Step, String)| {
        !a.differs() && !b.differs() && (a.primitive, a.block, &a.does) == (b.primitive, b.block, &b.does)
    };
    let lines: Vec<(&Step, String)> = way.steps.iter().zip(lines(way)).collect();
    let mut text = String::new();
    for run in lines.chunk_by(is_alike) {
        let [first @ .., (_, last)] = run else { continue };
        let left_out = if run.len() > MOST_ALIKE { first.len() - 2 } else { 0 };
        text.extend(first[..first.len() - left_out].iter().map(|(_, line)| line.as_str()));
        if left_out > 0 {
            let _ = writeln!(text, "  ... {left_out} more of this kind, as the model has them (--json shows all)");
        }
        text += last;
    }
    text
}

/// The line of each step.
fn lines(way: &Way) -> Vec<String> {
    let first = way.first_difference();
    let time = |step: &Step| format!("{:.3} us", step.time as f64 / 1e6);
    let clock = |step: &Step| format!("{} {}", step.clock, step.cycle);
    let longest = |of: &dyn Fn(&Step) -> String| way.steps.iter().map(|step| of(step).len()).max().unwrap_or(0);
    let [times, clocks] = [longest(&time), longest(&clock)];
    let line = |step: &Step| {
        let mark = match first {
            Some(first) if std::ptr::eq(first, step) => ">",
            _ if step.differs() => ".",
            _ => " ",
        };
        let values: Vec<String> = step.values.iter().map(value).collect();
        let of = step.primitive.and_then(|number| way.primitives.iter().find(|it| it.number == number));
        let of = of.filter(|_| way.primitives.len() > 1).map_or_else(String::new, |it| format!("{}: ", it.name));
        let (time, clock, values) = (time(step), clock(step), values.join(", "));
        format!("{mark} {time:>times$}  {clock:<clocks$}  {of}{} {}: {values}\n", step.unit, step.does)
    };
    way.steps.iter().map(line).collect()
}

/// A value, with the model's if that is another one.
fn value(it: &tilewright_machines::Compared) -> String {
    match &it.golden {
        Some(golden) if it.differs() => format!("{} {} (model: {golden})", it.what, it.hardware),
        _ => format!("{} {}", it.what, it.hardware),
    }
}

/// The sentence on the first difference, and the command that asks on.
fn difference(way: &Way) -> String {
    let Some(step) = way.first_difference() else {
        return "no step differs from its model\n".to_owned();
    };
    let source = source(step.block).map(|file| format!(" ({file})")).unwrap_or_default();
    let differs = step.values.iter().find(|value| value.differs());
    let values = differs.map_or_else(String::new, |it| {
        format!(": {} is {}, and the model has {}", it.what, it.hardware, it.golden.as_deref().unwrap_or_default())
    });
    let next = hint::command(step).map_or_else(String::new, |command| format!("next: {command}\n"));
    format!("the first difference is in {}{source}: {} {}{values}\n{next}", step.block, step.unit, step.does)
}

/// The file that describes a block of the catalogue with its usual parameters.
fn source(block: &str) -> Option<&'static str> {
    let entry = entries().find(|entry| entry.name == block)?;
    let design = entry.design(&entry.values([]).ok()?).ok()?;
    Some(design.top().loc.file())
}

/// The same as JSON, with the commands that open its waveform.
pub fn json(told: &Told, commands: &[String]) -> Value {
    let Told { scene, machine, size, pixel, shown, golden, way } = told;
    let hex = |word: u64| format!("{word:012x}");
    let primitive = |it: &Primitive| {
        let Primitive { number, name, golden, hardware, wins } = it;
        json!({ "number": number, "name": name, "golden": golden.map(hex), "hardware": hardware.map(hex), "visible": wins })
    };
    let value = |it: &tilewright_machines::Compared| json!({ "what": it.what, "hardware": it.hardware, "model": it.golden, "differs": it.differs() });
    let step = |it: &Step| {
        json!({
            "primitive": it.primitive,
            "unit": it.unit,
            "block": it.block,
            "does": it.does,
            "clock": it.clock,
            "cycle": it.cycle,
            "picoseconds": it.time,
            "net": it.net,
            "values": it.values.iter().map(value).collect::<Vec<_>>(),
            "differs": it.differs(),
            "simulation": it.apart.as_ref().map(|apart| json!({ "unit": apart.unit, "picoseconds": apart.time })),
        })
    };
    let first = way.first_difference().and_then(|first| way.steps.iter().position(|it| std::ptr::eq(it, first)));
    let difference = first.map(|number| {
        let step = &way.steps[number];
        json!({ "step": number, "block": step.block, "source": source(step.block), "next": hint::command(step) })
    });
    json!({
        "format": 1,
        "scene": scene,
        "machine": machine,
        "width": size.width(),
        "height": size.height(),
        "pixel": pixel,
        "shown": shown.map(hex),
        "golden": hex(*golden),
        "identical": told.is_right(),
        "primitives": way.primitives.iter().map(primitive).collect::<Vec<_>>(),
        "steps": way.steps.iter().map(step).collect::<Vec<_>>(),
        "first_difference": difference,
        "commands": commands,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_machines::Compared;

    /// A merging unit that passes the farther pixel, and the frame buffer that stores it.
    fn wrong() -> Way {
        let step = |time: u64, block: &'static str, hardware: &str, golden: &str| Step {
            primitive: Some(4),
            unit: format!("unit of {block}"),
            block,
            does: "passes a pixel".to_owned(),
            clock: "merge".to_owned(),
            cycle: time / 80_000,
            time,
            net: Some(format!("u_{block}.nearer")),
            values: vec![Compared { what: "word", hardware: hardware.to_owned(), golden: Some(golden.to_owned()) }],
            apart: None,
        };
        let steps = vec![
            step(160_000, "image-memory", "5", "5"),
            step(240_000, "merging-unit", "9", "5"),
            step(320_000, "gfb-unit", "9", "5"),
        ];
        let primitive = |number: usize, word, wins| Primitive {
            number,
            name: format!("triangle {number}"),
            golden: Some(word),
            hardware: Some(word),
            wins,
        };
        Way { primitives: vec![primitive(4, 5, true), primitive(7, 9, false)], steps }
    }

    fn told(way: &Way, shown: Option<u64>) -> Told<'_> {
        let size = Size::new(16, 12).expect("in range");
        Told { scene: "star", machine: "vc1", size, pixel: [3, 2], shown, golden: 5, way }
    }

    #[test]
    fn the_first_difference_is_marked_and_its_block_and_source_are_named() {
        let text = text(&told(&wrong(), Some(9)));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "pixel 3,2 of star on vc1, 16x12 pixels: NOT as in the golden image");
        assert!(lines.contains(&"  triangle 4: 000000000005, visible"), "{text}");
        let marks: Vec<&str> = lines.iter().filter(|line| line.contains(" us ")).map(|line| &line[..2]).collect();
        assert_eq!(marks, ["  ", "> ", ". "], "{text}");
        let sentence = "the first difference is in merging-unit (rtl/src/merger/unit.rs): unit of merging-unit passes a pixel: \
                        word is 9, and the model has 5";
        assert_eq!(lines[1], sentence);
        assert!(lines[2].starts_with("next: tilewright why merging-unit --signal nearer --at "), "{text}");
        let json = json(&told(&wrong(), Some(9)), &[]);
        assert_eq!((&json["identical"], &json["first_difference"]["step"]), (&false.into(), &1.into()));
        assert_eq!(json["first_difference"]["source"], "rtl/src/merger/unit.rs");
    }

    #[test]
    fn of_many_steps_alike_the_first_two_and_the_last_are_shown() {
        let times = |count: u64| -> Vec<String> {
            let mut way = wrong();
            let alike = |number| Step { time: number * 1_000_000, ..way.steps[0].clone() };
            let many: Vec<Step> = (1..=count).map(alike).collect();
            way.steps.splice(0..1, many);
            let text = text(&told(&way, Some(9)));
            let lines = text.lines().filter(|line| line.contains(" us ") || line.contains("more of this kind"));
            lines.map(|line| line.split(" us ").next().unwrap_or_default().trim().to_owned()).collect()
        };
        assert_eq!(times(20).len(), 22);
        let left_out = "... 18 more of this kind, as the model has them (--json shows all)";
        assert_eq!(times(21), ["1.000", "2.000", left_out, "21.000", ">  0.240", ".  0.320"]);
    }

    #[test]
    fn a_pixel_that_differs_and_a_check_that_fails_have_exit_code_1() {
        let way = Way::default();
        assert_eq!(told(&way, Some(5)).end(None).unwrap(), Exit::Done);
        assert_eq!(told(&way, Some(9)).end(None).unwrap(), Exit::CheckFailed);
        let failed = Failure::new(Exit::BadInput, "internal error");
        assert_eq!(told(&way, None).end(Some(failed)).unwrap_err().exit, Exit::CheckFailed);
        assert!(
            text(&told(&way, None)).starts_with("pixel 3,2 of star on vc1, 16x12 pixels: the machine showed no frame")
        );
    }
}
