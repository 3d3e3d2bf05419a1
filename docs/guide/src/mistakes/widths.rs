//! Chapter 3: a dozen mistakes with widths and numbers.

use tilewright_hdl::*;

block! {
    /// Is wrong in each line.
    pub struct Widths;
    in WidthsIn { a: bits(8), b: bits(7), level: bits(8).signed() }
    out WidthsOut { out: bits(4) }
}

impl Widths {
    fn build(&self, m: Module, i: WidthsIn) -> WidthsOut {
        let _ = i.a + i.b;
        let _ = i.a + 256;
        let _ = i.b + -1;
        let _ = i.a.lt(i.level);
        let _ = i.a.trunc(9);
        let _ = i.a.zext(7);
        let _ = i.a.slice(4..9);
        let _ = mux(i.a, i.b, 0);
        let _ = lit(0, 5);
        def!(count = m.reg(4).reset(16));
        count.next(i.b);
        WidthsOut { out: i.b }
    }
}
