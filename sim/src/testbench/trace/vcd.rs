//! Waveform files in the Value Change Dump format of IEEE 1364-2001, section 18.

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;

use super::changes::{Changes, Id, Short};
use super::sink::{BLOCK, Sink};
use super::step_file::StepFile;
use super::vcd_header::{Header, Variable, VariableKind};
use crate::testbench::error::Error;

/// The amount collected before it goes to the file, always in whole time steps. So the file ends with a whole step,
/// unless the run is killed during a write.
const CHUNK: usize = 1 << 18;

/// A file in this format.
pub(crate) struct VcdFile {
    file: StepFile,
    /// From `$version` to `$enddefinitions`.
    header: Vec<u8>,
    /// The text that has not gone to the file yet.
    text: Changes,
}

impl VcdFile {
    /// A file with this name, which is not created yet unless it is given.
    pub fn new(path: PathBuf, given: Option<Arc<File>>, header: &Header) -> VcdFile {
        VcdFile { file: StepFile::new(path, given), header: header.text.clone(), text: Changes::default() }
    }
}

impl Sink for VcdFile {
    type Short = Short;

    fn short(variable: &Variable) -> Short {
        Short::new(variable.id, matches!(variable.kind, VariableKind::Bit))
    }

    fn open(&mut self) {
        self.file.create();
        self.file.append(&self.header);
    }

    #[inline]
    fn at(&mut self, time: u64) {
        self.text.at(time);
    }

    fn first(&mut self) {
        self.text.command("$dumpvars");
    }

    fn first_ends(&mut self) {
        self.text.command("$end");
    }

    #[inline]
    fn bit(&mut self, id: Id, high: bool) {
        self.text.bit(id, high);
    }

    #[inline]
    fn bits(&mut self, id: Id, limbs: &[u64]) {
        self.text.bits(id, limbs);
    }

    fn string(&mut self, id: Id, text: &str) {
        self.text.string(id, text);
    }

    #[inline]
    fn shorts(&mut self, which: u64, all: &[Short; BLOCK], limbs: &[u64; BLOCK]) {
        self.text.shorts(which, all, limbs);
    }

    fn flush_much(&mut self) {
        if self.text.bytes().len() >= CHUNK {
            let file = &mut self.file;
            self.text.exchange(|steps, length| file.hand_over(steps, length));
        }
    }

    fn flush(&mut self) {
        self.file.append(self.text.bytes());
        self.text.clear();
    }

    fn report(&mut self) -> Result<(), Error> {
        self.file.report()
    }
}
