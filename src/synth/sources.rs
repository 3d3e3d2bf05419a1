//! Our own printed Verilog, in which the tools' places lead to the user's names and source lines.

use std::collections::BTreeMap;
use tilewright_gen::VerilogFile;
use tilewright_hdl::Design;
use tilewright_hdl::ir::Output;

/// The files of a design.
pub struct Sources<'a> {
    /// The lines, by the name of the file.
    files: BTreeMap<&'a str, Vec<&'a str>>,
    /// The source lines of outputs, which the Verilog does not have, by module and name.
    outputs: BTreeMap<(&'a str, &'a str), String>,
}

/// A stretch of a line of Verilog, as Yosys names it: `file.v:46.50-46.76`.
#[derive(Clone, Copy)]
pub struct Stretch<'a> {
    file: &'a str,
    line: usize,
    begin: usize,
    end: usize,
}

/// How many lines below an `if` the register stands that it decides on, at most.
const BELOW: usize = 8;

impl<'a> Sources<'a> {
    pub fn of(design: &'a Design, files: &'a [VerilogFile]) -> Sources<'a> {
        let verilog = files.iter().filter(|file| file.name.ends_with(".v"));
        let outputs = design.modules().iter().flat_map(|module| {
            let line = |it: &Output| module.nodes.get(it.node.0 as usize).map(|node| node.loc);
            let line = move |it| line(it).map_or_else(String::new, |loc| format!("{}:{}", loc.file(), loc.line()));
            module.outputs.iter().map(move |it| ((module.name.as_str(), it.name.as_str()), line(it)))
        });
        Sources {
            files: verilog.map(|file| (file.name.as_str(), file.text.lines().collect())).collect(),
            outputs: outputs.collect(),
        }
    }

    /// The first stretch of one line in our files, of places that Yosys has joined by `|`.
    pub fn stretch<'b>(&self, places: &'b str) -> Option<Stretch<'b>> {
        places.split('|').filter_map(Stretch::read).find(|it| self.files.contains_key(it.file))
    }

    /// What stands there.
    pub fn text(&self, at: Stretch) -> Option<&'a str> {
        self.line(at.file, at.line)?.get(at.begin - 1..at.end - 1)
    }

    /// The source line of what is declared there.
    pub fn declared(&self, at: Stretch) -> Option<String> {
        place(self.line(at.file, at.line)?).map(str::to_owned)
    }

    /// What the statement there gives a value to, and its source line.
    pub fn assigned(&self, at: Stretch) -> Option<(&'a str, String)> {
        let lines = (at.line..at.line + BELOW).map_while(|line| self.line(at.file, line));
        let name = lines.take_while(|line| !line.trim().is_empty()).find_map(target)?;
        let own = self.declared(at);
        Some((name, own.or_else(|| self.declaration(at.file, name))?))
    }

    /// The source line of a name that a module declares; for its inputs, that of the module.
    pub fn declaration(&self, file: &str, name: &str) -> Option<String> {
        let lines = self.files.get(file)?;
        let own = lines.iter().filter(|line| declares(line, name)).find_map(|line| place(line));
        let module = || lines.iter().find_map(|line| line.strip_prefix("// Described   "));
        let output = self.outputs.get(&(file.trim_end_matches(".v"), name)).map(String::as_str);
        own.or(output).or_else(module).map(str::to_owned)
    }

    /// The source line of a memory in any module.
    pub fn memory(&self, name: &str) -> Option<String> {
        let lines = self.files.values().flatten().filter(|line| declares(line, name));
        lines.filter_map(|line| place(line)).next().map(str::to_owned)
    }

    fn line(&self, file: &str, line: usize) -> Option<&'a str> {
        self.files.get(file)?.get(line.checked_sub(1)?).copied()
    }
}

