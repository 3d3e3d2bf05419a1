//! Runs command lines in a folder of their own.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// The program under test.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_tilewright");

/// The text of `pyramid.obj`, a scene of four faces that is drawn in no time.
pub const PYRAMID: &str = "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1.5 0\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n";

/// A folder in which commands run; it goes away when dropped.
pub struct Folder(TempDir);

/// How a command ended.
#[derive(Clone, Debug)]
pub struct Run {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Folder {
    pub fn new() -> Folder {
        Folder(TempDir::new().unwrap())
    }

    /// A folder with these files in it.
    pub fn with(files: &[(&str, &str)]) -> Folder {
        let folder = Folder::new();
        for (name, text) in files {
            std::fs::write(folder.path(name), text).unwrap();
        }
        folder
    }

    /// A folder with `pyramid.obj` in it.
    pub fn with_pyramid() -> Folder {
        Folder::with(&[("pyramid.obj", PYRAMID)])
    }

    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    /// `tilewright` with these arguments, ready to run.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(PROGRAM);
        command.args(arguments.split_whitespace()).current_dir(self.0.path());
        command
    }

    /// Runs `tilewright` with these arguments, separated by blanks.
    pub fn run(&self, arguments: &str) -> Run {
        Run::of(self.command(arguments).output().unwrap())
    }

    /// Runs `tilewright`, which has to succeed, and returns what it prints.
    pub fn stdout(&self, arguments: &str) -> String {
        let run = self.run(arguments);
        assert_eq!(run.code, Some(0), "tilewright {arguments}: {run:?}");
        run.stdout
    }

    /// Runs `tilewright`, which has to succeed, and returns the JSON that it prints.
    pub fn json(&self, arguments: &str) -> Value {
        serde_json::from_str(&self.stdout(arguments)).unwrap()
    }

    /// Runs a line in a shell that finds `tilewright`.
    pub fn shell(&self, line: &str) -> Run {
        let program = Path::new(PROGRAM).parent().unwrap().display().to_string();
        let path = format!("{program}:{}", std::env::var("PATH").unwrap_or_default());
        let mut command = Command::new("sh");
        Run::of(command.args(["-c", line]).env("PATH", path).current_dir(self.0.path()).output().unwrap())
    }

    pub fn read(&self, name: impl AsRef<Path>) -> String {
        let path = self.path(name);
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// What the files below a folder in it hold, by their names from there on.
    pub fn files(&self, below: &str) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        for entry in std::fs::read_dir(self.path(below)).unwrap() {
            let entry = entry.unwrap();
            let inner = entry.file_name().into_string().unwrap();
            match entry.file_type().unwrap().is_dir() {
                true => {
                    let within = self.files(&format!("{below}/{inner}"));
                    files.extend(within.into_iter().map(|(file, bytes)| (format!("{inner}/{file}"), bytes)));
                }
                false => _ = files.insert(inner, std::fs::read(entry.path()).unwrap()),
            }
        }
        files
    }

    /// The names of the files and folders in it, in order.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries.map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Run {
    pub fn of(output: Output) -> Run {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Run { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

/// A waveform read to its end by another's reader.
pub struct Waveform {
    /// The paths of the variables, as GTKWave writes them.
    pub names: Vec<String>,
    /// Every time stamp, in picoseconds.
    pub times: Vec<u64>,
}

impl Waveform {
    /// Reads a waveform file, which has to be sound: it parses to its end, and time never goes backwards.
    pub fn read(path: &Path) -> Waveform {
        let mut parser = vcd::Parser::new(std::fs::read(path).map(std::io::Cursor::new).unwrap());
        let header = parser.parse_header().unwrap();
        let mut names = Vec::new();
        header.items.iter().for_each(|item| collect(item, "", &mut names));
        let commands: Vec<vcd::Command> = parser.collect::<Result<_, _>>().unwrap();
        let times: Vec<u64> = commands
            .iter()
            .filter_map(|it| if let vcd::Command::Timestamp(time) = it { Some(*time) } else { None })
            .collect();
        assert!(times.is_sorted(), "time goes backwards in {}", path.display());
        Waveform { names, times }
    }
}

fn collect(item: &vcd::ScopeItem, path: &str, names: &mut Vec<String>) {
    match item {
        vcd::ScopeItem::Scope(scope) => {
            let path = format!("{path}{}.", scope.identifier);
            scope.items.iter().for_each(|item| collect(item, &path, names));
        }
        vcd::ScopeItem::Var(variable) => {
            let index = variable.index.map_or_else(String::new, |index| index.to_string());
            names.push(format!("{path}{}{index}", variable.reference));
        }
        _ => {}
    }
}
