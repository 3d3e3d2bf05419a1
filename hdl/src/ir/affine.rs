//! The rule by which a lane takes its value from another lane.

/// Lane `i` is lane `floor((mul * i + add) / div)` of the operand, computed in 64 bits: a neighbour, every second lane,
/// the lanes in reverse, the parent in a tree.
///
/// ```
/// # use tilewright_hdl::*;
/// use tilewright_hdl::ir::Affine;
///
/// let parent = Affine { mul: 1, add: -1, div: 2 };
/// assert_eq!([0, 1, 2, 3, 4].map(|lane| parent.at(lane)), [-1, 0, 0, 1, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Affine {
    /// What a lane's index is multiplied by.
    pub mul: i32,
    /// What is added to the product.
    pub add: i32,
    /// What the sum is divided by, at least 1; the quotient is rounded towards minus infinity.
    pub div: u32,
}

impl Affine {
    /// Lane `i` is lane `i + by`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// // What `previous` is: lane 3 is lane 2, and lane 0 comes from beyond the ends.
    /// let previous = Affine::shift(-1);
    /// assert_eq!([3, 0].map(|lane| previous.source(lane, 4)), [Some(2), None]);
    /// ```
    pub fn shift(by: i32) -> Affine {
        Affine { mul: 1, add: by, div: 1 }
    }

    /// Where lane `lane` comes from, also if there is no such lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// let reversed = Affine { mul: -1, add: 3, div: 1 };
    /// assert_eq!([0, 3, 4].map(|lane| reversed.at(lane)), [3, 0, -1]);
    /// ```
    pub fn at(self, lane: u32) -> i64 {
        // From -2 to the 63 on, and below it.
        (i64::from(self.mul) * i64::from(lane) + i64::from(self.add)).div_euclid(i64::from(self.div.max(1)))
    }

    /// The lane of an operand of `extent` lanes that lane `lane` comes from; `None` if it comes from beyond the ends.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// let doubled = Affine { mul: 2, add: 0, div: 1 };
    /// assert_eq!([0, 1, 2].map(|lane| doubled.source(lane, 4)), [Some(0), Some(2), None]);
    /// ```
    pub fn source(self, lane: u32, extent: u32) -> Option<u32> {
        u32::try_from(self.at(lane)).ok().filter(|&from| from < extent)
    }

    /// Whether each of `lanes` lanes comes from a lane of an operand of `extent` lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// // Each of 8 lanes has one of 4, but a ninth would have none.
    /// let half = Affine { mul: 1, add: 0, div: 2 };
    /// assert!(half.stays_inside(8, 4) && !half.stays_inside(9, 4));
    /// ```
    pub fn stays_inside(self, lanes: u32, extent: u32) -> bool {
        // The rule is monotonic: what the ends keep, all keep.
        lanes == 0 || [0, lanes - 1].into_iter().all(|lane| self.source(lane, extent).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::Affine;

    #[test]
    fn quotients_are_rounded_down() {
        let parent = Affine { mul: 1, add: -1, div: 2 };
        assert_eq!([0, 1, 2, 3, 4].map(|lane| parent.at(lane)), [-1, 0, 0, 1, 1]);
        assert_eq!([0, 1, 2].map(|lane| Affine { mul: -3, add: 1, div: 4 }.at(lane)), [0, -1, -2]);
        assert_eq!(Affine { mul: i32::MIN, add: i32::MIN, div: 1 }.at(u32::MAX), i64::MIN);
    }

    #[test]
    fn lanes_come_from_inside_or_not() {
        assert_eq!([0, 1, 4].map(|lane| Affine::shift(-1).source(lane, 4)), [None, Some(0), Some(3)]);
        assert_eq!([2, 3].map(|lane| Affine::shift(1).source(lane, 4)), [Some(3), None]);
        let reverse = Affine { mul: -1, add: 3, div: 1 };
        assert_eq!(
            (reverse.stays_inside(4, 4), reverse.stays_inside(5, 4), reverse.stays_inside(4, 3)),
            (true, false, false)
        );
        assert!(Affine { mul: 1, add: 0, div: 2 }.stays_inside(8, 4));
    }
}
