//! A memory chip that is a program: it follows a data sheet, and panics where a controller does not.

use std::collections::{HashMap, VecDeque};

/// Words by bank, row and column.
pub type Cells = HashMap<(u64, u64, u64), u64>;

/// Times of a data sheet, in picoseconds, and what else it says.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// The period of the clock at which the chip is used.
    pub clock: u64,
    pub rcd: u64,
    pub rp: u64,
    pub ras: u64,
    pub longest_ras: u64,
    pub rc: u64,
    pub rrd: u64,
    pub rfc: u64,
    pub wr: u64,
    pub power_up: u64,
    /// Within this time each row is refreshed.
    pub period: u64,
    /// Clocks from the mode's setting until rows begin to lose what they hold.
    pub settled: u32,
    /// How many rows there are. A refresh is for one of them.
    pub rows: usize,
    /// Clocks after a mode was set.
    pub mrd: u64,
    /// The CAS latency for which the clock is slow enough, and which the controller is to choose.
    pub latency: u64,
    pub columns: u32,
    pub bytes: u32,
}

/// What the chip sees at an edge.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    pub cke: u64,
    /// `cs_n`, `ras_n`, `cas_n`, `we_n`.
    pub command: [u64; 4],
    pub ba: u64,
    pub a: u64,
    pub dqm: u64,
    /// The data bus.
    pub dq: u64,
    /// Whether the controller drives it.
    pub driven: bool,
}

/// How far the start has come.
#[derive(Debug, PartialEq)]
enum Start {
    PowerUp,
    Refreshes(u32),
    Ready,
}

#[derive(Debug, Default, Clone)]
struct Bank {
    row: Option<u64>,
    active: Option<u64>,
    precharge: Option<u64>,
    write: Option<u64>,
}

/// A word on its way out: the edge at which it is sampled, and its bytes.
#[derive(Debug)]
struct Reply {
    at: u64,
    word: u64,
}

#[derive(Debug)]
pub struct Chip {
    sheet: Sheet,
    start: Start,
    /// Edges since power-on.
    now: u64,
    banks: Vec<Bank>,
    refresh: Option<u64>,
    mode: Option<u64>,
    replies: VecDeque<Reply>,
    /// `dqm` at the last two edges.
    masks: [u64; 2],
    /// The last edges at which the controller and the chip drove the bus.
    driven: [Option<u64>; 2],
    /// When each row was refreshed, the longest ago first.
    refreshed: VecDeque<u64>,
    cells: Cells,
    /// How many commands of each kind there were, by their bits.
    pub counts: [u32; 8],
}

impl Chip {
    pub fn new(sheet: Sheet) -> Chip {
        Chip {
            start: Start::PowerUp,
            now: 0,
            banks: vec![Bank::default(); 4],
            refresh: None,
            mode: None,
            replies: VecDeque::new(),
            masks: [0; 2],
            driven: [None; 2],
            refreshed: VecDeque::new(),
            cells: Cells::new(),
            counts: [0; 8],
            sheet,
        }
    }

    /// What the array of cells has at an address.
    pub fn word(&self, bank: u64, row: u64, column: u64) -> u64 {
        // A word that was never written is anything, but always the same.
        let anything = (row * 0x9e37 + column * 0x79b9 + bank * 0x7f4a) & self.all_ones();
        self.cells.get(&(bank, row, column)).copied().unwrap_or(anything)
    }

    fn all_ones(&self) -> u64 {
        u64::MAX >> (64 - 8 * self.sheet.bytes)
    }

    /// Panics unless at least this time has passed since an edge.
    fn apart(&self, rule: &str, since: Option<u64>, least: u64) {
        let Some(since) = since else { return };
        let passed = (self.now - since) * self.sheet.clock;
        assert!(passed >= least, "{rule}: {passed} ps after edge {since}, at edge {}, and not {least}", self.now);
    }

    /// Goes through an edge. The result is what the chip drives from now until the next one.
    pub fn edge(&mut self, seen: Seen) -> Option<u64> {
        self.watch_bus(&seen);
        let [cs_n, command @ ..] = seen.command;
        if cs_n == 0 {
            assert_eq!(seen.cke, 1, "a command with `cke` low at edge {}", self.now);
            let command = command.iter().fold(0, |bits, bit| bits << 1 | bit);
            self.counts[command as usize] += 1;
            self.obey(command, &seen);
        }
        if self.start != Start::Ready {
            assert_eq!(seen.dqm, (1 << self.sheet.bytes) - 1, "`dqm` is high until the mode is set");
        }
        self.watch_time();
        self.masks = [seen.dqm, self.masks[0]];
        self.now += 1;
        self.reply()
    }

    /// The word that is sampled at the next edge, without the bytes that `dqm` masks two clocks before that.
    fn reply(&mut self) -> Option<u64> {
        let reply = self.replies.pop_front_if(|reply| reply.at == self.now)?;
        self.driven[1] = Some(self.now);
        // Both masks are shifted, and an edge is over: the older of them counts.
        let hidden = (0..self.sheet.bytes).filter(|byte| self.masks[1] >> byte & 1 == 1);
        Some(hidden.fold(reply.word, |word, byte| word ^ 0xff << (8 * byte)))
    }

