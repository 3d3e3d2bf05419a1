#![doc = include_str!("../README.md")]

pub mod angle;
pub mod builtin;
mod camera;
mod checksum;
mod clip;
mod compare;
mod error;
pub mod frame;
pub mod golden;
mod input;
mod light;
mod load;
mod mesh;
mod output;
pub mod packet;
mod png;
mod project;
mod quote;
mod scene;
mod setup;
mod size;
mod visible;

pub use camera::Camera;
pub use compare::{Comparison, Difference, compare, compare_colours};
pub use error::SceneError;
pub use frame::Frame;
pub use light::{Light, Lighting};
pub use mesh::{BoundingBox, Mesh, MeshTriangle, smooth_normals};
pub use output::{Place, WholeFile, behind_links, write_whole};
pub use packet::{Edge, PixelBox, Plane, ScreenVertex, Triangle};
pub use project::{Counts, Projection, project, project_sample};
pub use quote::{escape, quote};
pub use scene::Scene;
pub use setup::{pixel_bounds, set_up, signed_area2};
pub use size::{MAX_SIDE, Size};
