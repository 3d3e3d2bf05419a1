//! The quadtree generator as a whole: its frames against the golden rasterizer, its counters against the paper's cost model, its manners.

mod counts;
mod each;
mod images;
mod polygons;
mod runs;
