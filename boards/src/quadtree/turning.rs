//! A turning scene as packets, set up ahead in the integer contract of the machines, and its golden pictures.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::format::Format;
use tilewright_rtl::quadtree::precision::Precision;
use tilewright_scenes::golden::visit_fragments;
use tilewright_scenes::{
    Camera, Counts, Light, PixelBox, Plane, Polygon, Polygons, Scene, ScreenVertex, Size, Triangle, project, set_up,
    signed_area2,
};

/// A scene that turns round the target of its camera, in steps.
#[derive(Debug, Clone)]
pub struct Turning {
    /// The scene at the first step.
    pub scene: Scene,
    /// The number of steps.
    pub steps: u32,
    /// The mesh is closed, with its corners counter-clockwise as seen from outside. Then faces that look away are left out.
    pub is_closed: bool,
    /// The degrees from the first step to where it begins again: 360, or less if the scene then looks the same.
    pub degrees: f64,
}

/// The packets of one step.
///
/// [The page of the precision](Precision) says what is cut off their coefficients. A packet of which no pixel is visible
/// is left out.
#[derive(Debug, Clone)]
pub struct Step {
    /// The packets, in the sequence in which they are drawn.
    pub packets: Vec<Triangle>,
    size: Size,
    precision: Precision,
    background: [u8; 3],
}

impl Turning {
    /// The packets of all steps for a machine.
    ///
    /// # Errors
    ///
    /// The scene has no picture, or a number of a packet needs more bits than the machine has.
    pub fn set_up(&self, format: &Format) -> Result<Vec<Step>, ParameterError> {
        (0..self.steps).map(|step| self.step(format, step)).collect()
    }

    fn step(&self, format: &Format, number: u32) -> Result<Step, ParameterError> {
        let failed = |problem: String| ParameterError(format!("step {number} of the scene: {problem}"));
        let scene = self.turned(self.degrees * f64::from(number) / f64::from(self.steps));
        let size =
            Size::new(format.screen().width, format.screen().height).map_err(|error| failed(error.to_string()))?;
        let projection = project(&scene, size).map_err(|error| failed(error.to_string()))?;
        let precision = format.precision();
        let set_up = |vertices: &[ScreenVertex; 3]| set_up(&vertices.map(within_margins), size);
        let faces = projection.vertices.iter().filter(|vertices| !self.is_closed || signed_area2(vertices) < 0);
        let packets = faces.filter_map(set_up).map(|packet| cut(packet, precision)).collect();
        let mut step = Step { packets, size, precision, background: self.scene.background };
        step.leave_out_hidden();
        step.packets.iter().try_for_each(|packet| fits(packet, format)).map_err(failed)?;
        Ok(step)
    }

    /// The scene as the camera sees it from there. The lights turn along, so that the scene seems to turn under them.
    fn turned(&self, degrees: f64) -> Scene {
        let mut scene = self.scene.clone();
        let Camera { target, .. } = scene.camera;
        let turned = |light: &Light| {
            let toward = Camera { eye: target + light.toward, ..scene.camera }.orbited(degrees).eye - target;
            Light { toward, ..*light }
        };
        scene.lighting.lights = scene.lighting.lights.iter().map(turned).collect();
        scene.camera = scene.camera.orbited(degrees);
        scene
    }
}

impl Step {
    /// The stored word of each pixel, from the upper left: the least word of the golden rasterizer's fragments, each cut
    /// to what the machine stores.
    pub fn golden(&self) -> Vec<u64> {
        let blank = self.precision.stored(tilewright_scenes::frame::blank(self.background));
        self.front().into_iter().map(|front| front.map_or(blank, |(word, _)| word)).collect()
    }

    /// The golden picture: rows of red, green and blue, each with the bits that the machine stores of a channel.
    ///
    /// # Panics
    ///
    /// Never: a picture has a width.
    pub fn golden_rows(&self) -> Vec<Vec<[u8; 3]>> {
        let colour = |word: &u64| {
            let channel =
                |number: u32| (word >> (self.precision.colour * number) & ((1 << self.precision.colour) - 1)) as u8;
            [channel(2), channel(1), channel(0)]
        };
        let words = self.golden();
        words.chunks(self.size.width() as usize).map(|row| row.iter().map(colour).collect()).collect()
    }

    /// The word of each pixel with the number of its packet, where there is one. Of equal words the first counts.
    fn front(&self) -> Vec<Option<(u64, usize)>> {
        let mut front = vec![None; self.size.pixels()];
        let all = PixelBox { left: 0, top: 0, right: self.size.width() - 1, bottom: self.size.height() - 1 };
        let polygons = Polygons {
            size: self.size,
            polygons: self.packets.iter().cloned().map(Polygon::from).collect(),
            vertices: Vec::new(),
            spheres: Vec::new(),
            counts: Counts::default(),
        };
        for number in 0..self.packets.len() {
            visit_fragments(&polygons, number, &all, |pixel, word| {
                let kept = &mut front[pixel as usize];
                let word = self.precision.stored(word);
                if kept.is_none_or(|(least, _)| word < least) {
                    *kept = Some((word, number));
                }
            });
        }
        front
    }

    fn leave_out_hidden(&mut self) {
        let mut visible = vec![false; self.packets.len()];
        self.front().into_iter().flatten().for_each(|(_, number)| visible[number] = true);
        let mut visible = visible.into_iter();
        self.packets.retain(|_| visible.next() == Some(true));
    }
}

/// The vertex with its depth and colour a little away from their limits. What is cut off coefficients cannot carry a
/// number past 0 then.
fn within_margins(vertex: ScreenVertex) -> ScreenVertex {
    let ScreenVertex { z, rgb, .. } = vertex;
    let inner = |channel: u8| (u32::from(channel) * 31 / 32 + 4) as u8;
    ScreenVertex { z: z / 8 * 7 + (1 << 20), rgb: rgb.map(inner), ..vertex }
}

/// The packet without the lower bits of its coefficients.
fn cut(packet: Triangle, precision: Precision) -> Triangle {
    let cut = |plane: Plane, bits: u32| {
        let upper = |number: u64| number >> bits << bits;
        Plane { x: upper(plane.x), y: upper(plane.y), origin: upper(plane.origin) }
    };
    let rgb = packet.rgb.map(|plane| cut(plane, precision.cut_of_colour()));
    Triangle { z: cut(packet.z, precision.cut_of_depth()), rgb, ..packet }
}

/// Checks that each number of a packet fits the machine, wherever it divides windows.
fn fits(packet: &Triangle, format: &Format) -> Result<(), String> {
    let Precision { slope, edge, .. } = format.precision();
    let fits = |number: i64, bits: u32| (-(1_i64 << (bits - 1))..1 << (bits - 1)).contains(&number);
    let matrix = format.matrix();
    let [right, bottom] = [matrix.columns(), matrix.rows()].map(|spacing| i64::from(spacing << format.levels()) - 1);
    for function in &packet.edges {
        let [a, b, c] = [function.a, function.b, function.c].map(i64::from);
        if !fits(a, slope) || !fits(b, slope) {
            return Err(format!("an edge with the slopes {a} and {b} needs more than {slope} bits"));
        }
        let corners = [(0, 0), (right, 0), (0, bottom), (right, bottom)];
        if let Some((x, y)) = corners.into_iter().find(|(x, y)| !fits(a * x + b * y + c, edge)) {
            let value = a * x + b * y + c;
            return Err(format!("an edge function is {value} at pixel ({x}, {y}), which needs more than {edge} bits"));
        }
    }
    Ok(())
}
