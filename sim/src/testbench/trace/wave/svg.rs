//! Waves as pictures, for documents and reports.

mod layout;
mod rows;

use std::fmt::Write;

use self::layout::{Layout, Line};
use super::Wave;

/// Light, and dark where the reader's screen is.
const STYLE: &str = "\
:root{--page:#fffdf9;--ink:#1f2328;--muted:#5c6470;--line:#d9d5cc;--fine:#ece8e0;--bus:#eef3f9;--code:#f3ecdc;--wave:#1461a8;--clock:#5c6470;--taken:#0f7358}
@media screen and (prefers-color-scheme:dark){:root{--page:#14171b;--ink:#dfe2e6;--muted:#99a2ae;--line:#363d46;--fine:#23282f;--bus:#1d2836;--code:#2f2a1e;--wave:#6fb2f2;--clock:#99a2ae;--taken:#53c7a4}}
text{font:12px ui-monospace,\"SF Mono\",Menlo,Consolas,\"DejaVu Sans Mono\",monospace;fill:var(--ink)}
.page{fill:var(--page)}.group{font-weight:600}.time{font-size:10px;fill:var(--muted)}.value{font-size:11px}
.edge{stroke:var(--fine)}.line{stroke:var(--line)}.bit,.clock{fill:none;stroke:var(--wave);stroke-width:1.5;stroke-linejoin:round}.clock{stroke:var(--clock)}
.bus,.code{fill:var(--bus);stroke:var(--wave)}.code{fill:var(--code)}.taken{fill:var(--taken);stroke:var(--page)}
";

impl Wave {
    /// The wave as a picture, an SVG file, light or dark as the reader's screen is: the rows and the columns of the text, along an axis of time. A field of a record stands
    /// below the record's name. Where there is one clock, a dot is where an item of a stream is taken.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let wave = sim.record([sim.i.enable, sim.o.count]);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// let svg = wave.svg();
    /// assert!(svg.starts_with("<svg xmlns=") && svg.contains(">count</text>"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn svg(&self) -> String {
        let data = self.data();
        let layout = Layout::new(&data);
        let (width, height) = layout.size();
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
             <title>{}</title>\n<style>{STYLE}</style>\n<rect class=\"page\" width=\"{width}\" height=\"{height}\"/>\n",
            layout.about()
        );
        for block in layout.blocks() {
            block.axis(&mut svg);
            for (line, top) in layout.lines().iter().zip(block.tops()) {
                block.label(&mut svg, line, top);
                match line {
                    Line::Group(_) => {}
                    Line::Clock(clock) => block.clock(&mut svg, &data.clocks[*clock], top),
                    Line::Row { row, .. } => block.row(&mut svg, &data.rows[*row], top),
                }
            }
            block.taken(&mut svg);
        }
        if layout.has_streams() {
            let foot = height - layout::MARGIN;
            let _ = writeln!(
                svg,
                "<circle class=\"taken\" cx=\"{}\" cy=\"{}\" r=\"3.5\"/><text class=\"time\" x=\"{}\" y=\"{foot}\">an item of a stream is taken</text>",
                layout::MARGIN + 4.0,
                foot - 3.5,
                layout::MARGIN + 14.0
            );
        }
        svg + "</svg>\n"
    }
}

/// A text as XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests;
