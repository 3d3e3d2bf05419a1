//! The edges of a clock, up to the current time of a simulation.

/// The edges of a clock.
#[derive(Clone, Copy)]
pub(crate) struct Edges {
    pub period: u64,
    /// The time of the next edge.
    pub next: u64,
}

impl Edges {
    /// The edges after a number of them; the first is a period after the beginning.
    pub fn after(count: u64, period: u64) -> Edges {
        Edges { period, next: (count + 1) * period }
    }

    /// The last edge, counted from 1 at power-on.
    pub fn last(&self) -> u64 {
        self.next / self.period - 1
    }

    /// Whether there was an edge by that time.
    pub fn came(&mut self, time: u64) -> bool {
        if time < self.next {
            return false;
        }
        // Usually it is the only one, and a division would dominate the time here.
        self.next += self.period;
        if time >= self.next {
            self.next += ((time - self.next) / self.period + 1) * self.period;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_come_one_by_one_and_many_at_once() {
        for times in [[24, 25, 26, 74, 75, 76], [25, 50, 75, 100, 101, 1000], [0, 1, 999, 1000, 1001, 2025]] {
            let mut edges = Edges::after(0, 25);
            let mut last = 0;
            for time in times {
                assert_eq!(edges.came(time), time / 25 > last, "{times:?} at {time}");
                last = time / 25;
                assert_eq!((edges.last(), edges.next), (last, (last + 1) * 25), "{times:?} at {time}");
            }
        }
    }
}
