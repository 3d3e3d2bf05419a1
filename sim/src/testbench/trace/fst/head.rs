//! What is before the changes: the header, the hierarchy and the geometry.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use vcd::{IdCode, Parser, Scope, ScopeItem, ScopeType, Var, VarType};

use super::number::{gzip, long, shorter, unsigned};
use crate::testbench::trace::vcd_header;

/// The types of the blocks.
const HEADER: u8 = 0;
const GEOMETRY: u8 = 3;
const HIERARCHY: u8 = 4;

/// Tags in a hierarchy.
const SCOPE: u8 = 254;
const UP: u8 = 255;

/// The length of the header's block, without its type.
const HEADER_LENGTH: u64 = 329;
/// The room for the name of the program, and for the date, which remains empty.
const VERSION_LENGTH: usize = 128;
const DATE_LENGTH: usize = 119;
/// A picosecond is 10^-12 s.
const TIME_SCALE: i8 = -12;

/// Scopes and variables, and the numbers of the header.
#[derive(Default)]
pub struct Head {
    hierarchy: Vec<u8>,
    scopes: u64,
    /// The variables with all their names.
    names: u64,
    known: HashSet<IdCode>,
    /// The width of each variable; `None` for a string.
    widths: Vec<Option<u32>>,
    times: Option<RangeInclusive<u64>>,
    sections: u64,
}

impl Head {
    /// That of a file with the scopes and variables of this header.
    pub fn of(header: &vcd_header::Header) -> Head {
        let parsed = Parser::new(&header.text[..]).parse_header().expect("it was written as a header");
        let mut head = Head::default();
        parsed.items.iter().for_each(|item| head.item(item));
        head
    }

    /// The width of each variable; `None` for a string.
    pub fn widths(&self) -> &[Option<u32>] {
        &self.widths
    }

    /// Whether there is no block with changes.
    pub fn is_empty(&self) -> bool {
        self.sections == 0
    }

    /// Takes note of a block with changes at these times.
    pub fn add(&mut self, times: RangeInclusive<u64>) {
        let start = self.times.as_ref().map_or(*times.start(), |all| *all.start());
        self.times = Some(start..=*times.end());
        self.sections += 1;
    }

    fn item(&mut self, item: &ScopeItem) {
        match item {
            ScopeItem::Scope(scope) => self.scope(scope),
            ScopeItem::Var(variable) => self.variable(variable),
            _ => {}
        }
    }

    fn scope(&mut self, scope: &Scope) {
        self.scopes += 1;
        let kind = if scope.scope_type == ScopeType::Begin { 3 } else { 0 };
        self.hierarchy.extend_from_slice(&[SCOPE, kind]);
        self.text(&scope.identifier);
        // The name of the module, which a VCD file does not have either.
        self.text("");
        scope.items.iter().for_each(|item| self.item(item));
        self.hierarchy.push(UP);
    }

    fn variable(&mut self, variable: &Var) {
        self.names += 1;
        let (kind, width) = match variable.var_type {
            VarType::String => (21, None),
            VarType::Reg => (5, Some(variable.size)),
            _ => (16, Some(variable.size)),
        };
        // The second is the direction, which a VCD file does not have either.
        self.hierarchy.extend_from_slice(&[kind, 0]);
        let index = variable.index.map_or_else(String::new, |index| format!(" {index}"));
        self.text(&format!("{}{index}", variable.reference));
        unsigned(&mut self.hierarchy, width.unwrap_or(0).into());
        // A further name has the number of its variable, from 1.
        let alias = if self.known.insert(variable.code) { 0 } else { number(variable.code) + 1 };
        unsigned(&mut self.hierarchy, alias);
        if alias == 0 {
            assert_eq!(number(variable.code), self.widths.len() as u64, "variables are numbered in sequence");
            self.widths.push(width);
        }
    }

    fn text(&mut self, text: &str) {
        self.hierarchy.extend_from_slice(text.as_bytes());
        self.hierarchy.push(0);
    }

    /// The block of the header, as of now.
    pub fn header(&self) -> Vec<u8> {
        let mut block = vec![HEADER];
        long(&mut block, HEADER_LENGTH);
        let (start, end) = self.times.as_ref().map_or((0, 0), |times| (*times.start(), *times.end()));
        long(&mut block, start);
        long(&mut block, end);
        // Readers tell by this how a float is written.
        block.extend_from_slice(&std::f64::consts::E.to_le_bytes());
        // The memory that the writer needed, which nobody reads.
        long(&mut block, 0);
        for count in [self.scopes, self.names, self.widths.len() as u64, self.sections] {
            long(&mut block, count);
        }
        block.extend_from_slice(&TIME_SCALE.to_be_bytes());
        let version = concat!("Tilewright ", env!("CARGO_PKG_VERSION"));
        block.extend_from_slice(version.as_bytes());
        block.resize(block.len() + VERSION_LENGTH - version.len() + DATE_LENGTH, 0);
        // The names are those of Verilog, and time is counted from 0.
        block.push(0);
        long(&mut block, 0);
        block
    }

    /// The blocks from the header to the geometry.
    pub fn blocks(&self) -> Vec<u8> {
        let mut blocks = self.header();
        let packed = gzip(&self.hierarchy);
        blocks.push(HIERARCHY);
        long(&mut blocks, 16 + packed.len() as u64);
        long(&mut blocks, self.hierarchy.len() as u64);
        blocks.extend_from_slice(&packed);

        let mut geometry = Vec::new();
        for width in &self.widths {
            unsigned(&mut geometry, width.unwrap_or(u32::MAX).into());
        }
        let packed = shorter(&geometry);
        blocks.push(GEOMETRY);
        long(&mut blocks, 24 + packed.len() as u64);
        long(&mut blocks, geometry.len() as u64);
        long(&mut blocks, self.widths.len() as u64);
        blocks.extend_from_slice(&packed);
        blocks
    }
}

/// The number of a variable with this code.
fn number(code: IdCode) -> u64 {
    // The digits are the characters from `!` on, the lowest first, without a zero.
    code.to_string().bytes().rev().fold(0, |number, digit| number * 94 + u64::from(digit - b'!') + 1) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_has_its_number() {
        for number in [0, 1, 93, 94, 95, 94 * 94 + 93, 94 * 94 + 94, 80_000_000] {
            assert_eq!(super::number(IdCode::from(number)), number);
        }
    }
}
