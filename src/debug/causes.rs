//! The causes of a value as a list that can be walked.

use super::nets::Net;
use tilewright_sim::Cause;

/// The causes, and the one that is selected.
#[derive(Debug)]
pub struct Causes {
    pub lines: Vec<Line>,
    pub selected: usize,
}

/// A cause, which stands below what it decided.
#[derive(Debug)]
pub struct Line {
    /// The steps back from the value in question.
    pub depth: usize,
    pub text: String,
    /// The net, by number; `None` for a word of a memory, and for what is not listed.
    pub net: Option<usize>,
    /// The name, with an address behind a memory.
    pub name: String,
    /// The time from which on it has the value, in picoseconds.
    pub time: u64,
}

impl Causes {
    /// Those of a tree.
    pub fn of(root: &Cause, nets: &[Net]) -> Causes {
        let mut lines = Vec::new();
        add(&mut lines, root, 0, nets);
        Causes { lines, selected: 0 }
    }

    pub fn line(&self) -> &Line {
        &self.lines[self.selected]
    }
}

fn add(lines: &mut Vec<Line>, cause: &Cause, depth: usize, nets: &[Net]) {
    let role = match (depth, cause.chooses) {
        (0, _) => "",
        (_, true) => "when ",
        (_, false) => "from ",
    };
    let clock = cause.clock.as_ref().map(|clock| format!(" of {clock}")).unwrap_or_default();
    let end = cause.end.map(|end| format!("  {end}")).unwrap_or_default();
    let text = format!("{role}{} = {}  cycle {}{clock}{end}", cause.label(), cause.number(), cause.cycle);
    let net = nets.iter().position(|net| net.name == cause.name);
    lines.push(Line { depth, text, net, name: cause.name.clone(), time: cause.time });
    cause.causes.iter().for_each(|cause| add(lines, cause, depth + 1, nets));
}
