//! The page ID generator: a counter that names the next free page of image memory (VC1-PIG).
//!
//! ```text
//! restart --.    .------.
//! take -----+--->| used |--+--> page        the next free page
//!           +1   '------'  +--> used        how many are taken
//!                          '--> exhausted   used = pages
//! ```
//!
//! Latency: 1 clock from `take` to the next page; a page every clock.
//!
//! The counter's value is the ID of the next free page, which the first access to a patch takes. The counter restarts
//! when the buffers are swapped.

use crate::prelude::*;

block! {
    /// Names the next free page of an image memory: 0, 1, 2 ..
    pub struct PageIdGenerator {
        /// The number of pages.
        pub pages: u32,
    }
    ranges { pages: 1.. }
    latency = "1 clock";
    source = "VC-1, section 3.3, page ID generator (VC1-PIG)";
    in PageIdGeneratorIn {
        /// Frees all pages, with priority over `take`.
        restart: bit(),
        /// Takes the next free page.
        take: bit(),
    }
    out(self) PageIdGeneratorOut {
        /// The next free page, unless all are taken.
        page: below(self.pages),
        /// The number of pages taken.
        used: up_to(self.pages),
        /// All pages are taken.
        exhausted: bit(),
    }
}

impl PageIdGenerator {
    fn build(&self, m: Module, i: PageIdGeneratorIn) -> PageIdGeneratorOut {
        def!(used = m.reg(up_to(self.pages)).reset(0));
        def!(exhausted = used.eq(self.pages));
        m.assume(i.take.implies(!exhausted), "a page is taken only while one is free");
        used.when(i.restart, 0).when(i.take, used + 1);
        m.assert(m.past(i.restart).implies(used.eq(0)), "a restart frees all pages");
        m.cover("all pages are taken", m.rose(exhausted));
        PageIdGeneratorOut { page: used.trunc(below(self.pages)), used: *used, exhausted }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;

    #[test]
    fn pages_come_in_order_until_all_are_taken_and_again_after_a_restart() {
        let mut sim = Simulation::of(&PageIdGenerator { pages: 3 }).unwrap();
        let (i, o) = (sim.i, sim.o);
        let wave = sim.record([i.restart, i.take, o.page, o.used, o.exhausted]);
        sim.reset();
        for (restart, take) in [(0, 1), (0, 0), (0, 1), (0, 1), (0, 0), (1, 0), (0, 1), (1, 1), (0, 0)] {
            sim.drive(PageIdGeneratorIn { restart, take });
            sim.step();
        }
        wave.expect(
            r"
            clk       |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            restart   |_______________________/~~~\___/~~~\____
            take      |___/~~~\___/~~~~~~~\_______/~~~~~~~\____
            page      | 0     | 1     | 2 | 3     | 0 | 1 | 0 |
            used      | 0     | 1     | 2 | 3     | 0 | 1 | 0 |
            exhausted |___________________/~~~~~~~\____________
            ",
        );
        assert_eq!(sim.covered("all pages are taken").unwrap(), 1);
    }

    #[test]
    #[should_panic(expected = "a page is taken only while one is free")]
    fn taking_a_page_when_none_is_free_is_an_error() {
        let mut sim = Simulation::of(&PageIdGenerator { pages: 2 }).unwrap();
        sim.reset();
        sim.set(sim.i.take, 1);
        sim.run(3);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Compares with a list of the free pages (VC1-PIG): `take` removes the first page, and `restart` restores
        /// the whole list.
        #[test]
        fn it_is_the_first_of_the_free_pages(
            pages in 2..20u32,
            steps in prop::collection::vec((prop::bool::weighted(0.04), prop::bool::weighted(0.7)), 1..200),
            seed in any::<u64>(),
        ) {
            let mut sim = Simulation::of(&PageIdGenerator { pages }).unwrap().seeded(seed);
            sim.reset();
            let all: Vec<u64> = (0..pages.into()).rev().collect();
            let mut free = all.clone();
            let (mut was_exhausted, mut exhaustions) = (true, 0);
            for (restart, take) in steps {
                let take = take && !free.is_empty();
                sim.drive(PageIdGeneratorIn { restart: restart.into(), take: take.into() });
                let PageIdGeneratorOut { page, used, exhausted } = sim.read_u64();
                prop_assert_eq!((used, exhausted == 1), ((all.len() - free.len()) as u64, free.is_empty()));
                if let Some(first) = free.last() {
                    prop_assert_eq!(page, *first);
                }
                exhaustions += u64::from(free.is_empty() && !was_exhausted);
                was_exhausted = free.is_empty();
                sim.step();
                if restart {
                    free.clone_from(&all);
                } else if take {
                    free.pop();
                }
            }
            prop_assert_eq!(sim.covered("all pages are taken").unwrap(), exhaustions);
        }
    }
}
