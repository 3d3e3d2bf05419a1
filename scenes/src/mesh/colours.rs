//! Colours of a triangle's corners, where they differ.

use super::{Mesh, check_colour};
use crate::error::SceneError;
use std::sync::Arc;

impl Mesh {
    /// The same mesh with these diffuse colours at the corners of its triangles, instead of one for the whole triangle.
    ///
    /// ```
    /// use tilewright_scenes::builtin::teapot;
    ///
    /// let mesh = teapot::mesh(2);
    /// let (red, blue) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    /// let mesh = mesh.with_corner_colours(vec![[red, red, blue]; 256])?;
    /// assert_eq!(mesh.corner_colours(7), [red, red, blue]);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if there is not one for each triangle, or one is outside 0 to 1.
    pub fn with_corner_colours(self, colours: Vec<[[f64; 3]; 3]>) -> Result<Mesh, SceneError> {
        let (given, triangles) = (colours.len(), self.triangles.len());
        if given != triangles {
            return Err(SceneError::invalid(
                format!("{given} triangles have colours at their corners, and the mesh has {triangles}"),
                "give three to each",
            ));
        }
        for (i, corners) in colours.iter().enumerate() {
            corners.iter().try_for_each(|&colour| check_colour("triangle", i, colour))?;
        }
        Ok(Mesh { colours: Some(Arc::new(colours)), ..self })
    }

    /// The diffuse colours of a triangle's corners.
    ///
    /// # Panics
    /// If there is no such triangle.
    pub fn corner_colours(&self, triangle: usize) -> [[f64; 3]; 3] {
        match &self.colours {
            Some(colours) => colours[triangle],
            None => [self.triangles[triangle].diffuse; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::builtin::teapot;

    #[test]
    fn colours_that_fit_no_triangle_are_refused() {
        let refused = |colours| teapot::mesh(1).with_corner_colours(colours).expect_err("unsound").to_string();
        assert_eq!(
            refused(vec![[[0.0; 3]; 3]]),
            "1 triangles have colours at their corners, and the mesh has 64: give three to each"
        );
        assert_eq!(
            refused(vec![[[0.0; 3], [0.0; 3], [0.0, 2.0, 0.0]]; 64]),
            "triangle 0 of the mesh has the colour [0.0, 2.0, 0.0]: give three numbers from 0 to 1"
        );
    }

    #[test]
    fn a_checksum_counts_them() {
        let coloured = |c| teapot::mesh(1).with_corner_colours(vec![[[c; 3]; 3]; 64]).unwrap().checksum();
        assert!(coloured(0.5) != coloured(0.25) && coloured(0.5) != teapot::mesh(1).checksum());
    }
}
