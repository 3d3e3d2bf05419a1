//! Assertions: a simulation says which one fails, where and when, and stops; a formal tool proves them; synthesis does
//! not see them.

use super::layout::with_place;
use super::printer::Printer;
use tilewright_hdl::ir::{Assert, ClockId};

impl Printer<'_> {
    /// These assertions for a formal tool, and for a simulation. What they read counts as unread: a tool for synthesis
    /// finds nothing that reads it.
    pub fn assertions(&mut self, asserts: &[usize]) -> Vec<String> {
        let module = self.module;
        if asserts.is_empty() {
            return Vec::new();
        }
        let read = self.usage.clone();
        let clocks = || (0..module.clocks.len() as u32).map(ClockId);
        let mut out = vec!["`ifdef FORMAL".to_string()];
        clocks().for_each(|clock| out.extend(self.at_edge(clock, asserts, Self::proof)));
        out.extend(["`else".to_string(), "`ifndef SYNTHESIS".to_string()]);
        clocks().for_each(|clock| out.extend(self.at_edge(clock, asserts, Self::check)));
        out.extend(["`endif".to_string(), "`endif".to_string()]);
        self.usage = read;
        out
    }

    /// The assertions of a clock, each printed by `print`.
    fn at_edge(
        &mut self,
        clock: ClockId,
        asserts: &[usize],
        print: fn(&mut Self, &Assert) -> Vec<String>,
    ) -> Vec<String> {
        let asserts = asserts.iter().map(|&assert| &self.module.asserts[assert]).filter(|assert| assert.clock == clock);
        let body: Vec<String> = asserts.flat_map(|assert| print(self, assert)).collect();
        if body.is_empty() {
            return body;
        }
        let head = format!("always @(posedge {}) begin", self.clock_port(clock));
        let body = body.into_iter().map(|line| format!("    {line}"));
        [head].into_iter().chain(body).chain(["end".to_string()]).collect()
    }

    fn proof(&mut self, assert: &Assert) -> Vec<String> {
        let statement = format!("assert ({});", self.value(assert.condition));
        let line = match self.reset_is_low(assert.clock) {
            Some(low) => format!("if ({low}) {statement}"),
            None => statement,
        };
        vec![with_place(line, assert.loc)]
    }

    fn check(&mut self, assert: &Assert) -> Vec<String> {
        let fails = self.negated(assert.condition);
        let when = self.reset_is_low(assert.clock).map(|low| format!("{low} && ")).unwrap_or_default();
        vec![
            with_place(format!("if ({when}{fails}) begin"), assert.loc),
            format!("    $display(\"FAIL: time %0t: %m: {}\", $time);", escaped(&assert.message)),
            "    $stop;".to_string(),
            "end".to_string(),
        ]
    }

    fn reset_is_low(&mut self, clock: ClockId) -> Option<String> {
        self.module.clocks[clock.0 as usize].reset.as_ref()?;
        Some(format!("!{}", self.reset_port(clock)))
    }
}

/// A text within a format string of `$display`.
fn escaped(text: &str) -> String {
    let escape = |byte: u8| match byte {
        b'%' => "%%".to_string(),
        b'"' => "\\\"".to_string(),
        b'\\' => "\\\\".to_string(),
        b'\n' => "\\n".to_string(),
        b' '..=b'~' => char::from(byte).to_string(),
        byte => format!("\\{byte:03o}"),
    };
    text.bytes().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_legal_in_a_format_string() {
        assert_eq!(escaped("100% \"of\" a\\b\n\té"), r#"100%% \"of\" a\\b\n\011\303\251"#);
    }
}
