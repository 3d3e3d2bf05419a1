//! What is run for the page: scenes on machines.

use crate::reproduce::effort::Effort;
use tilewright_machines::vc1::{Assign, Config, CostTable};
use tilewright_rtl::gfb::{Blanking, GfbSequencer};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::vc1::OVERHEAD;
use tilewright_scenes::Size;

/// Figure 13's scenes.
pub const SCENES: [&str; 5] = ["teapot", "teapot16", "table", "ter1k", "ter250"];
/// The scenes of a quick look.
const FEW_SCENES: [&str; 3] = ["teapot", "table", "ter1k"];

/// Views of Table 1 in a full circle (VC1-T1).
pub const VIEWS: u32 = 48;
/// Degrees from one view to the next.
pub const STEP: f64 = 360.0 / VIEWS as f64;

/// Frames of a still view, and the first swap of the global frame buffer that is timed, counted from 1.
pub const FRAMES: usize = 15;
pub const FIRST: usize = 3;

/// The paper's threshold with 16 processing elements, in pixels (VC1-F9).
pub const THRESHOLD: u32 = 500;
const THRESHOLDS: [u32; 11] = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000];
const FEW_THRESHOLDS: [u32; 4] = [50, 500, 5000, 20_000];

/// The sizes of clusters that are compared (VC1-CLU).
pub const CLUSTERS: [u32; 5] = [1, 8, 32, 128, 512];

/// The machines of section 6, each with the part of the screen for which it has pages (VC1-THRN).
pub const SECTION_6: [(u32, u32); 4] = [(4, 4), (16, 8), (64, 16), (256, 32)];

/// Splits of the clocks of rasterization (VC1-T1): the set-up of a packet; the rest of the 754 clocks is for rows.
pub const SPLITS: [u64; 3] = [500, 300, 100];

/// The image memory of each buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Capacity {
    /// The paper's machine: 4096 pages of 4x4 pixels, 1/4.7 of its screen (VC1-LFB).
    Paper,
    /// One over this number of the screen.
    Part(u32),
}

/// A scene on a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    pub scene: &'static str,
    /// The steps of the camera's orbit. Clusters are assigned before them.
    pub view: u32,
    pub processors: u32,
    pub capacity: Capacity,
    /// In pixels of the paper's screen.
    pub apr: Option<u32>,
    pub cluster: u32,
    pub blanking: Blanking,
    pub refresh: f64,
    pub immediate: bool,
    pub costs: CostTable,
}

/// The work for the page.
#[derive(Clone, Copy)]
pub struct Plan {
    pub effort: Effort,
    /// The settings of all machines; tests change them.
    pub usual: Usual,
}

/// The common settings of the machines of a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    pub costs: CostTable,
    pub refresh: f64,
    /// A factor for the pages of each capacity.
    pub pages: f64,
}

impl Default for Usual {
    fn default() -> Usual {
        Usual { costs: CostTable::default(), refresh: 60.0, pages: 1.0 }
    }
}

impl Capacity {
    /// Pages of an image memory for a screen of `patches` patches.
    fn pages(self, patches: u32) -> u32 {
        match self {
            Capacity::Paper => 4096 * patches / 19_200,
            Capacity::Part(part) => patches / part,
        }
    }

    /// As a share of the screen.
    pub fn share(self) -> f64 {
        f64::from(self.pages(19_200)) / 19_200.0
    }

    pub fn name(self) -> String {
        match self {
            Capacity::Paper => "1/4.7".to_owned(),
            Capacity::Part(1) => "1".to_owned(),
            Capacity::Part(part) => format!("1/{part}"),
        }
    }
}

/// The threshold for that number of processing elements. The paper lowers it as their number grows, and gives no numbers (VC1-THRN).
pub fn threshold(processors: u32) -> Option<u32> {
    (processors > 1).then_some(if processors == 16 { THRESHOLD } else { (THRESHOLD * 16 / processors).max(1) })
}

