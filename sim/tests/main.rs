//! The simulator: circuits on every engine, and the effect of each pass on them.

mod circuits;
mod passes;

use tilewright_hdl::Design;
use tilewright_sim::{Pass, Passes, explain};

/// A design after a pass, as text.
fn text_after(design: &Design, pass: Pass, passes: &Passes) -> String {
    explain(design, passes).into_iter().find(|it| it.pass == pass).expect("every pass is explained").text
}