    /// Nobody drives the bus in the clock after the other one.
    fn watch_bus(&mut self, seen: &Seen) {
        if seen.driven {
            self.driven[0] = Some(self.now);
        }
        if let [Some(controller), Some(chip)] = self.driven {
            assert!(controller.abs_diff(chip) > 1, "both drive the bus: edges {controller} and {chip}");
        }
    }

    fn watch_time(&self) {
        for bank in self.banks.iter().filter(|bank| bank.row.is_some()) {
            let open = (self.now - bank.active.expect("it was opened")) * self.sheet.clock;
            assert!(open <= self.sheet.longest_ras, "a row is open for {open} ps");
        }
        if let Some(first) = self.refreshed.front() {
            let age = self.now.saturating_sub(*first) * self.sheet.clock;
            assert!(age <= self.sheet.period, "a row was not refreshed for {age} ps, at edge {}", self.now);
        }
    }

    fn obey(&mut self, command: u64, seen: &Seen) {
        let sheet = self.sheet.clone();
        self.apart("tRFC", self.refresh, sheet.rfc);
        self.apart("tMRD", self.mode, sheet.mrd * sheet.clock);
        if matches!(command, 0b011..=0b101) {
            assert_eq!(self.start, Start::Ready, "an access before the mode is set");
        }
        match command {
            0b000 => self.set_mode(seen),
            0b001 => self.refresh(),
            0b010 => self.precharge(seen),
            0b011 => self.active(seen.ba, seen.a),
            0b100 | 0b101 => self.column(command == 0b100, seen),
            0b111 => {}
            _ => panic!("command {command:03b} at edge {}", self.now),
        }
    }

    fn all_closed(&self, why: &str) {
        assert!(self.banks.iter().all(|bank| bank.row.is_none()), "{why} with an open row at edge {}", self.now);
        for bank in &self.banks {
            self.apart("tRP", bank.precharge, self.sheet.rp);
            self.apart("tRC", bank.active, self.sheet.rc);
        }
    }

    fn set_mode(&mut self, seen: &Seen) {
        self.all_closed("a mode is set");
        assert!(matches!(self.start, Start::Refreshes(8..)), "the mode is set after {:?}", self.start);
        assert_eq!((seen.ba, seen.a), (0, self.sheet.latency << 4), "bursts of 1, the latency of the sheet");
        (self.start, self.mode) = (Start::Ready, Some(self.now));
        self.refreshed = vec![self.now + u64::from(self.sheet.settled); self.sheet.rows].into();
    }

    fn refresh(&mut self) {
        self.all_closed("a refresh");
        match &mut self.start {
            Start::PowerUp => panic!("a refresh before all rows are closed"),
            Start::Refreshes(count) => *count += 1,
            Start::Ready => {
                self.refreshed.pop_front();
                self.refreshed.push_back(self.now);
            }
        }
        self.refresh = Some(self.now);
    }

    fn precharge(&mut self, seen: &Seen) {
        let all = seen.a >> 10 & 1 == 1;
        if self.start == Start::PowerUp {
            assert!(
                all && self.now * self.sheet.clock >= self.sheet.power_up,
                "the first command, at edge {}",
                self.now
            );
            self.start = Start::Refreshes(0);
        }
        for number in (0..4).filter(|number| all || *number == seen.ba) {
            let bank = &self.banks[number as usize];
            if bank.row.is_some() {
                self.apart("tRAS", bank.active, self.sheet.ras);
                self.apart("tWR", bank.write, self.sheet.wr);
            }
            let bank = &mut self.banks[number as usize];
            (bank.row, bank.precharge) = (None, Some(self.now));
        }
    }

    fn active(&mut self, number: u64, row: u64) {
        for bank in &self.banks {
            self.apart("tRRD", bank.active, self.sheet.rrd);
        }
        let bank = &self.banks[number as usize];
        assert!(bank.row.is_none(), "a row is opened above another one at edge {}", self.now);
        self.apart("tRP", bank.precharge, self.sheet.rp);
        self.apart("tRC", bank.active, self.sheet.rc);
        let bank = &mut self.banks[number as usize];
        (bank.row, bank.active, bank.write) = (Some(row), Some(self.now), None);
    }

    fn column(&mut self, writes: bool, seen: &Seen) {
        let bank = &self.banks[seen.ba as usize];
        let row = bank.row.unwrap_or_else(|| panic!("an access to a closed bank at edge {}", self.now));
        self.apart("tRCD", bank.active, self.sheet.rcd);
        assert_eq!(seen.a >> 10, 0, "the row stays open");
        assert!(seen.a < 1 << self.sheet.columns, "a column that is none: {}", seen.a);
        let stored = self.word(seen.ba, row, seen.a);
        assert_eq!(seen.driven, writes, "the controller drives the bus with WRITE, and not with READ");
        if writes {
            let kept = (0..self.sheet.bytes).filter(|byte| seen.dqm >> byte & 1 == 1);
            let mask = kept.fold(0, |mask, byte| mask | 0xff << (8 * byte));
            self.cells.insert((seen.ba, row, seen.a), stored & mask | seen.dq & !mask);
            self.banks[seen.ba as usize].write = Some(self.now);
        } else {
            self.replies.push_back(Reply { at: self.now + self.sheet.latency, word: stored });
        }
    }
}