/// The clocks of a row that give 754 together with that set-up; the counts are ter1k's (VC1-T1), as at `CostTable`.
pub fn split(set_up: u64) -> CostTable {
    let usual = CostTable::default();
    let per_polygon = |set_up: u64| 0.9104 * set_up as f64;
    let row = usual.row as f64 + (per_polygon(usual.set_up) - per_polygon(set_up)) / 4.3235;
    CostTable { set_up, row: row.round() as u64, ..usual }
}

impl Case {
    /// The machine. On a small screen refreshes and programs are faster by the factor by which T_m is shorter.
    pub fn config(&self, plan: &Plan) -> Config {
        let size = plan.size();
        let patches = (size.width() / 4) * (size.height() / 4);
        let pages = f64::from(self.capacity.pages(patches)) * plan.usual.pages;
        let scale = plan.scale() * plan.scale();
        Config {
            processors: self.processors,
            pages: Some((pages as u32).clamp(2, patches)),
            cluster: self.cluster,
            assign: Assign::Once,
            apr: self.apr.map(|pixels| (pixels / scale).max(1)),
            costs: hasty(self.costs, plan.hurry(self.processors)),
            refresh: self.refresh * plan.hurry(self.processors),
            blanking: self.blanking,
            immediate: self.immediate,
            ..Config::new(size)
        }
    }
}

impl Plan {
    pub fn new(effort: Effort) -> Plan {
        Plan { effort, usual: Usual::default() }
    }

    pub fn is_quick(&self) -> bool {
        self.effort.is_quick()
    }

    pub fn size(&self) -> Size {
        Size::new(Size::VGA.width() / self.scale(), Size::VGA.height() / self.scale()).expect("in range")
    }

    /// The factor by which the sides of a quick look's screen are smaller.
    pub fn scale(&self) -> u32 {
        if self.is_quick() { 8 } else { 1 }
    }

    /// The factor by which a refresh is shorter, so that T_m has the same number of them as on the paper's screen. Times of a quick look are multiplied by it.
    pub fn hurry(&self, processors: u32) -> f64 {
        let clocks = |size| merge_clocks(size, processors, OVERHEAD);
        clocks(Size::VGA) / clocks(self.size())
    }

