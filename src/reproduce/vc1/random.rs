//! Random machines with random frames on small screens, where circuit and model have to agree, too.

use super::plan::merge_clocks;
use tilewright_machines::vc1::{Assign, Config, CostTable, Cursor, Machine, Shown};
use tilewright_machines::{Error, Watch};
use tilewright_report::{Origin, Rule, Statement, Table};
use tilewright_rtl::gfb::{Blanking, Passes};
use tilewright_scenes::{Projection, ScreenVertex, Size, compare, golden};

/// The results of all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ran {
    pub machines: u64,
    pub frames: u64,
    pub overflows: u64,
    pub broadcast: u64,
    /// Averages of several frames.
    pub averages: u64,
    /// Refreshes that were compared with the frame buffers.
    pub refreshes: u64,
    /// Events that were compared with the model.
    pub compared: u64,
    /// Pixels that differ from golden images.
    pub differing: u64,
}

const BACKGROUND: [u8; 3] = [24, 28, 44];

impl Ran {
    /// Runs that number of machines; `None` if interrupted.
    pub fn all(count: u64, seed: u64, watch: &mut Watch) -> Option<Result<Ran, Error>> {
        let (numbers, cancel): (Vec<u64>, _) = ((0..count).collect(), watch.cancel);
        let run = |number: &u64| Ran::of(&mut Dice::new(seed, *number), &mut Watch { progress: None, cancel });
        let ran = watch.each("drawing at random", &numbers, run)?;
        Some(ran.into_iter().try_fold(Ran::default(), |sum, ran| Ok(sum.and(ran?))))
    }

    /// The check that they are right.
    pub fn check(&self, seed: u64) -> Statement {
        Statement::new("DES-MIN", "Frames of random machines, and averages of several, are golden images.", Rule::Zero)
            .unit("pixels that differ")
            .found(Origin::rtl([seed]), [(format!("{} machines", self.machines), self.differing as f64)])
    }

    /// The numbers of everything that was compared.
    pub fn table(&self) -> Table {
        let rows = [
            ("machines", self.machines),
            ("frames", self.frames),
            ("overflows", self.overflows),
            ("polygons sent to all", self.broadcast),
            ("averages of several frames", self.averages),
            ("refreshes compared with frame buffers", self.refreshes),
            ("events, times and counts compared with the model", self.compared),
        ];
        let table = Table::new("random-machines", "Random machines with random frames", ["what", "number"]);
        rows.into_iter().fold(table, |table, (what, count)| table.row([what.into(), (count as f64).into()]))
    }

    fn and(self, other: Ran) -> Ran {
        Ran {
            machines: self.machines + other.machines,
            frames: self.frames + other.frames,
            overflows: self.overflows + other.overflows,
            broadcast: self.broadcast + other.broadcast,
            averages: self.averages + other.averages,
            refreshes: self.refreshes + other.refreshes,
            compared: self.compared + other.compared,
            differing: self.differing + other.differing,
        }
    }

    fn of(dice: &mut Dice, watch: &mut Watch) -> Result<Ran, Error> {
        let config = dice.config()?;
        let frames = config.accumulate.map_or_else(|| dice.within(1, 4), |passes| u64::from(passes.count()));
        let count = dice.within(0, 23);
        let views: Vec<Projection> = (0..frames).map(|_| dice.view(config.size, count)).collect();
        let (mut next, mut goldens, mut ran) = (views.iter().cloned(), Vec::new(), Ran::default());
        let seen = |shown: Shown| {
            let view = &views[shown.number as usize];
            let mut expected = golden::render(view.size, &view.triangles, BACKGROUND);
            if let Some(cursor) = config.cursor {
                cursor.draw(&mut expected);
            }
            ran.differing += compare(&shown.frame, &expected).differing;
            goldens.push(expected);
            if let Some(average) = shown.average {
                ran.differing += compare(&average, &golden::average(&goldens)).differing;
                ran.averages += 1;
            }
            ran.frames += 1;
            true
        };
        let machine = Machine::new(config)?.judging_every_refresh();
        let report = machine.render_frames(BACKGROUND, watch, || next.next(), seen)?;
        ran.overflows = report.frames.iter().map(|frame| frame.overflows()).sum();
        ran.broadcast = report.frames.iter().map(|frame| frame.broadcast()).sum();
        Ok(Ran { machines: 1, refreshes: report.judged, compared: report.compared, ..ran })
    }
}

