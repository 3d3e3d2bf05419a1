//! The senders with an offer to the bus: a set of numbers in the sequence of the bus's rotation.

/// A set of numbers below a limit.
#[derive(Clone, Debug)]
pub(super) struct Senders {
    /// A bit for each number.
    bits: Vec<u64>,
}

impl Senders {
    /// An empty set of numbers below that limit.
    pub fn new(count: usize) -> Senders {
        Senders { bits: vec![0; count.div_ceil(64)] }
    }

    pub fn insert(&mut self, sender: usize) {
        self.bits[sender / 64] |= 1 << (sender % 64);
    }

    pub fn remove(&mut self, sender: usize) {
        self.bits[sender / 64] &= !(1 << (sender % 64));
    }

    pub fn contains(&self, sender: usize) -> bool {
        self.bits[sender / 64] >> (sender % 64) & 1 == 1
    }

    pub fn is_empty(&self) -> bool {
        self.bits.iter().all(|bits| *bits == 0)
    }

    /// The next number after that one in the rotation; the number itself comes last.
    pub fn next_behind(&self, sender: usize) -> Option<usize> {
        self.first_from(sender + 1).or_else(|| self.first_from(0))
    }

    fn first_from(&self, from: usize) -> Option<usize> {
        (from / 64..self.bits.len()).find_map(|place| {
            let bits = self.bits[place] & mask_from(from, place);
            (bits != 0).then(|| place * 64 + bits.trailing_zeros() as usize)
        })
    }

    /// The count of numbers after the first one and before the other in the rotation.
    pub fn between(&self, first: usize, other: usize) -> u64 {
        let [behind, before] = [first + 1, other].map(|end| self.below(end));
        if first < other { before - behind } else { self.below(64 * self.bits.len()) - behind + before }
    }

    fn below(&self, end: usize) -> u64 {
        let ones = |(place, bits): (usize, &u64)| u64::from((bits & !mask_from(end, place)).count_ones());
        self.bits.iter().enumerate().map(ones).sum()
    }
}

/// The bits of that word of 64 for numbers from that one on.
fn mask_from(from: usize, place: usize) -> u64 {
    let below = from.saturating_sub(64 * place);
    u64::MAX.checked_shl(below as u32).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn it_goes_round(count in 1..200_usize, chosen in prop::collection::vec(any::<bool>(), 200), ends in any::<[prop::sample::Index; 2]>()) {
            let mut senders = Senders::new(count);
            (0..count).for_each(|it| senders.insert(it));
            (0..count).filter(|it| !chosen[*it]).for_each(|it| senders.remove(it));
            let [first, other] = ends.map(|it| it.index(count));
            let round: Vec<usize> = (first + 1..count).chain(0..=first).collect();
            let offers = |it: &usize| chosen[*it];
            prop_assert_eq!(senders.is_empty(), !(0..count).any(|it| chosen[it]));
            prop_assert_eq!(senders.contains(first), chosen[first]);
            prop_assert_eq!(senders.next_behind(first), round.iter().copied().find(offers));
            if first != other {
                let between = round.iter().take_while(|it| **it != other).filter(|it| offers(it)).count();
                prop_assert_eq!(senders.between(first, other), between as u64);
            }
        }
    }
}
