//! What Yosys says of a file that it cannot read, as a sentence for its author.

use std::path::{Path, PathBuf};

/// The files as they were named, and their full paths.
pub struct Named(Vec<(PathBuf, PathBuf)>);

impl Named {
    /// # Errors
    ///
    /// A sentence: a file cannot be read.
    pub fn of(files: &[PathBuf]) -> Result<Named, String> {
        let full = |file: &PathBuf| match file.canonicalize().and_then(|full| std::fs::read(&full).map(|_| full)) {
            Ok(full) if full.to_string_lossy().contains(['"', '\n']) => {
                Err(format!("{}: Yosys reads no file whose path has a quotation mark: move it", file.display()))
            }
            Ok(full) => Ok((file.clone(), full)),
            Err(error) => {
                Err(format!("{}: cannot be read ({error}): give the Verilog file of a module", file.display()))
            }
        };
        Ok(Named(files.iter().map(full).collect::<Result<_, _>>()?))
    }

    /// The commands of Yosys that read all files. Modules are not built before their parameters are known.
    pub fn read(&self) -> String {
        let kind = |full: &Path| if full.extension().is_some_and(|it| it == "sv") { "-sv " } else { "" };
        let each = self.0.iter().map(|(_, full)| format!("read_verilog -defer {}\"{}\"", kind(full), full.display()));
        each.collect::<Vec<_>>().join("; ")
    }

    /// A place of Yosys, such as `/home/me/hand.v:3.1-4.2`, as file and line.
    pub fn place(&self, place: &str) -> String {
        let place = self.renamed(place);
        match place.rsplit_once(':') {
            Some((file, range)) => format!("{file}:{}", range.split(['.', '-']).next().unwrap_or_default()),
            None => place,
        }
    }

    /// The files, as they were named.
    pub fn files(&self) -> String {
        let names: Vec<String> = self.0.iter().map(|(named, _)| named.display().to_string()).collect();
        names.join(", ")
    }

    /// Whether a module of that name is a part of another one: its name is followed by parameters or by a name.
    pub fn contain(&self, module: &str) -> bool {
        let texts = self.0.iter().map(|(_, full)| std::fs::read_to_string(full).unwrap_or_default());
        texts.into_iter().any(|text| contains(&text, module))
    }

    fn renamed(&self, text: &str) -> String {
        self.0.iter().fold(text.to_owned(), |text, (named, full)| {
            text.replace(&full.display().to_string(), &named.display().to_string())
        })
    }

    /// The sentence for what Yosys printed; `None` if there is no error of the files in it.
    pub fn sentence(&self, output: &str) -> Option<String> {
        let (place, error) = output.lines().find_map(|line| line.split_once("ERROR: "))?;
        let text = self
            .renamed(error.trim_end_matches(['.', '!']))
            .replace("Can't", "cannot")
            .replace("$abstract\\", "")
            .replace("`\\", "`")
            .replace('\'', "`");
        let quoted: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
        let place = place.trim_end_matches(": ");
        Some(match quoted[..] {
            [module, ..] if text.contains("is not part of the design") => {
                let by = quoted.get(1).copied().unwrap_or_default();
                format!(
                    "{}: `{by}` contains a `{module}`, which none of the files has: name its file, too",
                    self.files()
                )
            }
            [parameter, ..] if text.contains("find object for defparam") => {
                format!("{}: the module has no parameter `{parameter}`: leave it out", self.files())
            }
            _ if place.is_empty() || place.starts_with("input:") => {
                format!("{}: Yosys cannot read it ({text}): correct it", self.files())
            }
            _ => format!("{}: {text}: correct it", self.renamed(place)),
        })
    }
}

/// Whether a text of Verilog contains an instance of a module.
fn contains(text: &str, module: &str) -> bool {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect();
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '$';
    let instance = |(at, name): (usize, &str)| {
        let (before, after) = (&code[..at], code[at + name.len()..].trim_start());
        let is_declared = before.trim_end().ends_with("module");
        let is_whole = !before.ends_with(is_part) && !code[at + name.len()..].starts_with(is_part);
        is_whole
            && !is_declared
            && after.starts_with(|c: char| c == '#' || c == '\\' || (is_part(c) && !c.is_numeric()))
    };
    code.match_indices(module).any(instance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_become_sentences_with_place_and_remedy() {
        let files = Named(vec![("hand.v".into(), "/home/me/hand.v".into())]);
        for (output, sentence) in [
            (
                "Warning: x\n/home/me/hand.v:3: ERROR: syntax error, unexpected end of file\n",
                "hand.v:3: syntax error, unexpected end of file: correct it",
            ),
            (
                "ERROR: Module `\\foo' referenced in module `\\hand' in cell `\\u' is not part of the design.",
                "hand.v: `hand` contains a `foo`, which none of the files has: name its file, too",
            ),
            (
                "input:0: ERROR: Can't find object for defparam `NOPE`!",
                "hand.v: the module has no parameter `NOPE`: leave it out",
            ),
        ] {
            assert_eq!(files.sentence(output).as_deref(), Some(sentence));
        }
        for (text, is_there) in [
            ("module m(input a);\n part #(.N(3)) u ();\nendmodule", true),
            ("part u(a);", true),
            ("module part (input a); // part u\n wire part2; department u();", false),
        ] {
            assert_eq!(contains(text, "part"), is_there, "{text}");
        }
        assert_eq!(files.sentence("killed"), None);
        assert_eq!(files.place("/home/me/hand.v:12.3-14.5"), "hand.v:12");
    }
}
