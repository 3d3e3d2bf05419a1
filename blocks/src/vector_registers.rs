//! Registers of a processor that works on several numbers at once.

use tilewright_hdl::{Module, ReadUnderWrite, below, bits, block, def, row};

block! {
    /// The registers of a vector processor: each clock reads two, and writes the masked lanes of a third.
    ///
    /// ```text
    ///   left ==>.------------------.==> left_value
    ///  right ==>| registers[count] |==> right_value
    ///     to ==>|  lane 0 | 1 | .. |
    ///   mask ==>'------------------'<== value
    /// ```
    ///
    /// Latency 0 to read, 1 clock to write: a read returns the register's value before the write.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{VectorRegisters, VectorRegistersIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let registers = VectorRegisters::new(8, 4, 8); // 8 registers of 4 lanes of 8 bits
    /// let (seven, mask) = (lit(3, 7), lit(4, 0b0101));
    /// def!(registers = m.instance(&registers, VectorRegistersIn {
    ///     left: seven, right: lit(3, 0), to: seven, mask, value: lit(32, 0x1122_3344),
    /// }));
    /// def!(held = registers.left_value);
    /// # });
    /// assert_eq!(example.values("held"), [0, 0x0022_0044]);
    /// ```
    pub struct VectorRegisters {
        count: u32,
        lanes: u32,
        width: u32,
    }
    latency = "0 clocks to read, 1 clock to write";
    in(self) VectorRegistersIn {
        /// The first register to read.
        left: below(self.count),
        /// The second register to read.
        right: below(self.count),
        /// The register to write.
        to: below(self.count),
        /// The lanes of the register that are written: a bit for each, the lowest for lane 0.
        mask: bits(self.lanes),
        /// The values to write, lane 0 in the lowest bits.
        value: bits(self.lanes * self.width),
    }
    out(self) VectorRegistersOut {
        /// The contents of the first register to read.
        left_value: bits(self.lanes * self.width),
        /// The contents of the second register to read.
        right_value: bits(self.lanes * self.width),
    }
}

impl VectorRegisters {
    /// `count` registers, each with `lanes` lanes of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::VectorRegisters;
    ///
    /// assert_eq!(VectorRegisters::new(16, 4, 8).name(), "vector_registers_count16_lanes4_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// A parameter is too small: `count` below 2, or no lanes or bits.
    #[track_caller]
    pub fn new(count: u32, lanes: u32, width: u32) -> VectorRegisters {
        assert!(
            count > 1 && lanes > 0 && width > 0,
            "{count} registers of {lanes} lanes of {width} bits: there are 2 or more, of 1 lane of 1 bit or more"
        );
        VectorRegisters { count, lanes, width }
    }

    fn build(&self, m: Module, i: VectorRegistersIn) -> VectorRegistersOut {
        if !self.count.is_power_of_two() {
            for number in [i.left, i.right, i.to] {
                m.assume(number.lt(self.count), "the number of a register is in range");
            }
        }
        let lanes = row(self.lanes);
        def!(registers = m.memory(self.count, bits(self.width).of(lanes), ReadUnderWrite::Old));
        let registers = registers.attribute("ram_style", "distributed");
        registers.write(i.mask.unpack(lanes), i.to, i.value.unpack(lanes));
        let read = |number| registers.read_async(number).pack();
        VectorRegistersOut { left_value: read(i.left), right_value: read(i.right) }
    }
}
