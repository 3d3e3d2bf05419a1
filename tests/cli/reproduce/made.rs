//! Pages as the commands of the help texts and of the README make them, each once for all tests that look at it.

use crate::cli::harness::{Folder, Run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

/// What a command line printed and wrote.
pub struct Made {
    pub run: Run,
    /// By their names in the report's folder.
    files: BTreeMap<String, Vec<u8>>,
}

/// What `tilewright reproduce OPTIONS` prints, and what it writes into `report/`.
pub fn made(options: &str) -> &'static Made {
    type Once = Arc<OnceLock<&'static Made>>;
    static ALL: Mutex<BTreeMap<String, Once>> = Mutex::new(BTreeMap::new());
    let once = ALL.lock().unwrap().entry(options.to_owned()).or_default().clone();
    once.get_or_init(|| {
        let folder = Folder::new();
        let run = folder.run(&format!("reproduce {options}"));
        assert_eq!(run.code, Some(0), "{options}: {run:?}");
        let files = folder.files("report");
        for (name, bytes) in &files {
            let text = String::from_utf8_lossy(bytes);
            assert!(!text.contains(env!("CARGO_MANIFEST_DIR")), "{name} names the folder of the sources");
            assert!(!text.contains(folder.path("").to_str().unwrap()), "{name} names its own folder");
        }
        Box::leak(Box::new(Made { run, files }))
    })
}

impl Made {
    /// The text of a file.
    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        let bytes = self.files.get(name).unwrap_or_else(|| panic!("there is no {name}"));
        String::from_utf8(bytes.clone()).unwrap()
    }

    /// The names of all files, in order, and what they hold.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
    }

    /// The files that the command says it wrote, by their names in the report's folder, in order: in its JSON, or line by line.
    pub fn told(&self) -> Vec<String> {
        let mut told: Vec<String> = match serde_json::from_str::<Value>(&self.run.stdout) {
            Ok(report) => {
                report["files"].as_array().unwrap().iter().map(|it| it.as_str().unwrap().to_owned()).collect()
            }
            Err(_) => {
                self.run.stderr.lines().filter_map(|line| line.strip_prefix("wrote ")).map(str::to_owned).collect()
            }
        };
        told.iter_mut().for_each(|name| *name = name.strip_prefix("report/").unwrap().to_owned());
        told.sort_unstable();
        told
    }

    /// How many statements the command says hold, differ and cannot be compared.
    pub fn counts(&self) -> [u64; 3] {
        match serde_json::from_str::<Value>(&self.run.stdout) {
            Ok(report) => ["holds", "differs", "cannot_be_compared"].map(|name| report[name].as_u64().unwrap()),
            Err(_) => {
                let numbers: Vec<u64> =
                    self.run.stdout.split_whitespace().filter_map(|word| word.parse().ok()).collect();
                numbers.try_into().unwrap_or_else(|_| panic!("{}", self.run.stdout))
            }
        }
    }

    /// The cells of a chart's CSV file: name and x, by formula, counted, of the model, of RTL, of the paper, and the seeds of the middle three.
    pub fn rows(&self, name: &str) -> Vec<Vec<String>> {
        let text = self.read(name);
        let names = text.lines().next().unwrap();
        let columns =
            ",formula,plain count,transaction model,RTL,paper,plain count seeds,transaction model seeds,RTL seeds";
        assert!(names.ends_with(columns), "{names}");
        self.lines(name).collect()
    }

    /// The cells of a file, after the line of names.
    pub fn lines(&self, name: &str) -> impl Iterator<Item = Vec<String>> {
        let lines: Vec<_> =
            self.read(name).lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect();
        lines.into_iter()
    }
}
