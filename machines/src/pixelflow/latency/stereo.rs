//! The latency of frames for two eyes, by the paper's formulas.
//!
//! In a halved machine, each frame is that of a smaller machine. One after another, the times are: F of the front end, P of the instructions made during
//! rasterization, R of rasterization, C of composition, L of loading the frame buffer, and B of the longest stage behind the front end.
//!
//! | system | one frame | end of the second frame |
//! |---|---|---|
//! | base | `F + B` | `max(2 F, F + B) + B`: its front end runs beside the first one's stages, and each stage follows its own |
//! | pre-sorting | `F + B` | `max(2 F + P, F + B) + B`: its front end waits until the first one's instructions are made |
//! | non-texturing | `t + max(C, L)`, `t = max(F, R) + (s - 1)(R + C)` | `u + max(C, L)`, `u = max(t + max(C, L), max(t + C + R, 2 F) + (s - 1)(R + C))`: it is drawn when the pixels are free |

use super::super::stereo::Stereo;
use super::{Samples, Software, System, Times};

impl Software {
    /// Milliseconds from the beginning to both eyes' frames, each of that number of primitives.
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Nodes, Samples, Software, Stereo, System};
    ///
    /// let base = Software::paper(System::Base, Nodes::paper(4), Samples::One);
    /// let both = |primitives, stereo| format!("{:.2}", base.stereo_latency(primitives, stereo));
    /// // The least latency: one after another the frame buffer is written twice.
    /// assert_eq!([Stereo::Halved, Stereo::Sequential].map(|stereo| both(0.0, stereo)), ["2.31", "4.26"]);
    /// // With many primitives, front end and rasterizers of a whole machine work at the same time on a frame each.
    /// assert_eq!([Stereo::Halved, Stereo::Sequential].map(|stereo| both(50_000.0, stereo)), ["20.70", "15.98"]);
    /// ```
    ///
    /// # Panics
    /// A half has no rasterizer.
    pub fn stereo_latency(&self, primitives: f64, stereo: Stereo) -> f64 {
        let one = Software { nodes: stereo.nodes(self.nodes), ..*self };
        match stereo {
            Stereo::Halved => one.latency(primitives),
            Stereo::Sequential => one.second_frame(primitives),
        }
    }

    /// The end of a second frame that begins as soon as possible.
    fn second_frame(&self, primitives: f64) -> f64 {
        let Times { front, generate, rasterize, compose, shade, load } = self.times(primitives);
        let stages = [generate, rasterize, compose, shade, load].into_iter().fold(0.0, f64::max);
        match self.system {
            System::Base | System::PreSort => (2.0 * front + generate).max(front + stages) + stages,
            System::NonTexturing => {
                let more = if self.samples == Samples::One { 0.0 } else { 7.0 };
                let (rest, ends) = (more * (rasterize + compose), compose.max(load));
                let drawn = front.max(rasterize) + rest;
                let again = (drawn + compose + rasterize).max(2.0 * front) + rest;
                again.max(drawn + ends) + ends
            }
        }
    }

    /// The number of primitives of each eye from which on frames one after another are ready sooner than both at once on halves of the nodes; `None`
    /// if they never are.
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Nodes, Samples, Software, System};
    ///
    /// let from = |system, shaders| Software::paper(system, Nodes::paper(shaders), Samples::One).sequential_from();
    /// let thousand = |primitives: Option<f64>| primitives.map(|it| (it / 1000.0).round());
    /// assert_eq!(thousand(from(System::Base, 4)), Some(14.0));
    /// ```
    ///
    /// # Panics
    /// As [`Software::stereo_latency`].
    pub fn sequential_from(&self) -> Option<f64> {
        const MOST: f64 = 1e9;
        let [halved, sequential] = [Stereo::Halved, Stereo::Sequential]
            .map(|stereo| move |primitives: f64| self.stereo_latency(primitives, stereo));
        let is_slower = |primitives: f64| sequential(primitives) > halved(primitives);
        (!is_slower(MOST)).then(|| super::last_that(MOST, is_slower))
    }
}
