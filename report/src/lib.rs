#![doc = include_str!("../README.md")]

pub mod browser;
mod chart;
mod csv;
mod evidence;
mod heat_map;
mod html;
mod number;
mod origin;
mod page;
pub mod palette;
mod picture;
mod plot;
mod problem;
mod provenance;
mod reason;
mod statement;
mod table;
mod timeline;
mod verdict;
mod verdicts;

pub use chart::{Axis, Chart, Series};
pub use heat_map::HeatMap;
pub use origin::Origin;
pub use page::{File, Link, Page, Part, Section};
pub use picture::Picture;
pub use problem::Problems;
pub use provenance::Provenance;
pub use reason::Reason;
pub use statement::Statement;
pub use table::{Cell, Table};
pub use timeline::{Lane, Timeline};
pub use verdict::{Difference, Point, Rule, Verdict};
pub use verdicts::Verdicts;