    pub fn scenes(&self) -> &'static [&'static str] {
        if self.is_quick() { &FEW_SCENES } else { &SCENES }
    }

    /// The numbers of processing elements of Figure 7.
    pub fn processors(&self) -> &'static [u32] {
        if self.is_quick() { &[1, 4, 16] } else { &[1, 2, 4, 8, 16, 32, 64, 128, 256] }
    }

    /// The numbers of processing elements of Figure 8.
    pub fn figure_8(&self) -> &'static [u32] {
        if self.is_quick() { &[16] } else { &[16, 256] }
    }

    /// The memories of Figure 8, from the whole screen on.
    pub fn capacities(&self) -> &'static [u32] {
        if self.is_quick() { &[1, 8, 32] } else { &[1, 2, 4, 8, 16, 32, 64, 128] }
    }

    /// The thresholds of Figure 9, the last of which is none.
    pub fn thresholds(&self) -> impl Iterator<Item = Option<u32>> + use<> {
        let all = if self.is_quick() { &FEW_THRESHOLDS[..] } else { &THRESHOLDS };
        all.iter().copied().map(Some).chain([None])
    }

    /// The number of random machines.
    pub fn machines(&self) -> u64 {
        if self.is_quick() { 3 } else { 100 }
    }

    pub fn views(&self) -> impl Iterator<Item = u32> + use<> {
        0..self.effort.at_most(VIEWS.into()) as u32
    }

    /// A scene on the paper's machine with that number of processing elements.
    pub fn case(&self, scene: &'static str, processors: u32) -> Case {
        Case {
            scene,
            view: 0,
            processors,
            capacity: Capacity::Paper,
            apr: threshold(processors),
            cluster: 32,
            blanking: Blanking::AtStart,
            refresh: self.usual.refresh,
            immediate: false,
            costs: self.usual.costs,
        }
    }

    /// With the display at 59.94 Hz (VC1-59).
    pub fn slower(case: Case) -> Case {
        Case { refresh: case.refresh * 59.94 / 60.0, ..case }
    }

    /// The point of Figure 8.
    pub fn in_memory(&self, scene: &'static str, processors: u32, part: u32) -> Case {
        Case { capacity: Capacity::Part(part), ..self.case(scene, processors) }
    }

    /// The point of Figure 9: the table with 16 processing elements.
    pub fn at_threshold(&self, capacity: Capacity, blanking: Blanking, apr: Option<u32>) -> Case {
        Case { capacity, blanking, apr, ..self.case("table", 16) }
    }

    /// The same with another split of the clocks.
    pub fn with_split(&self, set_up: u64, apr: Option<u32>) -> Case {
        Case { costs: split(set_up), ..self.at_threshold(Capacity::Paper, Blanking::AtStart, apr) }
    }

    /// Table 1's VLFB: ter1k with 1/8 of the screen.
    pub fn vlfb(&self, view: u32) -> Case {
        Case { view, ..self.in_memory("ter1k", 16, 8) }
    }

    /// ter1k in clusters, with pages for all patches.
    pub fn clustered(&self, cluster: u32) -> Case {
        Case { cluster, ..self.in_memory("ter1k", 16, 1) }
    }

    /// The point of section 6: the table.
    pub fn in_section_6(&self, (processors, part): (u32, u32), apr: Option<u32>) -> Case {
        Case { apr, ..self.in_memory("table", processors, part) }
    }

    /// The whole of ter250 over the bus before each frame (VC1-IMM).
    pub fn immediate(&self, processors: u32) -> Case {
        Case { immediate: true, ..self.case("ter250", processors) }
    }

    /// All cases, each once.
    pub fn cases(&self) -> Vec<Case> {
        let mut all: Vec<Case> = Vec::new();
        // The longest cases come first, so that no processor waits for one at the end.
        if !self.is_quick() {
            all.extend([64, 256].map(|n| self.immediate(n)));
        }
        for &scene in self.scenes() {
            all.extend(self.processors().iter().map(|n| self.case(scene, *n)));
            if !self.is_quick() {
                all.push(Plan::slower(self.case(scene, 256)));
            }
            for n in self.figure_8() {
                all.extend(self.capacities().iter().map(|part| self.in_memory(scene, *n, *part)));
            }
        }
        for apr in self.thresholds() {
            for capacity in CAPACITIES {
                all.extend(BLANKINGS.map(|blanking| self.at_threshold(capacity, blanking, apr)));
            }
            all.push(self.at_threshold(Capacity::Part(1), Blanking::AtStart, apr));
            all.extend(SPLITS.map(|set_up| self.with_split(set_up, apr)));
            all.extend(self.section_6().map(|machine| self.in_section_6(machine, apr)));
        }
        all.extend(self.views().map(|view| self.vlfb(view)));
        all.extend(CLUSTERS.map(|cluster| self.clustered(cluster)));
        let mut once: Vec<Case> = Vec::new();
        for case in all {
            if !once.contains(&case) {
                once.push(case);
            }
        }
        once
    }

    /// The machines of section 6.
    pub fn section_6(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let few = self.is_quick();
        SECTION_6.into_iter().filter(move |(n, _)| !few || *n <= 16)
    }
}

/// The memories for Figure 9 (VC1-F9): the machine's, and that of Table 1.
pub const CAPACITIES: [Capacity; 2] = [Capacity::Paper, Capacity::Part(8)];
/// When the global frame buffer may swap.
pub const BLANKINGS: [Blanking; 2] = [Blanking::AtStart, Blanking::Within];

/// The costs with a factor for the steps of which there are as many on a small screen; these take `hurry` times fewer clocks.
fn hasty(costs: CostTable, hurry: f64) -> CostTable {
    let CostTable { vertex, polygon, area, clip, set_up, row, .. } = costs;
    let [vertex, polygon, area, clip, set_up, row] =
        [vertex, polygon, area, clip, set_up, row].map(|clocks| (clocks as f64 / hurry).round() as u64);
    CostTable { vertex, polygon, area, clip, set_up, row, ..costs }
}

/// T_m in clocks of the merger.
pub fn merge_clocks(size: Size, processors: u32, overhead: u32) -> f64 {
    let screen = Screen { width: size.width(), height: size.height() };
    GfbSequencer { screen, units: processors, overhead }.merge_clocks() as f64
}
