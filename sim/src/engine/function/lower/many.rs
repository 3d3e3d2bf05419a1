//! Operations with very many operands become several with fewer, so that no step of a function is long, and functions
//! can be cut between them.

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;

use crate::engine::program::{Cell, Kind, Lowered, Piece, ValueId};
use crate::engine::rewrite::Rewriter;

/// The most arms or parts of an operation.
const MOST: usize = 64;
/// From this number of parts on, a concatenation is checked for pieces of a few values.
const MANY: usize = 1024;
/// Bits of a machine register.
const REGISTER: u32 = 64;

/// An operation with fewer operands that is equivalent to a large choice or concatenation.
pub(super) fn fewer(rewriter: &mut Rewriter, cell: &Cell) -> Option<Kind> {
    let Cell { lanes, width, .. } = *cell;
    match &cell.kind {
        Kind::Select { arms, default } if arms.len() > MOST => {
            let choice = |default, arms: &[(ValueId, ValueId)]| Kind::Select { arms: arms.to_vec(), default };
            Some(chain(rewriter, arms, *default, (lanes, width), choice))
        }
        Kind::Case { subject, arms, default } if arms.len() > MOST => {
            let choice =
                |default, arms: &[(Bits, ValueId)]| Kind::Case { subject: *subject, arms: arms.to_vec(), default };
            Some(chain(rewriter, arms, *default, (lanes, width), choice))
        }
        Kind::Concat(parts) if parts.len() > MANY && lanes == 1 => {
            let parts = assembled(rewriter, parts);
            Some(if let &[one] = parts.as_slice() { Kind::Alias(one) } else { concat(rewriter, &parts, lanes) })
        }
        Kind::Concat(parts) if parts.len() > MOST => Some(concat(rewriter, parts, lanes)),
        _ => None,
    }
}

/// A choice among the first arms, whose default is the choice among the others.
fn chain<A>(
    rewriter: &mut Rewriter,
    arms: &[A],
    default: ValueId,
    (lanes, width): (u32, u32),
    choice: impl Fn(ValueId, &[A]) -> Kind,
) -> Kind {
    let (first, rest) = arms.split_at(MOST);
    let default =
        rest.chunks(MOST).rev().fold(default, |default, arms| rewriter.add(choice(default, arms), lanes, width));
    choice(default, first)
}

/// Parts side by side.
fn concat(rewriter: &mut Rewriter, parts: &[ValueId], lanes: u32) -> Kind {
    Kind::Concat(grouped(rewriter, parts, lanes))
}

/// Parts, the most significant first; successive pieces of the same few values are assembled.
fn assembled(rewriter: &mut Rewriter, parts: &[ValueId]) -> Vec<ValueId> {
    let (mut groups, mut open) = (Vec::new(), Open::default());
    for &part in parts.iter().rev() {
        let Cell { ref kind, width, .. } = rewriter.circuit()[part];
        let (of, low) = if let Kind::Slice(of, low) = *kind { (of, low) } else { (part, 0) };
        if !open.numbers.contains_key(&of) && open.of.len() == MOST {
            groups.extend(std::mem::take(&mut open).close(rewriter));
        }
        open.add(part, of, low, width);
    }
    groups.extend(open.close(rewriter));
    groups.reverse();
    groups
}

/// Parts that are being assembled, the least significant first.
#[derive(Default)]
struct Open {
    parts: Vec<ValueId>,
    of: Vec<ValueId>,
    /// The index of each value among them.
    numbers: FxHashMap<ValueId, u32>,
    pieces: Vec<Piece>,
}

impl Open {
    fn add(&mut self, part: ValueId, of: ValueId, low: u32, width: u32) {
        let number = *self.numbers.entry(of).or_insert_with(|| {
            self.of.push(of);
            self.of.len() as u32 - 1
        });
        self.parts.push(part);
        self.pieces.push(Piece { of: number, low, width });
    }

    /// One value, if there are many pieces; otherwise the parts as they are.
    fn close(self, rewriter: &mut Rewriter) -> Vec<ValueId> {
        if self.pieces.len() <= 4 * MOST {
            return self.parts;
        }
        let width = self.pieces.iter().map(|piece| piece.width).sum();
        let kind = Kind::Lowered(Lowered::Assemble { of: self.of, pieces: self.pieces });
        vec![rewriter.add(kind, 1, width)]
    }
}

