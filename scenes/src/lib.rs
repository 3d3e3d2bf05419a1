//! Scenes, triangle set-up in integers, and the golden rasterizer.
