//! The paper's generators: square matrices on a square screen, for rectangles, with serial test units.

use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::format::{Format, Matrix};
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::processor::{Queues, VideoProcessor};
use tilewright_rtl::quadtree::raster::Form;

/// Edges of a rectangle, ke. A serial test takes this number of clocks, the paper's t_e.
pub(super) const EDGES: u32 = 4;
/// Size of the broadcast's queue in packets. It makes no difference if the geometry processor always has the next packet.
pub(super) const BROADCAST: u32 = 2;

/// 2^k x 2^k video processors for 2^m x 2^m pixels.
pub(super) fn square(
    (m, k): (u32, u32),
    aperture: u32,
    form: &str,
    queues: Queues,
) -> Result<QuadtreeGenerator, ParameterError> {
    let [side, processors] = [m, k].map(|power| 1_u32.checked_shl(power).unwrap_or(u32::MAX));
    let format = Format::new(Screen::new(side, side)?, Matrix::new(processors, processors)?, EDGES)?;
    let format = format.with_aperture(aperture)?;
    let form = Form::parse(form, &format)?;
    Ok(QuadtreeGenerator { video_processor: VideoProcessor { format, form, test: Test::Serial, queues }.checked()? })
}
