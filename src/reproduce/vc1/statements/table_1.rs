//! Section 5.3, Table 1: the virtual local frame buffer beside regions.

use super::super::found::Found;
use super::super::table::Column;
use super::{WITHIN_1, WITHIN_10};
use tilewright_report::Statement;

pub fn statements(found: &Found) -> Vec<Statement> {
    let Some(vlfb) = Column::vlfb(found) else { return Vec::new() };
    vec![
        Statement::new(
            "VC1-T1",
            "With virtual local frame buffers ter1k takes 33.4 ms, as a mean over 48 views.",
            WITHIN_1,
        )
        .unit("ms")
        .paper([33.4])
        .found(found.model(), [vlfb.time]),
        Statement::new("VC1-T1", "A processing element waits for 1.4 ms of them for the others.", WITHIN_10)
            .unit("ms")
            .paper([1.4])
            .found(found.model(), [vlfb.synchronization]),
    ]
}
