//! Chapter 13: a renderer of triangles.

use tilewright_hdl::*;

bundle! {
    /// A linear function over the screen.
    pub struct Linear<T> {
        /// What it grows by from pixel to pixel.
        pub x: T,
        /// What it grows by from row to row.
        pub y: T,
        /// What it is at the first pixel.
        pub origin: T,
    }
}

impl Linear<Width> {
    /// Of numbers of that width.
    pub fn widths(width: Width) -> Linear<Width> {
        Linear { x: width, y: width, origin: width }
    }
}

bundle! {
    /// A triangle as linear functions.
    pub struct Triangle<T> {
        /// Its edges, three lanes: a pixel where none is negative is inside.
        pub edges: Linear<T>,
        /// Its depth, with 16 bits of fraction.
        pub depth: Linear<T>,
        /// Blue, green and red, three lanes, with 16 bits of fraction.
        pub colours: Linear<T>,
    }
}

impl Triangle<Width> {
    /// How wide its numbers are.
    pub fn widths() -> Triangle<Width> {
        Triangle {
            edges: Linear::widths(bits(32).signed().of(row(3))),
            depth: Linear::widths(bits(40)),
            colours: Linear::widths(bits(24).of(row(3))),
        }
    }
}

block! {
    /// Draws triangles: looks at a pixel in each clock, and keeps what is nearest.
    pub struct Renderer {
        /// Pixels in a row.
        pub width: u32,
        /// Rows.
        pub height: u32,
        /// What a pixel is before anything is drawn: depth above red, green and blue.
        pub blank: u64,
    }
    in RendererIn {
        /// Draws the triangle, unless another one is being drawn.
        start: bit(),
        /// The triangle.
        triangle: Triangle = Triangle::widths(),
    }
    out RendererOut {
        /// A triangle is being drawn.
        busy: bit(),
    }
}

impl Renderer {
    fn build(&self, m: Module, i: RendererIn) -> RendererOut {
        // Where it is on the screen.
        def!(busy = m.reg(bit()).reset(0));
        def!(pixel = m.reg(below(self.width * self.height)).reset(0));
        def!(column = m.reg(below(self.width)).reset(0));
        def!(begins = i.start & !busy);
        def!(row_ends = busy & column.eq(self.width - 1));
        def!(ends = busy & pixel.eq(self.width * self.height - 1));
        busy.when(begins, 1).when(ends, 0);
        pixel.when(ends, 0).when(busy, pixel + 1);
        column.when(row_ends, 0).when(busy, column + 1);

        // What each linear function is there.
        def!(drawn = m.reg(Triangle::widths()).when(begins, i.triangle));
        let walk = |name: &str, width: Width, first: Linear, steps: Linear| {
            let row = m.reg(&format!("{name}_row"), width);
            row.when(begins, first.origin).when(row_ends, row + steps.y);
            let here = m.reg(name, width);
            here.when(begins, first.origin).when(row_ends, row + steps.y).when(busy, here + steps.x);
            *here
        };
        let widths = Triangle::widths();
        let edges = walk("edges", widths.edges.x, i.triangle.edges, drawn.edges);
        let depth = walk("depth", widths.depth.x, i.triangle.depth, drawn.depth);
        let colours = walk("colours", widths.colours.x, i.triangle.colours, drawn.colours);

        // Reads the pixel, and a clock later writes it if the fragment is nearer.
        def!(frame = m.memory(self.width * self.height, 48, ReadUnderWrite::Any).fill(self.blank));
        def!(kept = frame.read(pixel));
        def!(inside_triangle = m.reg(bit()).reset(0));
        inside_triangle.next(busy & !edges.is_negative().or_all());
        def!(fragment = m.pipe(cat![depth.part(16, 24), colours.part(16, 8).pack()]));
        def!(to = m.pipe(*pixel));
        frame.write(inside_triangle & fragment.lt(kept), to, fragment);
        RendererOut { busy: *busy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::{Frame, Scene, Size, compare, frame::blank, golden};
    use tilewright_sim::Simulation;

    /// Draws a part of a scene's triangles: the frame, and how many clocks it took.
    fn draw(triangles: &[tilewright_scenes::Triangle], size: Size, background: [u8; 3]) -> (Frame, u64) {
        let renderer = Renderer { width: size.width(), height: size.height(), blank: blank(background) };
        let mut sim = Simulation::of(&renderer).unwrap().seeded(1);
        let Triangle { edges, depth, colours } = sim.i.triangle;
        let mut clocks = 0;
        for triangle in triangles {
            sim.set_lanes(edges.x, triangle.edges.map(|edge| i64::from(edge.a)));
            sim.set_lanes(edges.y, triangle.edges.map(|edge| i64::from(edge.b)));
            sim.set_lanes(edges.origin, triangle.edges.map(|edge| i64::from(edge.c)));
            let [red, green, blue] = triangle.rgb;
            sim.set_lanes(colours.x, [blue, green, red].map(|plane| plane.x));
            sim.set_lanes(colours.y, [blue, green, red].map(|plane| plane.y));
            sim.set_lanes(colours.origin, [blue, green, red].map(|plane| plane.origin));
            sim.set(depth.x, triangle.z.x);
            sim.set(depth.y, triangle.z.y);
            sim.set(depth.origin, triangle.z.origin);
            sim.set(sim.i.start, 1);
            sim.step();
            sim.set(sim.i.start, 0);
            clocks += 1 + sim.run_until(sim.o.busy.is(0), 1_000_000).expect("a triangle ends");
        }
        sim.run(2); // the last pixel is written
        let words = sim.peek_words("frame").unwrap().iter().map(|word| word.to_u64().unwrap()).collect();
        (Frame::from_words(size, words).unwrap(), clocks)
    }

    #[test]
    fn the_frame_is_the_golden_one() {
        let scene = Scene::builtin("star").unwrap();
        let size = Size::new(64, 48).unwrap();
        let triangles = tilewright_scenes::project(&scene, size).unwrap().triangles;
        let (frame, clocks) = draw(&triangles, size, scene.background);
        assert!(compare(&frame, &golden::render(size, &triangles, scene.background)).is_equal());
        assert_eq!(clocks, triangles.len() as u64 * (64 * 48 + 1));
    }

    #[test]
    fn two_renderers_draw_the_same_frame() {
        let scene = Scene::builtin("star").unwrap();
        let size = Size::new(64, 48).unwrap();
        let triangles = tilewright_scenes::project(&scene, size).unwrap().triangles;
        let halves = [0, 1].map(|half| {
            let mine: Vec<_> = triangles.iter().skip(half).step_by(2).cloned().collect();
            draw(&mine, size, scene.background).0
        });
        let merged = halves[0].words.iter().zip(&halves[1].words).map(|(left, right)| *left.min(right)).collect();
        let merged = Frame::from_words(size, merged).unwrap();
        assert!(compare(&merged, &golden::render(size, &triangles, scene.background)).is_equal());
    }
}
