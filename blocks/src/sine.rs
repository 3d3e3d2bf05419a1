//! Sines and cosines, by a CORDIC.

use crate::ports::StreamIn;
use tilewright_hdl::{Module, Signal, bits, block, bundle, cat, hex, lit, mux, stream};

/// The angles whose tangents are 1, 1/2, 1/4 .., in units of 2^-32 of a circle.
const ANGLES: [u64; 24] = [
    0x2000_0000,
    0x12e4_051e,
    0x09fb_385b,
    0x0511_11d4,
    0x028b_0d43,
    0x0145_d7e1,
    0x00a2_f61e,
    0x0051_7c55,
    0x0028_be53,
    0x0014_5f2f,
    0x000a_2f98,
    0x0005_17cc,
    0x0002_8be6,
    0x0001_45f3,
    0x0000_a2fa,
    0x0000_517d,
    0x0000_28be,
    0x0000_145f,
    0x0000_0a30,
    0x0000_0518,
    0x0000_028c,
    0x0000_0146,
    0x0000_00a3,
    0x0000_0051,
];

/// The inverse of the factor by which all rotations together lengthen a vector, in units of 2^-32.
const SHORTER: u64 = 0x9b74_eda8;

/// Extra bits below those of the results, for the rounding of each rotation.
const GUARD: u32 = 5;

bundle! {
    /// A vector that is being rotated.
    struct Turning<T> {
        x: T,
        y: T,
        /// The remaining angle.
        angle: T,
    }
}

block! {
    /// Computes the cosine and the sine of angles, by rotating a vector by smaller and smaller angles: a CORDIC.
    ///
    /// ```text
    /// angle ===>| by 1/8 circle |[1]===>| by atan 1/2 |[2]===>| by atan 1/4 |[3]===> .. points
    /// ```
    ///
    /// The full circle is 2^`width`. The value 1 is represented as a quarter of that range. So with 16 bits the angle
    /// `0x2000` is an eighth of a circle, and its sine is 0.7071 * 16384 = 11585, give or take 2. Latency `width`
    /// clocks, one point per clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{SineCosine, StreamIn};
    /// # tilewright_sim::example(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(16, 0x2000));
    /// def!(sine = m.instance(&SineCosine::new(16), StreamIn { into }));
    /// let point = sine.points.take_when(1);
    /// let near = point.sine.ge(11583) & point.sine.le(11587);
    /// m.assert(point.taken.implies(near), "half the root of two");
    /// # });
    /// ```
    pub struct SineCosine {
        width: u32,
    }
    latency(self) = format!("{} clocks", self.width);
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) SineCosineOut {
        /// The points of the circle; a quarter of the range stands for 1.
        ///
        /// ```
        /// # use tilewright_blocks::OnCircle;
        /// let east = OnCircle { cosine: 64, sine: 0 };
        /// assert_eq!(east.cosine * east.cosine + east.sine * east.sine, 64 * 64);
        /// ```
        points: stream(pub struct OnCircle {
            /// The cosine, signed.
            cosine: bits(self.width).signed(),
            /// The sine, signed.
            sine: bits(self.width).signed(),
        }),
    }
}

impl SineCosine {
    /// Angles and results of `width` bits, from 4 to 24.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::SineCosine;
    ///
    /// assert_eq!(SineCosine::new(16).name(), "sine_cosine_width16");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is out of range.
    #[track_caller]
    pub fn new(width: u32) -> SineCosine {
        assert!((4..=24).contains(&width), "a sine of {width} bits: it has from 4 to 24");
        SineCosine { width }
    }

    fn build(&self, m: Module, i: StreamIn) -> SineCosineOut {
        let wide = self.width + GUARD;
        let rounded = |number: u64, places: u32| (number >> (places - 1)).div_ceil(2);
        let angle = *i.into;
        // The rotations reach every point of the right half of the circle. For the left half, start at the opposite
        // point.
        let is_left = angle.msb() ^ angle.bit(self.width - 2);
        let one = lit(wide, rounded(SHORTER, 34 - wide)).signed();
        let start = Turning {
            x: mux(is_left, -one, one),
            y: lit(wide, 0).signed(),
            angle: cat![angle.msb() ^ is_left, angle.trunc(self.width - 1), lit(GUARD, 0)].signed(),
        };
        let turned = m.stream_stages(self.width, i.into.with(start), |stage, at| {
            let (Turning { x, y, angle }, places) = (at, stage - 1);
            let by = hex(rounded(ANGLES[places as usize], 32 - wide));
            let back = angle.is_negative();
            Turning {
                x: mux(back, x + (y >> places), x - (y >> places)),
                y: mux(back, y - (x >> places), y + (x >> places)),
                angle: mux(back, angle + by, angle - by),
            }
        });
        let near = |number: Signal| (number + (1u64 << (GUARD - 1))).slice(GUARD..wide).signed();
        SineCosineOut { points: turned.with(OnCircle { cosine: near(turned.x), sine: near(turned.y) }) }
    }
}
