//! The raster processor: its form, and its units (MPG-RP).
//!
//! ```text
//! works ===>[ stack, pipe or tree of some levels ]===>[ another ]===> .. ===> parts
//! ```
//!
//! The paper's general mix is a set-up unit, s stacks, a pipeline of p stages and a quadtree of t levels. Here parts of
//! any of the three forms follow one another, and share the levels. The set-up is a block of its own.

use std::fmt;

use super::coverage_test::Test;
use super::divider::{DividerIn, DividerOut};
use super::format::Format;
use super::pipe::Pipe;
use super::stack::Stack;
use super::tree::Tree;
use crate::prelude::*;

/// A part of a raster processor, with the levels that it divides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// One unit and a stack.
    Stack(u32),
    /// A unit for each level.
    Pipe(u32),
    /// The quarters of a window side by side: 1, 5, 21 or 85 units for 1 to [`Part::MOST_TREE_LEVELS`] levels.
    Tree(u32),
}

impl Part {
    /// The greatest number of levels of a tree.
    pub const MOST_TREE_LEVELS: u32 = 4;

    /// The number of levels that the part divides.
    pub fn levels(self) -> u32 {
        match self {
            Part::Stack(levels) | Part::Pipe(levels) | Part::Tree(levels) => levels,
        }
    }

    /// The same form with that number of levels.
    fn with_levels(self, levels: u32) -> Part {
        match self {
            Part::Stack(_) => Part::Stack(levels),
            Part::Pipe(_) => Part::Pipe(levels),
            Part::Tree(_) => Part::Tree(levels),
        }
    }

    fn word(self) -> &'static str {
        match self {
            Part::Stack(_) => "stack",
            Part::Pipe(_) => "pipe",
            Part::Tree(_) => "tree",
        }
    }
}

/// The parts of a raster processor, in the sequence in which a window passes them. As text: `stack:2+pipe:4+tree:1`, or
/// `pipe` alone for all levels.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Form(Vec<Part>);

impl Form {
    /// The form with those parts, for a generator with that format.
    ///
    /// # Errors
    ///
    /// The parts do not divide the format's number of levels; or one divides none; or a tree divides more than 4.
    pub fn new(parts: Vec<Part>, format: &Format) -> Result<Form, ParameterError> {
        let form = Form(parts);
        let levels: u32 = form.0.iter().map(|part| part.levels()).sum();
        let problem = if levels != format.levels() {
            let Screen { width, height } = format.screen();
            let (p, q) = (format.matrix().columns(), format.matrix().rows());
            let has = format.levels();
            format!("it divides {levels} levels; {width}x{height} pixels on a matrix of {p}x{q} have {has}")
        } else if form.0.iter().any(|part| part.levels() == 0) {
            "each part has to divide at least one level".to_owned()
        } else if form.0.iter().any(|part| matches!(part, Part::Tree(levels) if *levels > Part::MOST_TREE_LEVELS)) {
            format!("a tree divides at most {} levels, with 85 units", Part::MOST_TREE_LEVELS)
        } else {
            return Ok(form);
        };
        Err(ParameterError(format!("the form `{form}`: {problem}")))
    }

    /// The parts of the form.
    pub fn parts(&self) -> &[Part] {
        &self.0
    }
}

impl Form {
    /// Reads a form from text: `stack`, `pipe:3+tree:1` or `stack:2+pipe`. One part may leave out its levels, and gets
    /// the remaining ones.
    ///
    /// # Errors
    ///
    /// The text is not a form, or as in [`Form::new`].
    pub fn parse(text: &str, format: &Format) -> Result<Form, ParameterError> {
        let problem = |problem: &str| {
            let help =
                "a form is made of `stack`, `pipe` and `tree`, each with its levels, as in `stack:2+pipe:3+tree:1`";
            ParameterError(format!("the form `{text}`: {problem}; {help}"))
        };
        let mut parts = Vec::new();
        let mut open = None;
        for word in text.split('+') {
            let (word, levels) = word.split_once(':').map_or((word, None), |(word, levels)| (word, Some(levels)));
            let levels = match levels.map(str::parse) {
                Some(Ok(levels)) if levels <= format.levels() => levels,
                Some(_) => return Err(problem(&format!("levels are a number from 1 to {}", format.levels()))),
                None if open.replace(parts.len()).is_some() => {
                    return Err(problem("only one part may leave out its levels"));
                }
                None => 0,
            };
            parts.push(match word {
                "stack" => Part::Stack(levels),
                "pipe" => Part::Pipe(levels),
                "tree" => Part::Tree(levels),
                _ => return Err(problem(&format!("there is no part `{word}`"))),
            });
        }
        if let Some(open) = open {
            let given: u32 = parts.iter().map(|part| part.levels()).sum();
            parts[open] = parts[open].with_levels(format.levels().saturating_sub(given));
        }
        Form::new(parts, format)
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, part) in self.0.iter().enumerate() {
            let plus = if number > 0 { "+" } else { "" };
            write!(f, "{plus}{}:{}", part.word(), part.levels())?;
        }
        Ok(())
    }
}

/// The form as text, for the names of its modules.
impl fmt::Debug for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> = self.0.iter().map(|part| format!("{}{}", part.word(), part.levels())).collect();
        write!(f, "{:?}", words.join("_"))
    }
}

block! {
    /// Finds the pixels of a polygon: divides the window of all samples down to single samples.
    pub struct RasterProcessor {
        /// The generator's format.
        pub format: Format,
        /// The form of the raster processor.
        pub form: Form,
        /// How the edges are tested.
        pub test: Test,
        /// The capacity of the queue before each unit of a pipe or tree, in windows.
        pub queue: u32,
    }
    latency = "the clocks of the windows that the polygon covers, in the slowest part";
    source = "sparse-raster quadtree generator, figure 1 (MPG-RP)";
    in(self) = DividerIn::widths(self.format);
    out(self) = DividerOut::widths(self.format, self.format.levels());
}

impl RasterProcessor {
    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        let RasterProcessor { format, test, queue, .. } = *self;
        let (mut works, mut from) = (i.works, format.levels());
        let (mut idle, mut tally) = (lit(1, 1), Vec::new());
        for (number, &part) in self.form.parts().iter().enumerate() {
            let (name, i) = (format!("u_{}{number}", part.word()), DividerIn { works });
            let divided = match part {
                Part::Stack(levels) => m.instance(&name, &Stack { format, test, from, levels }, i),
                Part::Pipe(levels) => m.instance(&name, &Pipe { format, test, from, levels, queue }, i),
                Part::Tree(levels) => m.instance(&name, &Tree { format, test, from, levels, queue }, i),
            };
            works = divided.parts;
            idle &= divided.idle;
            tally.extend(divided.tally);
            from -= part.levels();
        }
        DividerOut { parts: works, idle, tally }
    }
}

#[cfg(test)]
mod tests;
