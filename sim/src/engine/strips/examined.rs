//! What the checks find of strip programs, and of their mutants.

use super::bounds::{Access, Base, Bounds, Surroundings};
use super::operation::{Binary, Load, Operation};
use super::program::{Program, Region, Statement};
use super::text::Notes;
use super::value::{Type, Value};

/// What the checks find of the strip programs of a design, for tests.
#[doc(hidden)]
#[derive(Debug, Clone, Default)]
pub struct Examined {
    /// Programs, and accesses of theirs that are shown to stay in one allocation.
    pub programs: usize,
    pub accesses: usize,
    /// Programs that ran on large numbers, in which each value was what the checks know of it.
    pub probed: usize,
    /// Masks and minima of addresses that were left out of a program, one at a time. Each makes a range smaller.
    pub clamps: usize,
    /// The programs without one that were refused, and those of them that leave their memory when they run on large
    /// numbers.
    pub refused: usize,
    pub wild: usize,
    /// The others, in which the index stays in the padding of its allocation, and those in which something else bounds
    /// it.
    pub padded: usize,
    pub bounded: usize,
    /// Programs that read a place of the state again after they have changed it, and those that were refused.
    pub late: usize,
    pub found: usize,
    /// The sentence about each program that is wrong, or whose text means another one.
    pub wrong: Vec<String>,
}

/// The clamps of a program that are left out.
const CLAMPS: usize = 4;

impl Examined {
    /// Examines a program in this memory.
    pub(in crate::engine) fn add(&mut self, program: &Program, memory: &dyn Surroundings) {
        self.programs += 1;
        let (text, addresses) = program.text_and_addresses(&Notes::NONE);
        match Program::parse(&text, &addresses) {
            Err(sentence) => self.wrong.push(format!("{sentence}\n{text}")),
            Ok(parsed) if parsed != program.settled() || parsed.text(&Notes::NONE) != text => {
                self.wrong.push(format!("the text means another program\n{text}"));
            }
            Ok(_) => {}
        }
        let bounds = match program.check(memory) {
            Err(sentence) => return self.wrong.push(format!("{sentence}\n{text}")),
            Ok(bounds) => bounds,
        };
        self.accesses += bounds.accesses.len();
        match program.probe_facts(&bounds, memory.has_units()) {
            Err(sentence) => self.wrong.push(format!("{sentence}\n{text}")),
            Ok(ran) => self.probed += usize::from(ran),
        }
        self.read_late(program, &bounds, memory);
        self.unclamp(program, &bounds, memory);
    }

    /// Examines the program that reads again what it has changed.
    fn read_late(&mut self, program: &Program, bounds: &Bounds, memory: &dyn Surroundings) {
        let is_state = |address: Value, offset: i32| {
            let same = |access: &&Access| (access.address, access.offset) == (address, offset.into());
            let access = bounds.accesses.iter().find(same);
            access.is_some_and(|access| access.extent.is_state && access.base == Base::State)
        };
        let mut mutant = program.clone();
        if read_late(&mut mutant.values, &mut mutant.body, &is_state) {
            self.late += 1;
            let bounds = mutant.bounds(memory);
            self.found += usize::from(bounds.is_ok_and(|bounds| mutant.commits(&bounds, &mut Vec::new()).is_err()));
        }
    }

    /// Examines programs without a clamp. Those that are not refused stay in their allocations for a reason.
    fn unclamp(&mut self, program: &Program, bounds: &Bounds, memory: &dyn Surroundings) {
        let slice = program.of_addresses();
        let most = |value: Value| bounds.facts[value.index()].range(Type::I64).1;
        let is_needed = |clamp: &Value| match program.values[clamp.index()].0 {
            Operation::Binary(Binary::Min | Binary::And, x, _) => most(x) > most(*clamp),
            _ => false,
        };
        let clamps: Vec<Value> = slice.iter().copied().filter(is_needed).collect();
        for clamp in clamps.iter().step_by(clamps.len() / CLAMPS + 1) {
            let mutant = program.without_clamp(*clamp);
            self.clamps += 1;
            let run = mutant.probe(bounds, memory.has_units());
            let Ok(loose) = mutant.bounds(memory) else {
                self.refused += 1;
                self.wild += usize::from(run.is_err());
                continue;
            };
            let is_wider = |value: Value| bounds.facts[value.index()] != loose.facts[value.index()];
            let pairs = || bounds.accesses.iter().zip(&loose.accesses);
            let is_explained = match pairs().any(|(access, _)| is_wider(access.address)) {
                true => {
                    self.padded += 1;
                    pairs().all(|(access, other)| (access.base, access.extent) == (other.base, other.extent))
                }
                false => {
                    self.bounded += 1;
                    program.is_bounded(&slice, is_wider)
                }
            };
            if run.is_err() || !is_explained {
                let text = mutant.text(&Notes::NONE);
                self.wrong.push(format!("without the clamp {} it leaves its allocation: {run:?}\n{text}", clamp.0));
            }
        }
    }
}

