//! Reports before rendering whether a picture shows anything.

use crate::golden::Primitive;
use crate::packet::{Edge, Packet};
use crate::project::{Counts, Polygons, Projection};

impl Projection {
    /// A sentence if no triangle and no line covers a pixel, so that the picture would show only the background; `None`
    /// if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(&self.triangles)
    }
}

impl Polygons {
    /// A sentence if no polygon, line or sphere covers a pixel, so that the picture would show only the background;
    /// `None` if one does.
    pub fn warning(&self) -> Option<String> {
        if self.spheres.iter().any(covers_a_pixel) { None } else { self.counts.warning(&self.polygons) }
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

    /// The numbers of polygons, lines and spheres, such as `3 polygons and 1 line`.
    ///
    /// ```
    /// use tilewright_scenes::Counts;
    ///
    /// assert_eq!(Counts { polygons: 3, ..Counts::default() }.of_each_kind(), "3 polygons");
    /// assert_eq!(Counts { polygons: 3, lines: 2, ..Counts::default() }.of_each_kind(), "1 polygon and 2 lines");
    /// assert_eq!(Counts { polygons: 9, lines: 2, spheres: 1, ..Counts::default() }.of_each_kind(), "6 polygons, 2 lines and 1 sphere");
    /// ```
    pub fn of_each_kind(&self) -> String {
        let number = |count: u32, what: &str| if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") };
        let faces = self.polygons.saturating_sub(self.lines + self.spheres);
        let kinds = [(faces, "polygon"), (self.lines, "line"), (self.spheres, "sphere")];
        let mut kinds: Vec<String> =
            kinds.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| number(count, what)).collect();
        match kinds.pop() {
            None => number(0, "polygon"),
            Some(last) if kinds.is_empty() => last,
            Some(last) => format!("{} and {last}", kinds.join(", ")),
        }
    }
}

fn covers_a_pixel(primitive: &impl Primitive) -> bool {
    let b = primitive.bounds();
    (b.top..=b.bottom).any(|y| (b.left..=b.right).any(|x| primitive.covers(x, y)))
}
