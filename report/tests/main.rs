//! Reports: their pages, their files and their verdicts.

mod browser;
mod contrast;
mod files;
mod sample;
mod verdicts;
