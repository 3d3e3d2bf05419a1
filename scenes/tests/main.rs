//! Scenes, files and the golden rasterizer.

mod contract;
mod deferred;
mod line;
mod line_projection;
mod load;
mod no_panic;
mod oracle;
mod output;
mod pinned;
mod png;
mod polygon;
mod projection;
mod spheres;
