//! Products of pairs, and their sum: a block of many ports.

use tilewright_hdl::{Module, bits, block};

block! {
    /// Multiplies pairs of bytes.
    pub struct Dots {
        /// The number of pairs, at least 1.
        pub pairs: u32,
    }
    in(self) DotsIn {
        /// The first factor of each pair.
        left: [bits(8); self.pairs],
        /// The second factor of each pair.
        right: [bits(8); self.pairs],
    }
    out(self) DotsOut {
        /// The products, one clock later.
        products: [bits(16); self.pairs],
        /// The sum of the products.
        sum: bits(32),
    }
}

impl Dots {
    fn build(&self, m: Module, i: DotsIn) -> DotsOut {
        let products: Vec<_> = i.left.iter().zip(&i.right).map(|(left, right)| left.times(*right)).collect();
        let products = m.pipe("product", products);
        let sum = products.iter().map(|product| product.zext(32)).reduce(|all, product| all + product);
        DotsOut { products, sum: sum.expect("there is a pair") }
    }
}
