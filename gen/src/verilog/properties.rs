//! Properties. A simulation reports a failing assertion or assumption with its place and time, and ends with a
//! non-zero status, and shows the text of each display. With [`PRINTS_COVERS`] defined, it reports the first hit of each cover. A formal tool proves
//! assertions, relies on assumptions, and searches for covers. Synthesis does not see properties.

use super::layout::with_place;
use super::literal::{Style, literal};
use super::plan::Form;
use super::printer::Printer;
use super::text::format_text;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{ClockId, Directive, Format, Kind, Names, NodeId, Op, Piece, Property, Shown, Unary};

/// The option with which a simulator compiles that covers are printed.
///
/// ```
/// assert_eq!(tilewright_gen::tools::WITH_COVERS, "-DTILEWRIGHT_COVERS");
/// ```
pub const WITH_COVERS: &str = "-DTILEWRIGHT_COVERS";

/// The macro with which covers are printed: they do not matter in simulations of other people.
pub const PRINTS_COVERS: &str = WITH_COVERS.split_at(2).1;

/// Ends a simulation with a non-zero status. Without a terminal, Icarus ends with status 0 at `$stop`.
pub fn stop() -> Vec<String> {
    ["`ifdef __ICARUS__", "$finish_and_return(1);", "`else", "$stop;", "`endif"].map(str::to_owned).to_vec()
}

/// The name of a code, as a string that is padded to the length of the longest.
fn named(value: &str, width: u32, names: Names) -> String {
    let longest = names.codes.iter().map(|name| name.len()).max().unwrap_or(1);
    let padded = |name: &str| match longest - name.len() {
        0 => format!("\"{name}\""),
        missing => format!("{{{}'d0, \"{name}\"}}", 8 * missing),
    };
    let arms = names.codes.iter().zip(names.values);
    let arms: String = arms
        .map(|(name, code)| {
            let code = literal(&Bits::new(width, *code), Style::Count);
            format!("({value} == {code}) ? {} : ", padded(name))
        })
        .collect();
    arms + &padded("?")
}

