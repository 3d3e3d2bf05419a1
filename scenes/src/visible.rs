//! Whether a picture shows anything, said before it is rendered.

use crate::packet::{Edge, Packet};
use crate::project::{Counts, Polygons, Projection};

impl Projection {
    /// A sentence if no triangle covers a pixel, so that the picture would hold the background alone; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(&self.triangles)
    }
}

impl Polygons {
    /// A sentence if no polygon covers a pixel, so that the picture would hold the background alone; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(&self.polygons)
    }
}

impl Counts {
    fn warning<E: AsRef<[Edge]>>(&self, packets: &[Packet<E>]) -> Option<String> {
        if packets.iter().any(covers_a_pixel) {
            return None;
        }
        let c = self;
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

fn covers_a_pixel<E: AsRef<[Edge]>>(packet: &Packet<E>) -> bool {
    let b = packet.bounds;
    (b.top..=b.bottom).any(|y| (b.left..=b.right).any(|x| packet.covers(x, y)))
}
