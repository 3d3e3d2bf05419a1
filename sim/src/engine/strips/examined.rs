//! What the checks find of strip programs, and of their mutants.

use super::bounds::{Access, Base, Surroundings};
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
    /// Masks and minima of addresses that were left out of a program, one at a time. Each makes a range smaller.
    pub clamps: usize,
    /// The programs without one that were refused. In the others, indices stay in the padding of their allocation, or
    /// another clamp follows.
    pub refused: usize,
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
        match program.check(memory) {
            Err(sentence) => self.wrong.push(format!("{sentence}\n{text}")),
            Ok(bounds) => self.accesses += bounds.accesses.len(),
        }
        let is_state = |address: Value, offset: i32| {
            let same = |access: &&Access| (access.address, access.offset) == (address, offset.into());
            let access = program.bounds(memory).ok().and_then(|it| it.accesses.iter().find(same).copied());
            access.is_some_and(|access| access.extent.is_state && access.base == Base::State)
        };
        let mut mutant = program.clone();
        if read_late(&mut mutant.values, &mut mutant.body, &is_state) {
            self.late += 1;
            let bounds = mutant.bounds(memory);
            self.found += usize::from(bounds.is_ok_and(|bounds| mutant.commits(&bounds, &mut Vec::new()).is_err()));
        }
        let Ok(bounds) = program.bounds(memory) else { return };
        let is_needed = |clamp: &Value| {
            let most = |value: &Value| bounds.facts[value.index()].range(Type::I64).1;
            matches!(&program.values[clamp.index()].0, Operation::Binary(_, x, _) if most(x) > most(clamp))
        };
        let clamps: Vec<Value> = program.clamps().into_iter().filter(is_needed).collect();
        for clamp in clamps.iter().step_by(clamps.len() / CLAMPS + 1) {
            let mut mutant = program.clone();
            let Operation::Binary(binary, x, y) = &mut mutant.values[clamp.index()].0 else { continue };
            // The same as its operand.
            (*binary, *y) = (Binary::Min, *x);
            self.clamps += 1;
            self.refused += usize::from(mutant.bounds(memory).is_err());
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
    /// The masks and minima that addresses depend on.
    fn clamps(&self) -> Vec<Value> {
        let (mut open, mut seen) = (Vec::new(), vec![false; self.values.len()]);
        self.addresses(&self.body, &mut open);
        let mut clamps = Vec::new();
        while let Some(value) = open.pop() {
            let (operation, ty) = &self.values[value.index()];
            if std::mem::replace(&mut seen[value.index()], true) || *ty != Type::I64 {
                continue;
            }
            match operation {
                Operation::Load { .. } | Operation::Call(..) => {}
                _ => operation.for_each_operand(|operand| open.push(operand)),
            }
            if matches!(operation, Operation::Binary(Binary::Min | Binary::And, ..)) {
                clamps.push(value);
            }
        }
        clamps.sort_unstable();
        clamps
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
