//! Whether a picture shows anything, said before it is rendered.

use crate::packet::Triangle;
use crate::project::Projection;

impl Projection {
    /// A sentence if no triangle covers a pixel, so that the picture would hold the background alone; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        if self.triangles.iter().any(covers_a_pixel) {
            return None;
        }
        let c = self.counts;
        let polygons = match c.polygons {
            1 => "1 polygon".to_owned(),
            several => format!("{several} polygons"),
        };
        let fates = [
            (c.behind, "behind the camera"),
            (c.off_screen, "outside the picture"),
            (c.degenerate + c.between_centres + c.drawn, "too small for a pixel"),
        ];
        let fates = fates.iter().filter(|fate| fate.0 > 0).map(|(count, fate)| {
            let verb = if *count == 1 { "is" } else { "are" };
            format!("{count} {verb} {fate}")
        });
        Some(format!(
            "nothing is drawn: of {polygons}, {}: correct the eye, the target or the fov of the camera",
            fates.collect::<Vec<_>>().join(", ")
        ))
    }
}

fn covers_a_pixel(triangle: &Triangle) -> bool {
    let b = triangle.bounds;
    (b.top..=b.bottom).any(|y| (b.left..=b.right).any(|x| triangle.covers(x, y)))
}
