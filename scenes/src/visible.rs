//! Whether a picture shows anything, said before it is rendered.

use crate::packet::{Edge, Packet};
use crate::project::{Counts, Polygons, Projection};

impl Projection {
    /// A sentence if no triangle and no line covers a pixel, so that the picture would hold the background alone; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(&self.triangles)
    }
}

impl Polygons {
    /// A sentence if no polygon and no line covers a pixel, so that the picture would hold the background alone; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(&self.polygons)
    }
}

impl Counts {
    pub(crate) fn warning<'a, E: AsRef<[Edge]> + 'a>(
        &self,
        packets: impl IntoIterator<Item = &'a Packet<E>>,
    ) -> Option<String> {
        if packets.into_iter().any(covers_a_pixel) {
            return None;
        }
        let c = self;
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
            "nothing is drawn: of {}, {}: correct the eye, the target or the fov of the camera",
            c.of_each_kind(),
            fates.collect::<Vec<_>>().join(", ")
        ))
    }

    /// How many polygons and lines there are, such as `3 polygons and 1 line`.
    ///
    /// ```
    /// use tilewright_scenes::Counts;
    ///
    /// assert_eq!(Counts { polygons: 3, ..Counts::default() }.of_each_kind(), "3 polygons");
    /// assert_eq!(Counts { polygons: 3, lines: 2, ..Counts::default() }.of_each_kind(), "1 polygon and 2 lines");
    /// ```
    pub fn of_each_kind(&self) -> String {
        let number = |count: u32, what: &str| if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") };
        match (self.polygons.saturating_sub(self.lines), self.lines) {
            (polygons, 0) => number(polygons, "polygon"),
            (0, lines) => number(lines, "line"),
            (polygons, lines) => format!("{} and {}", number(polygons, "polygon"), number(lines, "line")),
        }
    }
}

fn covers_a_pixel<E: AsRef<[Edge]>>(packet: &Packet<E>) -> bool {
    let b = packet.bounds;
    (b.top..=b.bottom).any(|y| (b.left..=b.right).any(|x| packet.covers(x, y)))
}
