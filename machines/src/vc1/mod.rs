//! The VC-1: processing elements that draw into virtual local frame buffers, whose contents are merged by depth.
//!
//! ```text
//! commands of the host, large polygons of all PEs -> broadcast bus -> all PEs
//!
//! polygons -> clusters -> PE 0 -> local frame buffer -> merging unit --.
//!                         PE 1 -> local frame buffer -> merging unit <-'
//!                          ...                                       --> global frame buffer -> display
//! ```
//!
//! Source: Nishimura and Kunii, "VC-1: A Scalable Graphics Computer with Virtual Local Frame Buffers", facts A1. The processing
//! elements and the host are programs in Rust, which count clocks by a cost table. Everything behind a processing element's port is
//! the hardware of `tilewright-rtl`, simulated clock by clock.
//!
//! ```no_run
//! use tilewright_machines::{Watch, vc1};
//! use tilewright_scenes::{Scene, golden, project};
//!
//! let scene = Scene::builtin("teapot").expect("a built-in scene");
//! let projection = project(&scene, scene.size)?;
//! let machine = vc1::Machine::new(vc1::Config::new(scene.size))?;
//! let (frame, report) = machine.render(&projection, scene.background, &mut Watch::default())?;
//! assert_eq!(frame, golden::render(scene.size, &projection.triangles, scene.background));
//! println!("{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assignment;
mod clocks;
mod comparison;
mod config;
mod cost;
mod cursor;
mod demand;
mod display;
mod edges;
mod hardware;
mod history;
mod host;
mod job;
mod machine;
pub mod model;
mod notes;
mod pages;
mod ports;
mod processor;
mod program;
mod report;
mod scan_conversion;
mod way;
mod words;

pub use assignment::{Assign, Assignment, Polygon};
pub use clocks::Clocks;
pub use config::{Built, Config};
pub use cost::CostTable;
pub use cursor::Cursor;
pub use demand::{Demand, demand};
pub use machine::Machine;
pub use report::{FrameReport, ProcessorReport, Report, Shown, Times};