impl<'a> Stretch<'a> {
    fn read(place: &'a str) -> Option<Stretch<'a>> {
        let (file, range) = place.rsplit_once(':')?;
        let (from, to) = range.split_once('-')?;
        let point = |text: &str| -> Option<(usize, usize)> {
            let (line, column) = text.split_once('.')?;
            Some((line.parse().ok()?, column.parse().ok()?))
        };
        let ((line, begin), (last, end)) = (point(from)?, point(to)?);
        (line == last && 0 < begin && begin < end).then_some(Stretch { file, line, begin, end })
    }

    pub fn file(&self) -> &'a str {
        self.file
    }
}

/// The source line that a line of Verilog ends with.
fn place(line: &str) -> Option<&str> {
    let (_, place) = line.rsplit_once("// ")?;
    let (file, number) = place.rsplit_once(':')?;
    (file.ends_with(".rs") && number.chars().all(|c| c.is_ascii_digit())).then_some(place)
}

/// Whether a line declares that name.
fn declares(line: &str, name: &str) -> bool {
    let mut words = line.trim_start().split(|c: char| !c.is_alphanumeric() && c != '_' && c != '$');
    let kind = words.next().unwrap_or_default();
    matches!(kind, "reg" | "wire" | "assign" | "integer" | "output" | "input") && words.any(|word| word == name)
}

/// What a line gives a value to.
fn target(line: &str) -> Option<&str> {
    let mut rest = line.trim_start();
    rest = rest.strip_prefix("else ").unwrap_or(rest);
    if let Some(condition) = rest.strip_prefix("if (") {
        rest = &condition[closing(condition)? + 1..];
    }
    let before = [" <= ", " = "].iter().filter_map(|sign| rest.find(sign)).min()?;
    let name = rest[..before].split_whitespace().rfind(|word| !word.starts_with('['))?;
    let name = name.split('[').next()?;
    name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '$').then_some(name)
}

/// Where the parenthesis ends that was opened before the text.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 1;
    text.char_indices().find_map(|(at, c)| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
// Described   rtl/src/merger/unit.rs:26
    reg [47:0] left1;    // rtl/src/merger/unit.rs:69
    wire full = used == 10'd6;    // blocks/src/fifo.rs:109
        if (enable) begin
            if ((a <= b) & c) left1 <= right;
            else left1 <= left;
";

    #[test]
    fn places_of_the_tools_lead_to_source_lines() {
        let files = [VerilogFile { name: "m.v".to_owned(), text: TEXT.to_owned() }];
        let sources = Sources {
            files: files.iter().map(|file| (file.name.as_str(), file.text.lines().collect())).collect(),
            outputs: BTreeMap::from([(("m", "nearer"), "rtl/src/merger/unit.rs:70".to_owned())]),
        };
        let at = |places: &'static str| sources.stretch(places).unwrap();
        assert_eq!(sources.text(at("m.v:2.16-2.21")), Some("left1"));
        assert_eq!(sources.declared(at("m.v:2.16-2.21")), Some("rtl/src/merger/unit.rs:69".to_owned()));
        for place in ["m.v:5.18-5.24", "/share/x.v:1.1-1.2|m.v:6.27-6.31", "m.v:4.9-4.12"] {
            assert_eq!(sources.assigned(at(place)), Some(("left1", "rtl/src/merger/unit.rs:69".to_owned())), "{place}");
        }
        assert_eq!(sources.text(at("m.v:5.18-5.24")), Some("a <= b"));
        assert_eq!(sources.assigned(at("m.v:3.17-3.30")), Some(("full", "blocks/src/fifo.rs:109".to_owned())));
        assert_eq!(sources.declaration("m.v", "nearer"), Some("rtl/src/merger/unit.rs:70".to_owned()));
        assert_eq!(sources.declaration("m.v", "left"), Some("rtl/src/merger/unit.rs:26".to_owned()));
        assert!(sources.stretch("m.v:4.5-8.10").is_none() && sources.stretch("x.v:1.1-1.2").is_none());
        // What is not in the file is not found, and no panic.
        assert_eq!(sources.text(at("m.v:2.16-2.2100")), None);
        assert_eq!(sources.text(at("m.v:99.1-99.2")), None);
    }
}