/// Random numbers (SplitMix64), the same on every computer.
struct Dice(u64);

impl Dice {
    fn new(seed: u64, number: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number);
        dice.next();
        dice
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// From one number to another, both included.
    fn within(&mut self, least: u64, most: u64) -> u64 {
        least + self.next() % (most - least + 1)
    }

    fn small(&mut self, least: u32, most: u32) -> u32 {
        self.within(least.into(), most.into()) as u32
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.within(0, all.len() as u64 - 1) as usize]
    }

    fn config(&mut self) -> Result<Config, Error> {
        let (width, height) = (self.small(32, 48), self.small(32, 40));
        let size = Size::new(width, height).expect("in range");
        let (processors, overhead) = (self.small(1, 9), self.small(1, 40));
        let accumulate = self.one_of(&[None, None, None, Some(Passes::Two), Some(Passes::Four)]);
        let cursor = Cursor { x: self.small(0, width - 1), y: self.small(0, height - 1) };
        let [apr_all, apr_some] = [Some(0), Some(self.small(1, 300))];
        // T_m is from a third of a refresh to five refreshes, and a line of the display is long enough for clock crossings.
        let t_m = 80e-9 * merge_clocks(size, processors, overhead);
        let refresh = t_m * self.within(20, 300) as f64 / 100.0;
        let config = Config {
            processors,
            patch: self.one_of(&[4, 8, 16]),
            cluster: self.small(1, 5),
            assign: self.one_of(&[Assign::Once, Assign::Each, Assign::Count]),
            apr: self.one_of(&[None, apr_all, apr_some]),
            costs: self.costs(),
            queue: self.small(10, 69),
            word_clocks: self.small(1, 8),
            overhead,
            blanking: self.one_of(&[Blanking::AtStart, Blanking::Within]),
            immediate: self.one_of(&[false, true]),
            accumulate,
            cursor: if accumulate.is_none() { self.one_of(&[None, Some(cursor)]) } else { None },
            refresh: 1.0 / refresh.max(330e-9 * f64::from(height + 45)),
            ..Config::new(size)
        };
        let pages = self.small(2, 40).min(config.patches()?.count());
        Ok(Config { pages: Some(pages), ..config })
    }

    fn costs(&mut self) -> CostTable {
        CostTable {
            vertex: self.within(0, 19),
            polygon: self.within(0, 39),
            area: self.within(0, 9),
            clip: self.within(0, 29),
            set_up: self.within(0, 39),
            row: self.within(0, 5),
            pixel: self.within(1, 4),
            clear: self.within(1, 3),
            send: self.within(1, 3),
            receive: self.within(1, 3),
        }
    }

    /// Triangles on the screen and beyond its border.
    fn view(&mut self, size: Size, count: u64) -> Projection {
        let triangles: Vec<_> = (0..count).map(|_| [(); 3].map(|()| self.vertex(size))).collect();
        Projection::of_triangles(size, triangles)
    }

    fn vertex(&mut self, size: Size) -> ScreenVertex {
        let mut place = |side: u32| self.within(0, u64::from(16 * side + 159)) as i32 - 80;
        let (x, y) = (place(size.width()), place(size.height()));
        ScreenVertex { x, y, z: self.small(1, 39), rgb: [self.small(0, 3) as u8 * 80; 3] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_machines_draw_golden_frames_and_two_seeds_differ() {
        let ran = |seed| Ran::all(4, seed, &mut Watch::default()).expect("nothing stops it").expect("they run");
        let [one, same, other] = [1, 1, 2].map(ran);
        assert_eq!(one, same);
        assert_ne!(one, other);
        assert!(one.differing == 0 && one.frames >= 4 && one.overflows > 0 && one.broadcast > 0, "{one:?}");
    }
}
