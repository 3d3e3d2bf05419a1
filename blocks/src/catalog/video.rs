//! The entries of blocks between a picture and its screen.

use crate::{Scan, TmdsEncoder, TmdsEncoderIn, VideoTiming, VideoTimingIn};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, elaborate};

pub(super) const VIDEO_TIMING: Entry = Entry {
    name: "video-timing",
    summary: "gives the positions and the sync pulses of a screen",
    parameters: &[
        Parameter { name: "columns", default: 4, min: 1, max: 4096, meaning: "visible pixels of a line" },
        Parameter { name: "rows", default: 2, min: 1, max: 4096, meaning: "visible lines of a frame" },
    ],
    design: |values| Ok(elaborate(&video_timing(values))?),
    scenario: |values| Ok(a_frame(&video_timing(values))),
};

pub(super) const TMDS_ENCODER: Entry = Entry {
    name: "tmds-encoder",
    summary: "encodes the bytes of a colour as symbols of DVI",
    parameters: &[],
    design: |_| Ok(elaborate(&TmdsEncoder)?),
    scenario: |_| Ok(a_row_of_pixels()),
};

fn video_timing(values: &Values) -> VideoTiming {
    let [columns, rows] = ["columns", "rows"].map(|name| values.get_u32(name));
    VideoTiming { columns: Scan::new(columns, [1, 2, 1], false), rows: Scan::new(rows, [1, 1, 1], false) }
}

fn a_frame(timing: &VideoTiming) -> Scenario {
    let mut script = Script::new(timing, DEFAULT_PERIOD);
    let clocks = u64::from(timing.columns.total()) * u64::from(timing.rows.total());
    script.hold(&VideoTimingIn { enable: 1 }, 3);
    script.hold(&VideoTimingIn { enable: 0 }, 2);
    script.hold(&VideoTimingIn { enable: 1 }, clocks.min(400));
    script.finish("a frame from its first pixel on, with a pause after three; a large one is cut off")
}

fn a_row_of_pixels() -> Scenario {
    let mut script = Script::new(&TmdsEncoder, DEFAULT_PERIOD);
    for control in 0..4 {
        script.clock(&TmdsEncoderIn { active: 0, data: 0xff, control });
    }
    for data in [0, 0, 0x10, 0xff, 0x55, 0xff, 0] {
        script.clock(&TmdsEncoderIn { active: 1, data, control: 0 });
    }
    script.hold(&TmdsEncoderIn { active: 0, data: 0, control: 0 }, 3);
    script.finish("the four symbols outside the picture, and then pixels: black twice, colours, and black")
}