impl Printer<'_> {
    /// The task that a failing assertion or assumption calls, if there are any.
    pub fn stop_task(&self) -> Vec<String> {
        let Some(name) = &self.stop else { return Vec::new() };
        let mut out = ["`ifndef SYNTHESIS", "`ifndef FORMAL"].map(str::to_owned).to_vec();
        out.extend([format!("task {name};"), "    begin".to_owned()]);
        out.extend(stop().into_iter().map(|line| if line.starts_with('`') { line } else { format!("        {line}") }));
        out.extend(["    end", "endtask", "`endif", "`endif"].map(str::to_owned));
        out
    }

    /// These properties for a formal tool and for a simulation, with the registers that only properties read. The
    /// nodes that they read count as unread, because a synthesis tool finds no reader.
    pub fn properties(&mut self, properties: &[usize]) -> Vec<String> {
        let module = self.module;
        if properties.is_empty() {
            return Vec::new();
        }
        let read = self.usage.clone();
        let properties: Vec<&Property> = properties.iter().map(|&index| &module.properties[index]).collect();
        let hits: Vec<Option<String>> = properties.iter().map(|property| self.hit(property)).collect();
        let clocks = || (0..module.clocks.len() as u32).map(ClockId);
        let mut out = vec!["`ifndef SYNTHESIS".to_string()];
        out.extend(self.stated_registers());
        out.push("`ifdef FORMAL".to_string());
        for clock in clocks() {
            let here = properties.iter().filter(|it| it.clock == clock);
            let body = here.filter_map(|property| self.formal(property)).collect();
            out.extend(self.at_edge(clock, body));
        }
        out.push("`else".to_string());
        for hit in hits.iter().flatten() {
            out.extend([format!("reg {hit};"), format!("initial {hit} = 1'b0;")]);
        }
        for clock in clocks() {
            let here = properties.iter().zip(&hits).filter(|(property, _)| property.clock == clock);
            let body = here.flat_map(|(property, hit)| self.simulated(property, hit.as_deref())).collect();
            out.extend(self.at_edge(clock, body));
        }
        out.push("`endif".to_string());
        out.extend(self.unread_of_stated());
        out.push("`endif".to_string());
        self.usage = read;
        out
    }

    /// The registers that only properties read.
    fn stated_registers(&mut self) -> Vec<String> {
        let registers = self.plain_registers(true);
        if registers.is_empty() || self.here.is_some() {
            return Vec::new();
        }
        let mut out = self.register_declarations(true);
        out.push(String::new());
        out.extend(self.register_blocks(&registers));
        out
    }

    /// The bits of these registers that no property reads, for linters.
    fn unread_of_stated(&mut self) -> Option<String> {
        if self.here.is_some() {
            return None;
        }
        let nodes = self.plain_registers(true).into_iter().map(|index| self.module.registers[index].node);
        let parts: Vec<String> = nodes.flat_map(|node| self.unread_parts(node, self.name(node))).collect();
        (!parts.is_empty())
            .then(|| format!("wire {} = &{{1'b0, {}}};", self.taken.fresh("_unused_stated"), parts.join(", ")))
    }

    /// The statements at the edges of a clock, if there are any.
    fn at_edge(&mut self, clock: ClockId, body: Vec<String>) -> Vec<String> {
        if body.is_empty() {
            return body;
        }
        let head = format!("always @({}) begin", self.edge(clock));
        let body = body.into_iter().map(|line| format!("    {line}"));
        let block = [head].into_iter().chain(body).chain(["end".to_string()]);
        if !self.module.clocks[clock.0 as usize].kind.is_asynchronous() {
            return block.collect();
        }
        // Verilator warns of a reset that is both asynchronous and sampled.
        let off = "/* verilator lint_off SYNCASYNCNET */ // the reset suspends these".to_string();
        let on = "/* verilator lint_on SYNCASYNCNET */".to_string();
        [off].into_iter().chain(block).chain([on]).collect()
    }

    /// The register that records that a cover was hit.
    fn hit(&mut self, property: &Property) -> Option<String> {
        (property.directive == Directive::Cover).then(|| self.label("is_covered"))
    }

    fn formal(&mut self, property: &Property) -> Option<String> {
        let word = match property.directive {
            Directive::Assert => "assert",
            Directive::Assume => "assume",
            Directive::Cover => "cover",
            Directive::Display => return None,
        };
        let statement = format!("{word} ({});", self.value(property.condition));
        let line = match self.out_of_reset(property.clock) {
            Some(runs) => format!("if ({runs}) {statement}"),
            None => statement,
        };
        Some(with_place(line, property.loc))
    }

    fn simulated(&mut self, property: &Property, hit: Option<&str>) -> Vec<String> {
        let message = format_text(&property.message);
        let (when, body) = match (property.directive, hit) {
            (Directive::Cover, Some(hit)) => (
                format!("{} && !{hit}", self.operand(property.condition, Style::Count)),
                vec![
                    format!("`ifdef {PRINTS_COVERS}"),
                    format!("$display(\"COVER: time %0t: %m: {message}\", $time);"),
                    "`endif".to_owned(),
                    format!("{hit} <= 1'b1;"),
                ],
            ),
            (Directive::Display, _) => (self.operand(property.condition, Style::Count), vec![self.display(property)]),
            (directive, _) => {
                let blames = if directive == Directive::Assume { "the stimulus breaks an assumption: " } else { "" };
                let says = format!("$display(\"FAIL: time %0t: %m: {blames}{message}\", $time);");
                let stop = self.stop.as_ref().expect("a module that asserts something has the task");
                let stop = format!("{stop};");
                (self.fails(property.condition), vec![says, stop])
            }
        };
        let reset = self.out_of_reset(property.clock).map(|runs| format!("{runs} && ")).unwrap_or_default();
        let head = with_place(format!("if ({reset}{when}) begin"), property.loc);
        let body = body.into_iter().map(|line| format!("    {line}"));
        [head].into_iter().chain(body).chain(["end".to_string()]).collect()
    }

    /// The statement that shows the text of a display with its values.
    fn display(&mut self, property: &Property) -> String {
        let pieces = Piece::of(&property.message).expect("the text of a display in a design is sound");
        let (mut text, mut arguments, mut values) = (String::new(), String::new(), property.values.iter());
        for piece in pieces {
            match piece {
                Piece::Text(plain) => text += &format_text(&plain),
                Piece::Value(format) => {
                    let shown = values.next().expect("a value for each place");
                    let (place, argument) = self.shown(format, *shown);
                    text += place;
                    arguments += &format!(", {argument}");
                }
            }
        }
        format!("$display(\"{text}\"{arguments});")
    }

    /// A value of a display: its place in the format string, and the argument.
    fn shown(&mut self, format: Format, Shown { node, kind }: Shown) -> (&'static str, String) {
        let value = self.value(node);
        // Braces give an operator its own width.
        let value = if self.plan.form(node) == Form::Inline { format!("{{{value}}}") } else { value };
        match (format, kind) {
            (Format::Hexadecimal, _) => ("%0h", value),
            (Format::Binary, _) => ("%0b", value),
            (Format::Plain, Kind::Number) => ("%0d", value),
            (Format::Plain, Kind::Signed) => ("%0d", format!("$signed({value})")),
            (Format::Plain, Kind::Code(names)) => ("%0s", named(&value, self.module.width(node), names)),
        }
    }

    /// The negation of a condition, as an operand of `&&`.
    fn fails(&mut self, condition: NodeId) -> String {
        match self.module.node(condition).op {
            Op::Unary(Unary::Not, of) if self.plan.form(condition) == Form::Inline => self.operand(of, Style::Count),
            _ => format!("!{}", self.operand(condition, Style::Count)),
        }
    }
}
