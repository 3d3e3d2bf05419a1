//! The sparse-raster quadtree generator on a board: it draws a stored turning scene.
//!
//! | file | contents |
//! |---|---|
//! | `turning`, `scenes`, `store` | the scene as packets, its golden pictures, and the packets as words of a memory |
//! | `player`, `host` | what feeds the machine, and swaps its banks |
//! | `compact` | the machine with video processors for many in a chip |
//! | `picture` | the machine as a picture of a screen |
//! | `tops` | the machine on the boards |

mod compact;
mod host;
mod picture;
mod player;
mod scenes;
mod store;
mod tops;
mod turning;

pub use compact::*;
pub use host::{Host, HostIn, HostOut};
pub use picture::{Machine, QuadtreePicture, shown};
pub use player::{Player, PlayerIn, PlayerOut};
pub use scenes::{cube, teapot};
pub use store::Store;
pub use tops::*;
pub use turning::{Step, Turning};
