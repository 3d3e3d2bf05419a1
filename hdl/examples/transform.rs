//! The transform of vertices: a 4x4 matrix times a stream of vectors, in fixed-point numbers; a vector a clock.
//! `cargo run -p tilewright-hdl --example transform`

use std::collections::VecDeque;
use tilewright_hdl::*;
use tilewright_sim::{Port, Simulation};

block! {
    /// Multiplies vectors of four elements by a matrix, rounds to nearest, and saturates.
    ///
    /// ```text
    /// vectors ===>| 16 multipliers |[1]===>| 4 sums |[2]===>| round, saturate |[3]===> results
    /// ```
    pub struct Transform {
        /// The bits of an element.
        pub width: u32,
        /// The bits of a coefficient after the point.
        pub fraction: u32,
    }
    latency = "3 clocks";
    in(self) TransformIn {
        /// Stores a coefficient. Vectors that are accepted at a later edge meet it.
        write: bit(),
        /// The row of the coefficient, and its column in the lower two bits.
        place: below(16),
        /// The coefficient.
        coefficient: bits(self.width).signed(),
        /// The vectors, of four elements each.
        vectors: stream(bits(self.width).signed().of(row(4))),
    }
    out TransformOut {
        /// The products, one for each vector.
        results: stream(_),
    }
}

impl Transform {
    fn build(&self, m: Module, i: TransformIn) -> TransformOut {
        let Transform { width, fraction } = *self;
        let rows = grid(4, 4);
        def!(matrix = m.reg(bits(width).signed().of(rows)));
        matrix.when(i.write & constants(bits(4).of(rows), |place| place).eq(i.place), i.coefficient);

        def!(products = m.stream_stages(1, i.vectors, |_, vector| matrix * vector.to_rows(4)));
        def!(sums = m.stream_stages(1, products, |_, products| products.sext(2 * width + 2).columns().sum()));
        def!(
            results = m.stream_stages(1, sums, |_, sum| {
                let rounded = (sum + (1 << (fraction - 1))) >> fraction;
                let greatest = (1 << (width - 1)) - 1;
                select(
                    [(rounded.gt(greatest), greatest), (rounded.lt(-greatest - 1), -greatest - 1)],
                    rounded.trunc(width),
                )
            })
        );
        TransformOut { results }
    }
}

/// What the hardware has to compute, in numbers of 64 bits.
fn product(matrix: &[[i64; 4]; 4], vector: &[i64; 4], width: u32, fraction: u32) -> [i64; 4] {
    let limit = 1 << (width - 1);
    std::array::from_fn(|row| {
        let sum: i64 = (0..4).map(|column| matrix[row][column] * vector[column]).sum();
        (sum + (1 << (fraction - 1))).div_euclid(1 << fraction).clamp(-limit, limit - 1)
    })
}

/// Runs it; a test does so too, and runs its Verilog against it.
pub fn run() -> Result<(Design, Recording), Box<dyn std::error::Error>> {
    let transform = Transform { width: 16, fraction: 8 };
    let mut sim = Simulation::of(&transform)?;
    let recording = sim.recording();
    let (i, o) = (sim.i, sim.o);
    sim.reset();

    let mut state = 1u64;
    let mut below = |limit: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % limit
    };
    let (mut matrix, mut expected, mut saturated) = ([[0; 4]; 4], VecDeque::new(), 0);
    let mut offered = None;
    for clock in 0..2000 {
        // The matrix is complete before the first vector, and changes while others are under way. Pauses come later.
        let (write, place) = if clock < 16 { (true, clock) } else { (below(5) == 0, below(16)) };
        // Small numbers, any number, and the two ends of the range, where a sum saturates.
        let mut number = || match below(4) {
            0 => below(1024) as i64 - 512,
            1 => [-0x8000, 0x7fff][below(2) as usize],
            _ => below(0x10000) as i64 - 0x8000,
        };
        let (coefficient, vector) = (number(), [(); 4].map(|()| number()));
        let without_pauses = clock < 100;
        if offered.is_none() && clock >= 16 && (without_pauses || below(3) != 0) {
            offered = Some(vector);
        }
        sim.set(i.write, write);
        sim.set(i.place, place);
        sim.set(i.coefficient, coefficient);
        sim.set(i.vectors.valid, offered.is_some());
        sim.set_lanes(i.vectors.payload, offered.unwrap_or_default());
        sim.set(o.results.ready, without_pauses || below(4) != 0);

        // What happens at the next edge.
        let mut moves =
            |stream: Stream<Port, Port>| [stream.valid, stream.ready].iter().all(|port| sim.get_u64(*port) == 1);
        let (enters, leaves) = (moves(i.vectors), moves(o.results));
        if let Some(vector) = offered.take_if(|_| enters) {
            expected.push_back((clock, product(&matrix, &vector, 16, 8)));
        }
        if leaves {
            let result: Vec<_> =
                sim.lanes(o.results.payload).into_iter().map(|word| i64::from(word as u16 as i16)).collect();
            let (entered, wanted) = expected.pop_front().ok_or("a result came of nothing")?;
            assert_eq!(result, wanted, "clock {clock}");
            assert!(
                clock == entered + 3 || !without_pauses && clock > entered + 3,
                "clock {clock}: not 3 after {entered}"
            );
            saturated += wanted.iter().filter(|it| [-0x8000, 0x7fff].contains(*it)).count();
        }
        if write {
            matrix[place as usize / 4][place as usize % 4] = coefficient;
        }
        sim.step();
    }
    assert!(expected.len() <= 3 && saturated > 100, "{} are left, {saturated} saturated", expected.len());
    Ok((elaborate(&transform)?, recording.take()))
}

/// Runs it, and prints its Verilog.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files = tilewright_gen::verilog(&run()?.0);
    files.iter().for_each(|file| print!("{}", file.text));
    Ok(())
}
