//! A schedule: the next edge of each of several units, and the least of them.

/// The next edges in a tree, of which each node has the least of those below.
#[derive(Clone, Debug)]
pub(super) struct Due {
    leaves: usize,
    /// Node `k` covers nodes `2 k` and `2 k + 1`; the root is 1.
    least: Vec<u64>,
}

impl Due {
    /// A schedule of that number of units without edges.
    pub fn new(count: usize) -> Due {
        let leaves = count.next_power_of_two();
        Due { leaves, least: vec![u64::MAX; 2 * leaves] }
    }

    /// Sets the next edge of that unit; `u64::MAX` for none.
    pub fn set(&mut self, which: usize, edge: u64) {
        let mut node = self.leaves + which;
        self.least[node] = edge;
        while node > 1 {
            node /= 2;
            let least = self.least[2 * node].min(self.least[2 * node + 1]);
            if std::mem::replace(&mut self.least[node], least) == least {
                return;
            }
        }
    }

    /// The least of all next edges.
    pub fn edge(&self) -> u64 {
        self.least[1]
    }

    /// The unit of that edge, the first of several.
    pub fn first(&self) -> usize {
        let mut node = 1;
        while node < self.leaves {
            node *= 2;
            node += usize::from(self.least[node] > self.least[node + 1]);
        }
        node - self.leaves
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_least_is_found(count in 1..20_usize, sets in prop::collection::vec((any::<prop::sample::Index>(), 0..9_u64), 0..60)) {
            let (mut due, mut plain) = (Due::new(count), vec![u64::MAX; count]);
            for (which, edge) in sets {
                let (which, edge) = (which.index(count), if edge == 0 { u64::MAX } else { edge });
                due.set(which, edge);
                plain[which] = edge;
                let least = plain.iter().min().copied().unwrap();
                prop_assert_eq!(due.edge(), least);
                prop_assert_eq!(due.first(), plain.iter().position(|it| *it == least).unwrap());
            }
        }
    }
}
