//! The machines that there are.

use clap::ValueEnum;

/// A machine by its name on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Machine {
    Vc1,
}

impl Machine {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Machine::Vc1 => "vc1",
        }
    }

    /// What it is, in a few words.
    pub fn summary(self) -> &'static str {
        match self {
            Machine::Vc1 => "processing elements draw into virtual local frame buffers, which are merged by depth",
        }
    }

    /// The paper.
    pub fn source(self) -> &'static str {
        match self {
            Machine::Vc1 => "Nishimura and Kunii, VC-1: A Scalable Graphics Computer with Virtual Local Frame Buffers",
        }
    }
}