/// Loads a place of the state again after the first store to what was loaded; returns whether there is one.
fn read_late(values: &mut Vec<(Operation, Type)>, region: &mut Region, is_state: &dyn Fn(Value, i32) -> bool) -> bool {
    (0..region.len()).any(|index| match &mut region[index] {
        Statement::Store { address, offset, .. } => {
            let place = (*address, *offset);
            let loads = |value: &Value| match values[value.index()].0 {
                Operation::Load { load: Load::Whole, address, offset, .. } => (address, offset) == place,
                _ => false,
            };
            let load = region[..index].iter().find_map(|statement| match statement {
                Statement::Let(value) => Some(*value).filter(loads),
                _ => None,
            });
            let Some(load) = load.filter(|_| is_state(place.0, place.1)) else { return false };
            values.push(values[load.index()].clone());
            region.insert(index + 1, Statement::Let(Value(values.len() as u32 - 1)));
            true
        }
        Statement::Loop(all) => read_late(values, &mut all.body, is_state),
        Statement::If { then, otherwise, .. } => {
            read_late(values, then, is_state) || read_late(values, otherwise, is_state)
        }
        _ => false,
    })
}

impl Program {
    /// The program in which a mask or minimum is the same as its first operand.
    fn without_clamp(&self, clamp: Value) -> Program {
        let mut mutant = self.clone();
        if let Operation::Binary(binary, x, y) = &mut mutant.values[clamp.index()].0 {
            (*binary, *y) = (Binary::Min, *x);
        }
        mutant
    }

    /// Whether each wider number ends at another mask or minimum, at a remainder, or beside bits that are as high as its
    /// own.
    fn is_bounded(&self, slice: &[Value], is_wider: impl Fn(Value) -> bool) -> bool {
        let ends = |value: &&Value| {
            let mut takes = false;
            self.values[value.index()].0.for_each_operand(|operand| takes |= is_wider(operand));
            takes && !is_wider(**value)
        };
        let bounds = |value: &Value| {
            let operation = &self.values[value.index()].0;
            // A difference is bounded as a remainder alone.
            matches!(operation, Operation::Binary(Binary::Min | Binary::And | Binary::Or | Binary::Sub, ..))
        };
        let mut all = slice.iter().filter(ends).peekable();
        all.peek().is_some() && all.all(bounds)
    }

    /// The numbers that addresses are made of.
    fn of_addresses(&self) -> Vec<Value> {
        let (mut open, mut seen) = (Vec::new(), vec![false; self.values.len()]);
        self.addresses(&self.body, &mut open);
        let mut slice = Vec::new();
        while let Some(value) = open.pop() {
            let (operation, ty) = &self.values[value.index()];
            if std::mem::replace(&mut seen[value.index()], true) || *ty != Type::I64 {
                continue;
            }
            slice.push(value);
            match operation {
                Operation::Load { .. } | Operation::Call(..) => {}
                _ => operation.for_each_operand(|operand| open.push(operand)),
            }
        }
        slice.sort_unstable();
        slice
    }

    /// The addresses of the accesses in a region.
    fn addresses(&self, region: &Region, out: &mut Vec<Value>) {
        for statement in region {
            match statement {
                Statement::Let(value) => {
                    if let Operation::Load { address, .. } = self.values[value.index()].0 {
                        out.push(address);
                    }
                }
                Statement::Store { address, .. } => out.push(*address),
                Statement::If { then, otherwise, .. } => {
                    self.addresses(then, out);
                    self.addresses(otherwise, out);
                }
                Statement::Switch { regions, .. } => regions.iter().for_each(|region| self.addresses(region, out)),
                Statement::Loop(all) => self.addresses(&all.body, out),
                _ => {}
            }
        }
    }
}
