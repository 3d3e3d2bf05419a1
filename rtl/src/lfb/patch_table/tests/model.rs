//! The patch table against a plain software model: random look-ups, clears, swaps and resumes, with stalls and overflows.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::*;
use crate::lfb::Patches;
use crate::parameter::Screen;

/// The result of a look-up in the table.
#[derive(Clone, Copy)]
enum Outcome {
    Hit(u64),
    /// The patch gets this page.
    Miss(u64),
    /// All pages are taken.
    Full,
}

/// Two tables in software, and the times of the accesses.
struct Model {
    /// The page of each patch in each buffer.
    tables: [Vec<Option<u64>>; 2],
    pages: u64,
    used: u64,
    /// Clocks of the processor.
    now: u64,
    /// The first clock after the last clear.
    cleared: u64,
    /// The look-up under way: its patch, when it read the table, and what it found.
    look_up: Option<(u64, Option<(u64, Outcome)>)>,
}

impl Model {
    fn new(patches: u64, pages: u64) -> Model {
        let table = vec![None; patches as usize];
        Model { tables: [table.clone(), table], pages, used: 0, now: 0, cleared: 0, look_up: None }
    }

    /// The page with which the look-up ends: in its third clock on the table, or the fourth (VC1-ACC).
    fn found(&self) -> Option<u64> {
        match self.look_up? {
            (_, Some((read, Outcome::Hit(page)))) => Some(page).filter(|_| self.now == read + 2),
            (_, Some((read, Outcome::Miss(page)))) => Some(page).filter(|_| self.now == read + 3),
            _ => None,
        }
    }

    fn overflow(&self) -> bool {
        matches!(self.look_up, Some((_, Some((read, Outcome::Full)))) if self.now >= read + 2)
    }

    fn ready(&self) -> bool {
        self.look_up.is_none() || self.found().is_some()
    }

    fn table_free(&self, settled: bool) -> bool {
        settled && self.now >= self.cleared
    }

    fn clear_ready(&self, settled: bool) -> bool {
        self.table_free(settled) && (self.ready() || self.overflow())
    }

    /// Whether the buffers may be swapped; the local frame buffer unit ensures this.
    fn can_swap(&self) -> bool {
        self.look_up.is_none() || self.overflow()
    }

    /// A clock of the processor.
    fn clock(&mut self, i: &PatchTableIn<u64>) {
        let (ready, table_free) = (self.ready(), self.table_free(i.settled == 1));
        let clears = i.clear.valid == 1 && self.clear_ready(i.settled == 1);
        let resumes = i.resume == 1 && self.overflow();
        if self.found().is_some() {
            self.look_up = None;
        }
        let table = &mut self.tables[i.front as usize];
        if let Some((patch, read)) = &mut self.look_up {
            match *read {
                None if table_free => {
                    let outcome = match table[*patch as usize] {
                        Some(page) => Outcome::Hit(page),
                        None if self.used < self.pages => Outcome::Miss(self.used),
                        None => Outcome::Full,
                    };
                    *read = Some((self.now, outcome));
                }
                Some((read, Outcome::Miss(page))) if self.now == read + 2 => {
                    table[*patch as usize] = Some(page);
                    self.used += 1;
                }
                Some(_) if resumes => *read = None,
                _ => {}
            }
        }
        if clears {
            table[i.clear.patch as usize] = None;
            self.cleared = self.now + 3;
        }
        if i.restart == 1 {
            self.used = 0;
        }
        if ready && i.look_up.valid == 1 {
            self.look_up = Some((i.look_up.patch, None));
        }
        self.now += 1;
    }
}

/// The requests until the next edge.
#[derive(Debug, Clone)]
struct Step {
    look_up: Option<u64>,
    clear: Option<u64>,
    scan: Option<u64>,
    swap: bool,
    resume: bool,
    settled: bool,
}

