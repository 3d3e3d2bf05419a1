//! The clock of each word, predicted by arithmetic on the times of commands.

use super::*;

/// The commands so far, by the clocks in which the controller decides on them.
struct Commands<'a> {
    block: &'a SdramController,
    /// The first clock in which any command may be next.
    free: u64,
    /// The next clock from which a refresh comes first.
    due: u64,
    open: [Option<u64>; 4],
    may_close: [u64; 4],
    may_write: u64,
}

impl<'a> Commands<'a> {
    /// After the start.
    fn new(block: &'a SdramController) -> Commands<'a> {
        let [power_up, rp, rfc, mrd, refresh] =
            [block.power_up, block.rp, block.rfc, block.mrd, block.refresh].map(u64::from);
        let mode = power_up + rp + 8 * rfc;
        let mut due = power_up + refresh;
        while due < mode + 2 {
            due += refresh;
        }
        Commands { block, free: mode + mrd, due, open: [None; 4], may_close: [0; 4], may_write: 0 }
    }

    /// Whether a command in that clock comes after a refresh. If so, that is done first.
    fn is_late(&mut self, clock: u64) -> bool {
        let is_late = clock >= self.due;
        if is_late {
            let closes = self.may_close.into_iter().fold(self.free.max(self.due + 1), u64::max);
            self.free = closes + u64::from(self.block.rp + self.block.rfc);
            self.due += u64::from(self.block.refresh);
            self.open = [None; 4];
        }
        is_late
    }

    /// The clock in which a request that is there from `from` on is served.
    fn serve(&mut self, wish: Wish, from: u64) -> u64 {
        let SdramController { cas_latency, late, rcd, rp, ras, rc, wr, .. } = *self.block;
        let bank = wish.bank as usize;
        loop {
            let at = from.max(self.free);
            match self.open[bank] {
                Some(row) if row == wish.row => {
                    let at = if wish.write.is_some() { at.max(self.may_write) } else { at };
                    if self.is_late(at) {
                        continue;
                    }
                    match wish.write {
                        Some(_) => self.may_close[bank] = self.may_close[bank].max(at + u64::from(wr)),
                        None => self.may_write = at + u64::from(cas_latency + late + 2),
                    }
                    return at;
                }
                Some(_) => {
                    let at = at.max(self.may_close[bank]);
                    if !self.is_late(at) {
                        self.open[bank] = None;
                        self.free = at + u64::from(rp);
                    }
                }
                None => {
                    if !self.is_late(at) {
                        self.open[bank] = Some(wish.row);
                        self.may_close[bank] = at + u64::from(ras.max(rc.saturating_sub(rp)));
                        self.free = at + u64::from(rcd);
                    }
                }
            }
        }
    }
}

/// The clocks in which words are shown to a receiver that is always ready.
fn predicted(block: &SdramController, wishes: &[Wish]) -> Vec<u64> {
    let mut commands = Commands::new(block);
    let mut from = 1;
    let mut clocks = Vec::new();
    for wish in wishes {
        let at = commands.serve(*wish, from);
        from = at + 1;
        if wish.write.is_none() {
            clocks.push(at + u64::from(block.cas_latency + block.late) + 3);
        }
    }
    clocks
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_word_comes_in_its_clock((block, sheet) in systems(), wishes in traffic::wishes()) {
        let wishes: Vec<Wish> = wishes.into_iter().map(|wish| wish.within(&block)).collect();
        let mut rig = Rig::new(&block, sheet);
        let (words, _) = array(&rig.chip, &wishes);
        let seen = rig.asks(&wishes);
        prop_assert_eq!(seen, words.into_iter().zip(predicted(&block, &wishes)).collect::<Vec<_>>());
    }
}

/// Three rows of a picture are read, word by word, while refreshes go on.
#[test]
fn the_throughput_at_100_mhz() {
    let block = SdramController { power_up: 10_000, ..SdramController::of_32_megabytes(Period::ns(10)) };
    let wishes: Vec<Wish> = (0..3 * 512).map(|place| Wish::read(place / 512, 7, place % 512)).collect();
    let mut rig = Rig::new(&block, micron());
    let seen = rig.asks(&wishes);
    assert_eq!(seen.iter().map(|(_, clock)| *clock).collect::<Vec<_>>(), predicted(&block, &wishes));
    let clocks = seen[wishes.len() - 1].1 - seen[0].1 + 1;
    // A clock for each word, 2 for each of the two rows after the first, and 10 + 2 for each of two refreshes.
    assert_eq!(clocks, 1536 + 2 * 2 + 2 * 12);
}