/// Concatenates parts, the most significant first: first into registers, and then in groups until few remain.
fn grouped(rewriter: &mut Rewriter, parts: &[ValueId], lanes: u32) -> Vec<ValueId> {
    let mut parts = group(rewriter, parts, lanes, |width, _| width <= REGISTER);
    while parts.len() > MOST {
        parts = group(rewriter, &parts, lanes, |_, count| count <= MOST);
    }
    parts
}

/// Groups successive parts as long as their width and number are allowed.
fn group(rewriter: &mut Rewriter, parts: &[ValueId], lanes: u32, may_be: impl Fn(u32, usize) -> bool) -> Vec<ValueId> {
    let (mut groups, mut open, mut width) = (Vec::new(), Vec::new(), 0);
    let mut close = |rewriter: &mut Rewriter, open: &mut Vec<ValueId>, width: u32| match std::mem::take(open).as_slice()
    {
        [] => {}
        &[one] => groups.push(one),
        several => groups.push(rewriter.add(Kind::Concat(several.to_vec()), lanes, width)),
    };
    // From the lowest on, so that most groups are whole limbs of the result.
    for &part in parts.iter().rev() {
        let more = rewriter.circuit()[part].width;
        if !may_be(width + more, open.len() + 1) {
            open.reverse();
            close(rewriter, &mut open, width);
            width = 0;
        }
        open.push(part);
        width += more;
    }
    open.reverse();
    close(rewriter, &mut open, width);
    groups.reverse();
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Passes;

    /// The largest number of operands of a circuit's operations, and the kind of the last one.
    fn made(operands: u32, make: impl Fn(&mut Rewriter, &[ValueId]) -> Cell) -> (usize, Kind) {
        let mut rewriter = Rewriter::new(&Passes::default());
        let states: Vec<ValueId> = (0..operands).map(|number| rewriter.state(1, 1 + number % 3)).collect();
        let flags: Vec<ValueId> = states.iter().copied().filter(|id| rewriter.circuit()[*id].width == 1).collect();
        let cell = make(&mut rewriter, if operands.is_multiple_of(2) { &states } else { &flags });
        let kind = fewer(&mut rewriter, &cell).expect("it has many");
        let last = rewriter.add(kind, cell.lanes, cell.width);
        let count = |(_, cell): (ValueId, &Cell)| {
            let mut count = 0;
            cell.kind.for_each_operand(|_| count += 1);
            count
        };
        let most = rewriter.circuit().cells().map(count).max().expect("there are cells");
        (most, rewriter.circuit()[last].kind.clone())
    }

    #[test]
    fn no_operation_of_many_operands_is_left() {
        let select = |_: &mut Rewriter, flags: &[ValueId]| {
            let arms = flags.iter().map(|flag| (*flag, flags[0])).collect();
            Cell::new(Kind::Select { arms, default: flags[1] }, 1, 1)
        };
        let side_by_side = |rewriter: &mut Rewriter, parts: &[ValueId]| {
            let width = parts.iter().map(|part| rewriter.circuit()[*part].width).sum();
            Cell::new(Kind::Concat(parts.to_vec()), 1, width)
        };
        assert!(made(30_001, select).0 <= 2 * MOST + 1);
        assert!(made(30_000, side_by_side).0 <= MOST);
        assert!(made(70, side_by_side).0 <= MOST);
    }

    #[test]
    fn many_pieces_of_few_values_are_put_together_at_once() {
        let pieces = |rewriter: &mut Rewriter, values: &[ValueId]| {
            let bit = |number: u32| rewriter.add(Kind::Slice(values[(number % 3) as usize], 0), 1, 1);
            let bits: Vec<ValueId> = (0..5000).map(bit).collect();
            Cell::new(Kind::Concat(bits), 1, 5000)
        };
        let (most, kind) = made(10, pieces);
        let Kind::Lowered(Lowered::Assemble { of, pieces }) = kind else { panic!("{kind:?}") };
        assert_eq!((most, of.len(), pieces.len()), (3, 3, 5000));
    }
}
