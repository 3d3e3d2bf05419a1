//! Waveform files in the Fast Signal Trace format of GTKWave: a fraction of the size of a VCD file.
//!
//! The format is that of "Implementation of an Efficient Method for Digital Waveform Compression" in GTKWave's manual.
//! A file is a sequence of blocks: the header, the hierarchy, the geometry (what a value of each variable is), and
//! blocks of changes. The crate `fst-writer` writes neither strings nor a start other than 0, and panics if nothing has
//! happened before it hands a block to the system.

mod block_file;
mod head;
mod number;
mod section;

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;

use super::changes::Id;
use super::sink::{BLOCK, Sink};
use super::vcd_header::{Header, Variable};
use crate::testbench::error::Error;
use block_file::BlockFile;
use head::Head;
use section::Section;

/// The bytes of changes that are collected for the second block, and the most for any. The first block has the first time
/// alone, because Surfer opens no file without changes. A larger block is a smaller file, and a run that is killed loses
/// up to a block.
const LEAST: usize = 1 << 20;
const MOST: usize = 1 << 24;

/// A file in this format.
pub(crate) struct FstFile {
    file: BlockFile,
    head: Head,
    /// What has not gone to the file yet.
    section: Section,
    /// The bytes of changes at which a block ends.
    much: usize,
}

impl FstFile {
    /// A file with this name, which is not created yet unless it is given.
    pub fn new(path: PathBuf, given: Option<Arc<File>>, header: &Header) -> FstFile {
        let head = Head::of(header);
        FstFile { file: BlockFile::new(path, given), section: Section::new(head.widths()), head, much: 0 }
    }
}

impl Sink for FstFile {
    /// The number of the variable.
    type Short = u32;

    fn short(variable: &Variable) -> u32 {
        variable.id.number
    }

    fn open(&mut self) {
        self.file.create();
        self.file.append(&self.head.blocks(), &self.head.header());
    }

    #[inline]
    fn at(&mut self, time: u64) {
        self.section.at(time);
    }

    fn first(&mut self) {}

    fn first_ends(&mut self) {
        self.section.set_frame();
    }

    #[inline]
    fn bit(&mut self, id: Id, high: bool) {
        self.section.bit(id.number, high);
    }

    #[inline]
    fn bits(&mut self, id: Id, limbs: &[u64]) {
        self.section.bits(id.number, limbs);
    }

    fn string(&mut self, id: Id, text: &str) {
        self.section.string(id.number, text);
    }

    #[inline]
    fn shorts(&mut self, which: u64, all: &[u32; BLOCK], limbs: &[u64; BLOCK]) {
        let mut rest = which;
        while rest != 0 {
            let place = rest.trailing_zeros() as usize % BLOCK;
            rest &= rest - 1;
            self.section.short(all[place], limbs[place]);
        }
    }

    fn flush_much(&mut self) {
        if self.section.size() >= self.much {
            self.flush();
            self.much = (2 * self.much).clamp(LEAST, MOST);
        }
    }

    fn flush(&mut self) {
        if let Some((times, block)) = self.section.take() {
            self.head.add(times);
            self.file.append(&block, &self.head.header());
        }
    }

    fn close(&mut self) {
        if self.head.is_empty() {
            self.section.at(0);
        }
        self.flush();
        self.file.close();
    }

    fn report(&mut self) -> Result<(), Error> {
        self.file.report()
    }
}
