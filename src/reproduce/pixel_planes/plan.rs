//! What is counted and drawn for the page: everything that the figures need, or a quick look.

use super::scenes::Which;
use crate::reproduce::effort::Effort;
use tilewright_machines::pixel_planes::{Config, Regions, Study, Vectors};
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::Size;

/// Renderers, B: those of the paper's example.
pub const RENDERERS: u32 = 16;
/// The side of the paper's regions in pixels, S.
pub const SIDE: u32 = 128;
/// The vectors of the paper's example: length in pixels, degrees.
pub const LENGTH: f64 = 50.0;
pub const ANGLE: f64 = 45.0;

/// Angles at which vectors are counted, up to 45 degrees. Steeper vectors are the same with swapped axes.
const ANGLES: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];
/// Their lengths.
const LENGTHS: [f64; 10] = [5.0, 10.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0, 300.0, 400.0];
/// Sides of regions.
pub const SIDES: [u32; 4] = [32, 64, 128, 256];
/// Random vectors of each length and angle.
const COUNTED: u64 = 300_000;

/// Random vectors whose update time is measured. With this number the time to send the frame matters little.
const TIMED: u64 = 100_000;
/// Numbers of renderers for which it is measured.
const BY_RENDERERS: [u32; 11] = [1, 2, 4, 6, 8, 12, 16, 20, 24, 28, 32];

/// A run of random vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    pub renderers: u32,
    pub side: u32,
    pub vectors: u64,
    /// Bandwidth of the ring in Mbit/s.
    pub ring: u32,
    /// Whether the circuit also runs.
    pub on_hardware: bool,
}

/// The work for the page.
pub struct Plan {
    pub effort: Effort,
}

impl Plan {
    /// The screen of all frames and loads: the paper's, or one with a quarter of its width and height. The regions are then smaller, too, and
    /// their number is the same.
    pub fn regions(&self) -> Regions {
        match self.effort.is_quick() {
            false => Regions::paper(),
            true => Regions::new(Size::new(320, 256).expect("in range"), SIDE / 4).expect("in range"),
        }
    }

    /// The factor by which all lengths on that screen are smaller than the paper's.
    pub fn scale(&self) -> u32 {
        SIDE / self.regions().side()
    }

    /// The paper's vectors all over that screen, with the same length over a region's side.
    pub fn vectors(&self) -> Result<Vectors, ParameterError> {
        let regions = self.regions();
        // With smaller regions, random places leave a narrower border free.
        let fine = Regions::new(regions.size(), regions.side() / 4)?;
        Vectors::new(fine, LENGTH / f64::from(self.scale()), Some(ANGLE), self.effort.seed)
    }

    /// The machine of the paper's example on that screen.
    pub fn config(&self) -> Config {
        let regions = self.regions();
        Config { renderers: RENDERERS, side: regions.side(), ..Config::new(regions.size()) }
    }

    /// The vectors whose regions are counted. At each angle one length is that of a region along an axis. The paper's vectors are counted with
    /// regions of all sides.
    pub fn studies(&self) -> Vec<Study> {
        let vectors = self.effort.at_most(COUNTED);
        let paper = || Study { vectors, ..Study::paper(self.effort.seed) };
        let mut studies: Vec<Study> = ANGLES
            .iter()
            .map(|&angle| {
                let mut lengths = LENGTHS.to_vec();
                lengths.extend(meeting(angle));
                lengths.sort_by(f64::total_cmp);
                Study { lengths, angles: vec![angle], ..paper() }
            })
            .collect();
        studies.extend(SIDES.into_iter().filter(|side| *side != SIDE).map(|side| {
            let regions = Regions::new(Regions::paper().size(), side).expect("in range");
            Study { regions, lengths: vec![LENGTH], angles: vec![ANGLE], ..paper() }
        }));
        studies
    }

    /// Scenes whose loads are counted, for all numbers of renderers.
    pub fn scenes(&self) -> Vec<Which> {
        let names = ["teapot", "ter1k", "ter250", "wireframe", "star"].into_iter();
        // The large scene would take most of a quick look's time.
        let names = names.filter(|name| !self.effort.is_quick() || *name != "ter250");
        names.map(Which::BuiltIn).chain([Which::Vectors(self.drawn_vectors())]).collect()
    }

    /// Scenes that the hardware draws.
    pub fn frames(&self) -> Vec<Which> {
        let names: &[&str] =
            if self.effort.is_quick() { &["teapot", "star"] } else { &["teapot", "ter1k", "wireframe", "star"] };
        let scenes = names.iter().copied().map(Which::BuiltIn);
        scenes.chain([Which::Vectors(self.drawn_vectors()), Which::OneEach, Which::WholeScreen]).collect()
    }

    fn drawn_vectors(&self) -> u64 {
        self.effort.at_most(4000)
    }

    /// The runs whose update time is measured: on the model, and for some on the circuit.
    pub fn runs(&self) -> Vec<Spec> {
        let most = self.effort.at_most(TIMED);
        let rings = [Config::AMPLE_RING, Config::RING];
        let usual = Spec {
            renderers: RENDERERS,
            side: self.regions().side(),
            vectors: most,
            ring: rings[0],
            on_hardware: false,
        };
        let quick = self.effort.is_quick();
        let by_renderers = BY_RENDERERS.into_iter().filter(|it| !quick || it.is_power_of_two()).map(|renderers| {
            let on_hardware = renderers == RENDERERS || !quick && renderers == Config::MOST_RENDERERS;
            Spec { renderers, on_hardware, ..usual }
        });
        let by_side = SIDES.into_iter().filter(|side| *side != SIDE).map(|side| Spec {
            side: side / self.scale(),
            on_hardware: !quick && side < SIDE,
            ..usual
        });
        let by_vectors =
            self.crowds().into_iter().filter(|vectors| *vectors != most).map(|vectors| Spec { vectors, ..usual });
        let ample: Vec<Spec> = by_renderers.chain(by_side).chain(by_vectors).collect();
        let real = ample.iter().map(|spec| Spec { ring: rings[1], on_hardware: false, ..*spec });
        ample.iter().copied().chain(real).collect()
    }

    /// Numbers of random vectors for which the load is counted.
    pub fn crowds(&self) -> Vec<u64> {
        let decades = [100, 1000, 10_000].into_iter();
        let all = decades.flat_map(|decade| [decade, 2 * decade, 5 * decade]).chain([100_000]);
        let mut crowds: Vec<u64> = all.map(|count| self.effort.at_most(count)).collect();
        crowds.dedup();
        crowds
    }
}

/// The length at which a vector of that angle spans one of the paper's regions along its longer axis, if that length is allowed here. Both of the
/// paper's formulas meet there (PP5-HV).
pub fn meeting(angle: f64) -> Option<f64> {
    let (sine, cosine) = tilewright_scenes::angle::sin_cos(angle);
    Some(f64::from(SIDE) / sine.abs().max(cosine.abs())).filter(|length| !LENGTHS.contains(length))
}
