//! The contents of memories at the start: a few words in the text, more in a file that `$readmemh` loads.

use super::literal::{Style, literal};
use super::printer::Printer;
use crate::VerilogFile;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Contents, Memory, MemoryId, Module};

/// Memories with more words are loaded from a file: Yosys takes time quadratic in the words of an `initial` block, a
/// second at 1024 and minutes at 16,384.
const MOST_INLINE_WORDS: u32 = 256;

/// The name of the file that a memory, or a lane of one, is loaded from. Names contain no dot, so no two memories
/// share a file.
fn data_file(module: &Module, memory: &Memory, lane: Option<usize>) -> String {
    let lane = lane.map(|lane| format!(".{lane}")).unwrap_or_default();
    format!("{}.{}{lane}.hex", module.name, memory.name)
}

/// The files that the memories of a module are loaded from.
pub fn data_files(module: &Module) -> Vec<VerilogFile> {
    let mut files = Vec::new();
    for memory in module.memories.iter().filter(|memory| memory.depth > MOST_INLINE_WORDS) {
        for (lane, contents) in lanes(&memory.contents) {
            let text = data_text(memory, &contents);
            files.extend(text.map(|text| VerilogFile { name: data_file(module, memory, lane), text }));
        }
    }
    files
}

/// The contents; those of each lane if they differ.
fn lanes(contents: &Contents) -> Vec<(Option<usize>, Contents)> {
    match contents {
        Contents::Each(lanes) => {
            lanes.iter().enumerate().map(|(lane, words)| (Some(lane), Contents::Words(words.clone()))).collect()
        }
        contents => vec![(None, contents.clone())],
    }
}

/// A line for each word.
fn data_text(memory: &Memory, contents: &Contents) -> Option<String> {
    let line = |word: &Bits| format!("{word:x}\n");
    let depth = memory.depth as usize;
    match contents {
        Contents::Unknown | Contents::Each(_) => None,
        Contents::Fill(word) => Some(line(word).repeat(depth)),
        Contents::Words(words) => {
            let rest = line(&Bits::zero(memory.width)).repeat(depth - words.len());
            Some(words.iter().map(line).collect::<String>() + &rest)
        }
    }
}

impl Printer<'_> {
    /// The contents at the start of the memories without lanes.
    pub fn memory_contents(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for memory in module.memories.iter().filter(|memory| memory.shape.is_plain()) {
            let initial = self.initial(memory, &memory.contents, None);
            if !initial.is_empty() {
                out.extend(initial);
                out.push(String::new());
            }
        }
        out
    }

    /// The contents at the start of a memory in the current lane.
    pub fn lane_contents(&mut self, id: MemoryId) -> Vec<String> {
        let module = self.module;
        let memory = &module.memories[id.0 as usize];
        if !matches!(memory.contents, Contents::Each(_)) {
            return self.initial(memory, &memory.contents, None);
        }
        let mut out = vec![format!("case ({})", self.lane_number(memory.shape))];
        for (lane, contents) in lanes(&memory.contents) {
            let number = lane.expect("contents a lane");
            let is_last = number + 1 == memory.shape.lanes() as usize;
            let label = if is_last { "default".to_string() } else { number.to_string() };
            let block = self.label(&format!("{}_{number}", memory.name));
            out.push(format!("    {label}: begin : {block}"));
            out.extend(self.initial(memory, &contents, lane).into_iter().map(|line| format!("        {line}")));
            out.push("    end".to_string());
        }
        out.push("endcase".to_string());
        out
    }

    /// The block that loads a memory, or one lane of it.
    fn initial(&mut self, memory: &Memory, contents: &Contents, lane: Option<usize>) -> Vec<String> {
        let name = &memory.name;
        let body = match contents {
            Contents::Unknown | Contents::Each(_) => return Vec::new(),
            _ if memory.depth > MOST_INLINE_WORDS => {
                return vec![format!("initial $readmemh(\"{}\", {name});", data_file(self.module, memory, lane))];
            }
            Contents::Fill(word) => self.fill(memory, 0, word),
            Contents::Words(words) => {
                let word = |(address, word)| format!("    {name}[{address}] = {};", literal(word, Style::Pattern));
                let rest = (words.len() < memory.depth as usize)
                    .then(|| self.fill(memory, words.len(), &Bits::zero(memory.width)));
                rest.into_iter().flatten().chain(words.iter().enumerate().map(word)).collect()
            }
        };
        let label = self.label(&format!("{name}_contents"));
        [format!("initial begin : {label}")].into_iter().chain(body).chain(["end".to_string()]).collect()
    }

    /// Assigns one value to every word from an address on.
    fn fill(&mut self, memory: &Memory, from: usize, word: &Bits) -> Vec<String> {
        let [index] = self.local("word", ["i"]);
        let (name, word) = (&memory.name, literal(word, Style::Pattern));
        vec![
            format!("    integer {index};"),
            format!(
                "    for ({index} = {from}; {index} < {}; {index} = {index} + 1) {name}[{index}] = {word};",
                memory.depth
            ),
        ]
    }
}
