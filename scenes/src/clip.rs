//! Clipping in view space: cuts a polygon or a line at the near plane and, where it leaves the guard band, at that.
//!
//! Source: facts E0 (vertices are 16 bits of 1/16 pixel, so the front end clips); the method is Sutherland and
//! Hodgman's, 1974. An edge is always cut from its inner end to its outer one. So two triangles that share an edge get
//! the same new vertex.

use glam::{DVec2, DVec3};

/// A vertex in view space: (right, down, forward) of the eye, and its attributes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ViewVertex {
    pub(crate) at: DVec3,
    /// The lit colour, each channel 0 to 1.
    pub(crate) rgb: DVec3,
    /// The colour before lighting.
    pub(crate) diffuse: DVec3,
    /// The normal in view space, on the eye's side; its length is 1 where nothing was cut.
    pub(crate) normal: DVec3,
    /// Texture coordinates.
    pub(crate) uv: DVec2,
}

/// A plane of view space; a point is inside if `normal . p >= offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipPlane {
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
}

impl ClipPlane {
    /// How far inside a point is; negative outside.
    pub(crate) fn inside_by(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }

    /// The part of a convex polygon inside the plane; empty if none.
    pub(crate) fn clip(&self, polygon: &[ViewVertex]) -> Vec<ViewVertex> {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (d, e) = (self.inside_by(from.at), self.inside_by(to.at));
            if d >= 0.0 {
                kept.push(from);
            }
            if d >= 0.0 && e < 0.0 {
                kept.push(cut(from, d, to, e));
            } else if d < 0.0 && e >= 0.0 {
                kept.push(cut(to, e, from, d));
            }
        }
        kept
    }

    /// The part of a line inside the plane; `None` if there is none.
    pub(crate) fn clip_line(&self, [p, q]: [ViewVertex; 2]) -> Option<[ViewVertex; 2]> {
        let (d, e) = (self.inside_by(p.at), self.inside_by(q.at));
        match (d >= 0.0, e >= 0.0) {
            (true, true) => Some([p, q]),
            (true, false) => Some([p, cut(p, d, q, e)]),
            (false, true) => Some([cut(q, e, p, d), q]),
            (false, false) => None,
        }
    }
}

/// The point where the edge from `inner` (inside by d) to `outer` (by e, negative) meets the plane.
fn cut(inner: ViewVertex, d: f64, outer: ViewVertex, e: f64) -> ViewVertex {
    let t = d / (d - e);
    ViewVertex {
        at: inner.at + (outer.at - inner.at) * t,
        rgb: inner.rgb + (outer.rgb - inner.rgb) * t,
        diffuse: inner.diffuse + (outer.diffuse - inner.diffuse) * t,
        normal: inner.normal + (outer.normal - inner.normal) * t,
        uv: inner.uv + (outer.uv - inner.uv) * t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vertex() -> impl Strategy<Value = ViewVertex> {
        [-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64].prop_map(|at| ViewVertex {
            at: DVec3::from_array(at),
            rgb: DVec3::from_array(at.map(|c| (c + 9.0) / 18.0)),
            diffuse: DVec3::from_array(at.map(|c| (9.0 - c) / 18.0)),
            normal: DVec3::from_array(at.map(|c| c / 9.0)),
            uv: DVec2::new(at[0], at[1]),
        })
    }

    #[test]
    fn a_cut_has_the_place_and_the_attributes_at_which_the_edge_meets_the_plane() {
        let plane = ClipPlane { normal: DVec3::Z, offset: 2.0 };
        // Normal and texture coordinates are interpolated like the colour.
        let vertex = |at: [f64; 3], rgb: [f64; 3]| ViewVertex {
            at: at.into(),
            rgb: rgb.into(),
            diffuse: [rgb[2], rgb[0], rgb[1]].into(),
            normal: [rgb[1], -rgb[2], rgb[0]].into(),
            uv: [8.0 * rgb[2], -2.0 * rgb[0]].into(),
        };
        let inner = vertex([0.0, 0.0, 6.0], [1.0, 0.0, 0.5]);
        let outer = [vertex([8.0, 0.0, -2.0], [0.5, 1.0, 0.0]), vertex([0.0, 16.0, -10.0], [0.0, 0.0, 1.0])];
        // Half of one edge is inside, and a quarter of the other.
        let cuts = [vertex([4.0, 0.0, 2.0], [0.75, 0.5, 0.25]), vertex([0.0, 4.0, 2.0], [0.75, 0.0, 0.625])];
        assert_eq!(plane.clip(&[inner, outer[0], outer[1]]), [inner, cuts[0], cuts[1]]);
        assert_eq!(plane.clip_line([inner, outer[0]]), Some([inner, cuts[0]]));
        assert_eq!(plane.clip_line([outer[1], inner]), Some([cuts[1], inner]));
        assert_eq!(plane.clip_line([inner, cuts[0]]), Some([inner, cuts[0]]));
        assert_eq!(plane.clip_line(outer), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

        /// Two triangles run along a shared edge in opposite directions; they must get exactly the same new vertices.
        #[test]
        fn an_edge_is_cut_alike_from_both_sides(corners in [vertex(), vertex(), vertex()], normal in vertex(), offset in -3.0..3.0f64) {
            let plane = ClipPlane { normal: normal.at, offset };
            let [p, q, r] = corners;
            let mut other = plane.clip(&[r, q, p]);
            other.reverse();
            let one = plane.clip(&corners);
            let inside = corners.iter().filter(|corner| plane.inside_by(corner.at) >= 0.0).count();
            prop_assert_eq!(one.len(), [0, 3, 4, 3][inside]);
            prop_assert_eq!(one.len(), other.len());
            for vertex in one {
                prop_assert!(other.contains(&vertex), "{:?} against {:?}", vertex, other);
            }
        }
    }
}
