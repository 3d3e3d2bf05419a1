//! A page in the browser that shows a frame coming into being, or a block clock by clock.
//!
//! The page is plain HTML, CSS and JavaScript in `page/`. A [`Server`] answers for it on the loopback, and [`export::files`] gives the
//! same page as files that open without a server. The crate knows no machine and no circuit: a [`Site`] has the data.

mod areas;
mod columns;
mod connection;
pub mod export;
#[doc(hidden)]
pub mod for_examples;
mod guard;
mod page;
mod picture;
mod server;
mod site;
mod token;

pub use areas::{Area, Areas};
pub use page::Page;
pub use picture::{Clock, Grid, Kind, Lane, Part, Picture, Unit, Write};
pub use server::Server;
pub use site::{Answer, Site};