fn step(patches: u64) -> impl Strategy<Value = Step> {
    // Few patches, so that many accesses go to the same one.
    let patch = move || prop_oneof![3 => 0..6u64, 1 => 0..patches].prop_map(move |patch| patch % patches);
    let flag = prop::bool::weighted;
    let wanted = (
        prop::option::weighted(0.7, patch()),
        prop::option::weighted(0.15, patch()),
        prop::option::weighted(0.7, patch()),
    );
    (wanted, flag(0.06), flag(0.2), flag(0.9)).prop_map(|((look_up, clear, scan), swap, resume, settled)| Step {
        look_up,
        clear,
        scan,
        swap,
        resume,
        settled,
    })
}

/// A screen in patches, with pages for some of them.
fn run() -> impl Strategy<Value = (PatchTable, Vec<Step>)> {
    let size = (17..40u32, 17..30u32, prop::sample::select(vec![4, 8, 16]), 2..7u32);
    size.prop_flat_map(|(width, height, edge, pages)| {
        let patches = Patches::new(Screen { width, height }, edge).unwrap().count();
        let table = PatchTable { patches, pages: pages.min(patches) };
        (Just(table), prop::collection::vec(step(patches.into()), 1..300))
    })
}

fn wish(patch: Option<u64>) -> Stream<Wanted<u64>, u64> {
    Stream::of(patch.is_some().into(), Wanted { patch: patch.unwrap_or_default() })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// Checks the outputs in every clock, and the contents at the end (VC1-PT, VC1-PIG, VC1-ACC, VC1-CLR2). The scan
    /// reads the back buffer, as in the local frame buffer unit (VC1-LFB).
    #[test]
    fn it_gives_out_pages_as_the_model_does((table, steps) in run(), seed in any::<u64>()) {
        let mut sim = Simulation::of(&table).unwrap().seeded(seed);
        sim.reset();
        let mut model = Model::new(table.patches.into(), table.pages.into());
        let (mut front, mut scanned) = (0, None);
        for step in steps {
            let swap = step.swap && model.can_swap();
            let scan = ScanLookUp {
                enable: step.scan.is_some().into(),
                patch: step.scan.unwrap_or_default(),
                buffer: 1 - front,
            };
            let i = PatchTableIn {
                look_up: wish(step.look_up),
                clear: wish(step.clear),
                front,
                settled: step.settled.into(),
                restart: swap.into(),
                resume: step.resume.into(),
                scan,
            };
            sim.drive(i);
            let o = sim.read_u64();
            let ready = [sim.i.look_up.ready, sim.i.clear.ready].map(|ready| sim.get(ready) == 1);
            prop_assert_eq!(ready, [model.ready(), model.clear_ready(step.settled)]);
            prop_assert_eq!((o.overflow == 1, o.idle == 1), (model.overflow(), model.look_up.is_none()));
            prop_assert_eq!(o.pages_used, model.used);
            prop_assert_eq!((o.found == 1).then_some(o.page), model.found());
            if let Some(entry) = scanned {
                prop_assert_eq!((o.scan_entry.resident == 1).then_some(o.scan_entry.page), entry);
            }

            let clocks = |sim: &Simulation<_, _>| [PE, MERGE].map(|clock| sim.cycles(clock).unwrap());
            let before = clocks(&sim);
            sim.step();
            let [pe, merge] = clocks(&sim);
            if let (Some(patch), true) = (step.scan, merge > before[1]) {
                scanned = Some(model.tables[1 - front as usize][patch as usize]);
            }
            if pe > before[0] {
                model.clock(&i);
                front ^= u64::from(swap);
            }
        }
        for (buffer, table) in (0..).zip(&model.tables) {
            for (patch, page) in (0..).zip(table) {
                let entry = sim.peek_memory("entries", 2 * patch + buffer).unwrap();
                let resident = entry.bit(entry.width() - 1);
                prop_assert_eq!(resident.then(|| entry.slice(0..entry.width() - 1).to_u64().unwrap()), *page);
            }
        }
    }
}
