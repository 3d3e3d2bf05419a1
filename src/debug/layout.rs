//! Where what stands on the page.

use super::state::{Mode, State};
use ratatui::layout::Rect;

/// The smallest page.
pub const LEAST: (u16, u16) = (40, 12);

/// The widest columns of names and of values, as parts of the page.
const NAMES: u16 = 3;
const VALUES: u16 = 6;

/// The lines and columns of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    pub area: Rect,
    /// The characters of a name, and of a value.
    pub name: u16,
    pub value: u16,
    /// Where the waves begin, and their characters.
    pub left: u16,
    pub wave: u16,
    /// The line of the cycles, above the clocks.
    pub axis: u16,
    /// The first line of the nets, and their number.
    pub top: u16,
    pub nets: u16,
    /// The line of the heading of the lower part, and the lines below it.
    pub heading: u16,
    pub lower: u16,
    /// The last line, for what is typed and for messages.
    pub foot: u16,
}

impl Layout {
    /// That of a page of this size, or nothing if it is too small.
    pub fn of(area: Rect, state: &State) -> Option<Layout> {
        if area.width < LEAST.0 || area.height < LEAST.1 {
            return None;
        }
        let clocks = state.sim.program().clocks.len().min(3) as u16;
        let widest = |texts: &mut dyn Iterator<Item = usize>| texts.max().unwrap_or(0).min(1000) as u16;
        let name = widest(&mut state.nets.iter().map(|net| net.name.chars().count())).clamp(3, area.width / NAMES);
        // As many digits as a hexadecimal number has, or the longest name of a code.
        let digits = state.nets.iter().map(|net| match net.kind.names() {
            Some(names) => names.codes.iter().map(|code| code.len()).max().unwrap_or(0),
            None => net.width.div_ceil(4) as usize + usize::from(net.kind != tilewright_hdl::ir::Kind::Number),
        });
        let value = widest(&mut { digits }).clamp(1, area.width / VALUES);
        let lower = match state.mode {
            Mode::Causes(_) => area.height / 2 - 1,
            _ => (area.height / 3).clamp(3, 12),
        };
        // The selected net has a sign in front.
        let left = 1 + name + 1 + value + 1;
        let (axis, foot) = (1, area.height - 1);
        let (top, heading) = (axis + 1 + clocks, foot - lower - 1);
        let nets = heading.saturating_sub(top).max(1);
        Some(Layout { area, name, value, left, wave: area.width - left, axis, top, nets, heading, lower, foot })
    }
}
