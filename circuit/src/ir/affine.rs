//! The rule that maps each lane to a source lane.

/// Lane `i` is lane `floor((mul * i + add) / div)` of the operand, computed in 64 bits. It can express a neighbour,
/// every second lane, the lanes in reverse, or the parent in a tree.
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
    /// The factor of a lane's index.
    pub mul: i32,
    /// The summand.
    pub add: i32,
    /// The divisor, at least 1; the quotient rounds towards minus infinity.
    pub div: u32,
}

impl Affine {
    /// Lane `i` is lane `i + by`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// // The rule of `previous`: lane 3 takes lane 2, and lane 0 takes lane -1, which is out of range.
    /// let previous = Affine::shift(-1);
    /// assert_eq!([3, 0].map(|lane| previous.source(lane, 4)), [Some(2), None]);
    /// ```
    pub fn shift(by: i32) -> Affine {
        Affine { mul: 1, add: by, div: 1 }
    }

    /// The source of lane `lane`, even if it is out of range.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// let reversed = Affine { mul: -1, add: 3, div: 1 };
    /// assert_eq!([0, 3, 4].map(|lane| reversed.at(lane)), [3, 0, -1]);
    /// ```
    pub fn at(self, lane: u32) -> i64 {
        // From -2 to 63, and below.
        (i64::from(self.mul) * i64::from(lane) + i64::from(self.add)).div_euclid(i64::from(self.div.max(1)))
    }

    /// The lane of an operand of `extent` lanes that lane `lane` takes; `None` if it is out of range.
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

    /// Whether the source of each of `lanes` lanes is within an operand of `extent` lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Affine;
    ///
    /// // Each of 8 lanes takes one of 4; a ninth would be out of range.
    /// let half = Affine { mul: 1, add: 0, div: 2 };
    /// assert!(half.stays_inside(8, 4) && !half.stays_inside(9, 4));
    /// ```
    pub fn stays_inside(self, lanes: u32, extent: u32) -> bool {
        // The rule is monotonic: if both ends are in range, all lanes are.
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
