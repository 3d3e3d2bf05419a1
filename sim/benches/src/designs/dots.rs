//! Products of pairs, and their sum: a block of many ports.

use tilewright_hdl::{Block, Module, Width, bits, bundle};

bundle! {
    /// The inputs of [`Dots`].
    pub struct DotsIn<T> {
        /// One of each pair.
        pub left: Vec<T>,
        /// The other.
        pub right: Vec<T>,
    }

    /// The outputs of [`Dots`].
    pub struct DotsOut<T> {
        /// Of the clock before.
        pub products: Vec<T>,
        /// Of the products.
        pub sum: T,
    }
}

/// Multiplies pairs of bytes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Dots {
    /// How many pairs, at least 1.
    pub pairs: u32,
}

impl Block for Dots {
    type In = DotsIn;
    type Out = DotsOut;

    fn inputs(&self) -> DotsIn<Width> {
        let side = || vec![bits(8); self.pairs as usize];
        DotsIn { left: side(), right: side() }
    }

    fn build(&self, m: Module, i: DotsIn) -> DotsOut {
        let products: Vec<_> = i.left.iter().zip(&i.right).map(|(left, right)| left.times(*right)).collect();
        let products = m.pipe("product", products);
        let sum = products.iter().map(|product| product.zext(32)).reduce(|all, product| all + product);
        DotsOut { products, sum: sum.expect("there is a pair") }
    }
}
