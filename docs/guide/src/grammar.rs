//! Appendix E: a block with each clause and each kind of port.

use tilewright_hdl::*;

record! {
    /// Where a pixel is.
    pub struct Position(columns: u32, rows: u32) {
        /// The column.
        x: below(columns),
        /// The row.
        y: below(rows),
    }

    /// How a pixel looks.
    pub struct Colour {
        /// How bright it is.
        level: bits(6),
    }
}

block! {
    /// Has each clause and each kind of port.
    pub struct Everything {
        /// Columns of the screen.
        pub columns: u32,
        /// Rows of the screen.
        pub rows: u32,
    }
    ranges(self) {
        /// A screen is as wide as it is high, or wider.
        columns: self.rows..=4096,
        rows: 1..,
    }
    name = "everything";
    latency(self) = format!("none, whatever the {} rows are", self.rows);
    source = "Appendix E of the guide";
    in(self) EverythingIn {
        /// A width.
        enable: bit(),
        /// Lanes.
        samples: bits(8).of(row(4)),
        /// A record, with its widths.
        from: Position { x: below(self.columns), y: below(self.rows) },
        /// A record whose widths have parameters.
        to: Position::widths(self.columns, self.rows),
        /// A record whose widths an expression gives.
        middle: Position = self.middle(),
        /// A record whose widths are in its declaration.
        colour: Colour,
        /// A record that is declared here.
        job: pub struct Job {
            /// Its page.
            page: bits(4),
            /// It is the last.
            last: bit(),
        },
        /// A list of signals.
        levels: [bits(6); 3],
        /// A list of records.
        corners: [Position::widths(self.columns, self.rows); 2],
        /// A stream of a signal.
        bytes: stream(bits(8)),
        /// A stream of a record.
        moves: stream(Position::widths(self.columns, self.rows)),
        /// A list of streams.
        sources: [stream(bits(8)); 2],
    }
    out EverythingOut {
        /// A width.
        at_edge: bit(),
        /// As wide as what drives it.
        sum: _,
        /// The same, of a record.
        nearest: Position = _,
        /// The same, of a list of records.
        all: [Position] = _,
        /// The same, of a stream.
        moved: stream(Position = _),
        /// The same, of a list of streams.
        bytes_out: [stream(_)],
    }
}

impl Everything {
    /// Half of the columns and half of the rows.
    fn middle(&self) -> Position<Width> {
        Position::widths(self.columns / 2, self.rows / 2)
    }

    fn build(&self, m: Module, i: EverythingIn) -> EverythingOut {
        m.ignore(&(i.samples));
        m.ignore(&i.job);
        m.ignore(&i.middle);
        m.ignore(&i.colour);
        let corners = [i.corners[0], mux(i.enable, i.corners[1], i.to)];
        EverythingOut {
            at_edge: i.from.x.eq(0) | i.from.y.eq(0),
            sum: i.levels[0] + i.levels[1] + i.levels[2],
            nearest: mux(i.from.x.lt(i.to.x), i.from, i.to),
            all: corners.to_vec(),
            moved: i.moves,
            bytes_out: [vec![i.bytes], i.sources].concat(),
        }
    }
}

block! {
    /// Has no parameters and no inputs, and counts.
    pub struct Free;
    out = FreeOut { count: bits(4) };
}

bundle! {
    /// A record that is all outputs of a block.
    pub struct FreeOut<T> {
        /// What it counts.
        pub count: T,
    }
}

impl Free {
    fn build(&self, m: Module, (): ()) -> FreeOut {
        def!(count = m.reg(4).reset(0));
        count.next(count + 1);
        FreeOut { count: *count }
    }
}
