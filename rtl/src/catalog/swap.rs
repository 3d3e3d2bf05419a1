//! The entries of the swap control.

mod figure_6;

use tilewright_hdl::{Scenario, Script, elaborate, elaborate_at};

use super::shared::PROCESSORS;
use super::{CatalogError, Entry, Parameter, Values};
use crate::clocks::{MERGE, PE};
use crate::swap::{GfbSwap, GfbSwapIn, LfbSwap, LfbSwapIn, SwapControl, SyncLine, SyncLineIn};

const PATCHES: Parameter =
    Parameter { name: "patches", default: 3, min: 2, max: 1 << 18, meaning: "entries of the patch table" };
const MERGE_CLOCKS: Parameter =
    Parameter { name: "merge-clocks", default: 12, min: 12, max: 1 << 20, meaning: "T_m in clocks of the block" };

const ROUND: Parameter =
    Parameter { name: "merge-clocks", default: 4, min: 4, max: 1 << 16, meaning: "T_m in clocks of the merger" };

pub(super) const VC1_SWAP: Entry = Entry {
    name: "vc1-swap",
    summary: "the VC-1's whole swap control: decides when the local frame buffers and the global one swap",
    parameters: &[PROCESSORS, PATCHES, ROUND],
    design: |values| Ok(elaborate(&swap_control(values)?)?),
    scenario: |values| Ok(figure_6::figure_6(&swap_control(values)?)),
};

pub(super) const SYNC_LINE: Entry = Entry {
    name: "sync-line",
    summary: "one bit that is high unless a unit pulls it low",
    parameters: &[PROCESSORS],
    design: |values| Ok(elaborate_at(&sync_line(values)?, PE.period)?),
    scenario: |values| Ok(one_after_another(&sync_line(values)?)),
};

pub(super) const LFB_SWAP: Entry = Entry {
    name: "lfb-swap",
    summary: "swaps a local frame buffer at a frame's end and on an overflow",
    parameters: &[PATCHES, MERGE_CLOCKS],
    design: |values| Ok(elaborate(&lfb_swap(values)?)?),
    scenario: |values| Ok(a_frame_and_an_overflow(&lfb_swap(values)?)),
};

pub(super) const GFB_SWAP: Entry = Entry {
    name: "gfb-swap",
    summary: "swaps the global frame buffer in a vertical blanking, when a frame is merged",
    parameters: &[PROCESSORS, MERGE_CLOCKS],
    design: |values| Ok(elaborate_at(&gfb_swap(values)?, MERGE.period)?),
    scenario: |values| Ok(two_frames(&gfb_swap(values)?)),
};

fn swap_control(values: &Values) -> Result<SwapControl, CatalogError> {
    let round = values.get("merge-clocks");
    let merge_clocks = (round * MERGE.period.picoseconds()).div_ceil(PE.period.picoseconds());
    let (sent_clocks, overflow_clocks) = (merge_clocks + 40, 3 * merge_clocks + 80);
    let local = LfbSwap { patches: values.get_u32("patches"), merge_clocks, sent_clocks, overflow_clocks }.checked()?;
    let global = GfbSwap { processors: values.get_u32("processors"), merge_clocks: round, way: round as u32, late: 8 };
    Ok(SwapControl { local, global: global.checked()? })
}

fn sync_line(values: &Values) -> Result<SyncLine, CatalogError> {
    Ok(SyncLine { processors: values.get_u32("processors") }.checked()?)
}

fn one_after_another(line: &SyncLine) -> Scenario {
    let mut script = Script::new(line, PE.period);
    for number in 0..=line.processors {
        let ready = (0..line.processors).map(|other| u64::from(other < number)).collect();
        script.clock(&SyncLineIn { ready, bus: 1, host: 1 });
    }
    script.clock(&SyncLineIn { ready: vec![0; line.processors as usize], bus: 1, host: 1 });
    script.finish("the processing elements release the line, one after another")
}

fn lfb_swap(values: &Values) -> Result<LfbSwap, CatalogError> {
    let merge_clocks = values.get("merge-clocks");
    let patches = values.get_u32("patches");
    Ok(LfbSwap { patches, merge_clocks, sent_clocks: merge_clocks + 40, overflow_clocks: 3 * merge_clocks + 80 }
        .checked()?)
}

fn a_frame_and_an_overflow(control: &LfbSwap) -> Scenario {
    let idle = LfbSwapIn { idle: 1, ..LfbSwapIn::default() };
    let mut script = Script::new(control, PE.period);
    let clear = |script: &mut Script<LfbSwap>, shown| {
        for patch in 0..control.patches.into() {
            script.clock(&LfbSwapIn { clears: 1, patch, shown, ..idle });
        }
    };
    clear(&mut script, 0);
    script.clock(&LfbSwapIn { draws: 1, ..idle });
    script.clock(&LfbSwapIn { done: 1, line: 1, ..idle });
    script.hold(&idle, 2);
    clear(&mut script, 0);
    script.hold(&LfbSwapIn { overflow: 1, idle: 0, ..idle }, control.merge_clocks + 4);
    // The global frame buffer shows the frame.
    script.hold(&LfbSwapIn { overflow: 1, idle: 0, shown: 1, ..idle }, 3);
    clear(&mut script, 1);
    script.hold(&LfbSwapIn { shown: 1, ..idle }, 4);
    script.finish(
        "a frame ends; in the next one a pixel finds no page, and waits for the swap of the global frame buffer",
    )
}

fn gfb_swap(values: &Values) -> Result<GfbSwap, CatalogError> {
    let (processors, merge_clocks) = (values.get_u32("processors"), values.get("merge-clocks"));
    Ok(GfbSwap { processors, merge_clocks, way: merge_clocks as u32 - 4, late: 8 }.checked()?)
}

fn two_frames(control: &GfbSwap) -> Scenario {
    let mut script = Script::new(control, MERGE.period);
    let all = |bit| vec![bit; control.processors as usize];
    for frame in [1, 0] {
        script.hold(&GfbSwapIn { frames: all(1 - frame), sending: all(0), enable: 1, blanking: 1 }, 3);
        script.hold(&GfbSwapIn { frames: all(frame), sending: all(1), enable: 1, blanking: 0 }, 4);
        let waits = control.merge_clocks + control.late - 4;
        script.hold(&GfbSwapIn { frames: all(frame), sending: all(0), enable: 1, blanking: 0 }, waits);
        script.hold(&GfbSwapIn { frames: all(frame), sending: all(0), enable: 1, blanking: 1 }, 3);
    }
    script.finish("two frames, each merged and shown in a blanking")
}
