//! What memories hold at the start: a few words in the text, more in a file that `$readmemh` loads.

use super::literal::{Style, literal};
use super::printer::Printer;
use super::scope::Scope;
use crate::VerilogFile;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Contents, Memory, Module};

/// A memory of more words than this is loaded from a file: Yosys takes time that grows with the square of the words
/// that an `initial` block gives, a second at 1024 and minutes at 16,384.
const MOST_INLINE_WORDS: u32 = 256;

/// The name of the file that a memory is loaded from; no name has a dot, so that no two memories have one file.
fn data_file(module: &Module, memory: &Memory) -> String {
    format!("{}.{}.hex", module.name, memory.name)
}

/// The files that the memories of a module are loaded from.
pub fn data_files(module: &Module) -> Vec<VerilogFile> {
    let file = |memory| Some(VerilogFile { name: data_file(module, memory), text: data_text(memory)? });
    module.memories.iter().filter_map(file).collect()
}

/// A line for each word.
fn data_text(memory: &Memory) -> Option<String> {
    let line = |word: &Bits| format!("{word:x}\n");
    let depth = memory.depth as usize;
    match &memory.contents {
        _ if memory.depth <= MOST_INLINE_WORDS => None,
        Contents::Unknown => None,
        Contents::Each(_) => unreachable!("the language does not make these yet"),
        Contents::Fill(word) => Some(line(word).repeat(depth)),
        Contents::Words(words) => {
            let rest = line(&Bits::zero(memory.width)).repeat(depth - words.len());
            Some(words.iter().map(line).collect::<String>() + &rest)
        }
    }
}

impl Printer<'_> {
    /// What the memories hold at the start.
    pub fn memory_contents(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for memory in &module.memories {
            let name = &memory.name;
            let mut body = match &memory.contents {
                Contents::Unknown => continue,
                Contents::Each(_) => unreachable!("the language does not make these yet"),
                _ if memory.depth > MOST_INLINE_WORDS => {
                    out.push(format!("initial $readmemh(\"{}\", {name});", data_file(module, memory)));
                    out.push(String::new());
                    continue;
                }
                Contents::Fill(word) => self.fill(memory, 0, word),
                Contents::Words(words) => {
                    let word = |(address, word)| format!("    {name}[{address}] = {};", literal(word, Style::Pattern));
                    let rest = (words.len() < memory.depth as usize)
                        .then(|| self.fill(memory, words.len(), &Bits::zero(memory.width)));
                    rest.into_iter().flatten().chain(words.iter().enumerate().map(word)).collect()
                }
            };
            let label = self.taken.fresh(&format!("{name}_contents"));
            out.push(format!("initial begin : {label}"));
            out.append(&mut body);
            out.extend(["end".to_string(), String::new()]);
        }
        out
    }

    /// Gives every word from an address on the same value.
    fn fill(&mut self, memory: &Memory, from: usize, word: &Bits) -> Vec<String> {
        let index = self.taken.fresh_in(&mut Scope::default(), "word", "i");
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
