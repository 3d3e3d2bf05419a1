//! Sums over windows of a grid.

use tilewright_hdl::{Module, Signal, bit, bits, block, grid};

/// For each lane of a grid, the sum of the three by three lanes around it, with zeros beyond the edges. The sum is 4
/// bits wider than a lane, so it never overflows.
///
/// A cellular automaton is such a sum and a rule. This one is Conway's: a cell survives with two or three neighbours,
/// and is born with three.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::window_sums;
/// # let example = tilewright_sim::traced(|m| {
/// let three_in_a_row = constants(bit().of(grid(5, 5)), |cell| matches!(cell, 11 | 12 | 13));
/// def!(begun = m.reg(1).reset(0));
/// begun.next(1);
/// def!(alive = m.reg(bit().of(grid(5, 5))).reset(0));
/// let living = window_sums(*alive); // with the cell itself
/// alive.when(!begun, three_in_a_row).otherwise(living.eq(3) | (living.eq(4) & alive));
/// def!(middle_line = alive.rows().lane(2).pack());
/// def!(middle_column = alive.columns().lane(2).pack());
/// # });
/// assert_eq!(example.values("middle_line"), [0, 0b01110, 0b00100, 0b01110]); // it blinks
/// assert_eq!(example.values("middle_column"), [0, 0b00100, 0b01110, 0b00100]);
/// ```
#[track_caller]
pub fn window_sums(cells: Signal) -> Signal {
    let cells = cells.zext(cells.width() + 4);
    let of_three = cells.rows().previous(0) + cells + cells.rows().following(0);
    of_three.columns().previous(0) + of_three + of_three.columns().following(0)
}

block! {
    /// A box filter: computes, for each cell of a grid, the sum of the three by three cells around it.
    ///
    /// ```text
    ///                above    .---.         left     .---.
    /// cells =====+==========> | + |=======+========> | + |==[ ]==> sums
    ///            |   below    |   |       | right    |   |
    ///            '==========> '---'       '========> '---'
    /// ```
    ///
    /// Latency 1 clock with `enable`. Beyond the edges there are zeros. As a function it is [`window_sums`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&BoxFilter::new(2, 3, 4))?;
    /// sim.drive(BoxFilterIn { enable: 1, cells: 0x321_f01 }); // in each row, the rightmost cell first
    /// sim.step();
    /// assert_eq!(sim.read_u64(), BoxFilterOut { sums: 0x14_16_04_14_16_04 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct BoxFilter {
        rows: u32,
        columns: u32,
        width: u32,
    }
    in(self) BoxFilterIn {
        /// Loads the sums.
        enable: bit(),
        /// The value of each cell.
        cells: bits(self.width).of(grid(self.rows, self.columns)),
    }
    out(self) BoxFilterOut {
        /// The sum of the window of each cell.
        sums: bits(self.width + 4).of(grid(self.rows, self.columns)),
    }
}

impl BoxFilter {
    /// A filter of `rows` rows and `columns` columns of cells of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::BoxFilter;
    ///
    /// assert_eq!(BoxFilter::new(4, 6, 8).name(), "box_filter_rows4_columns6_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// `rows` or `columns` is below 2, or `width` is 0.
    #[track_caller]
    pub fn new(rows: u32, columns: u32, width: u32) -> BoxFilter {
        assert!(
            rows > 1 && columns > 1 && width > 0,
            "a filter of {rows} rows and {columns} columns of {width} bits: it has 2, 2 and 1 or more"
        );
        BoxFilter { rows, columns, width }
    }

    fn build(&self, m: Module, i: BoxFilterIn) -> BoxFilterOut {
        BoxFilterOut { sums: m.pipe_when(i.enable, "sums", window_sums(i.cells)) }
    }
}
