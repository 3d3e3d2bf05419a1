//! The types of operations that a check of a strip program accepts, beside those that Cranelift accepts.

use cranelift_codegen::ir::{self, UserFuncName};
use cranelift_codegen::isa::CallConv;
use cranelift_codegen::settings::{self, Flags};
use cranelift_codegen::verify_function;

use super::{signature, translate};
use crate::engine::strips::{BINARIES, COMPARISONS, LOADS, Load, Operation, Program, Statement, Type, UNARIES, Value};

/// Numbers, and vectors of 128 bits.
fn types() -> impl Iterator<Item = Type> {
    Type::all().filter(|ty| !ty.is_vector() || ty.bits() == 128)
}

/// A program that loads two values of these types and computes an operation on them.
fn program(types: [Type; 2], operation: impl FnOnce(Value, Value) -> Operation, ty: Type) -> Program {
    let [state, ..] = Program::PARAMETERS;
    let mut values = vec![(Operation::Parameter, Type::I64); 3];
    for ty in types {
        values.push((Operation::Load { load: Load::Whole, aligned: false, address: state, offset: 0 }, ty));
    }
    values.push((operation(Value(3), Value(4)), ty));
    let body = [3, 4, 5].map(|value| Statement::Let(Value(value)));
    let body = body.into_iter().chain([Statement::Return(state)]).collect();
    Program { values, body, scratch: 0, stack_of_called: 0 }
}

/// What Cranelift says of the translation, if the check accepts a program.
fn accepted(program: &Program) -> Option<Result<(), String>> {
    program.verify().ok()?;
    let mut code = ir::Function::with_name_signature(UserFuncName::default(), signature(CallConv::SystemV, 3, true));
    translate(program, &mut code);
    let flags = Flags::new(settings::builder());
    Some(verify_function(&code, &flags).map_err(|error| format!("{error}{}", code.display())))
}

/// The operations on two values, of which some take only one.
fn operations(x: Value, y: Value) -> Vec<Operation> {
    let unaries = UNARIES.iter().map(|(unary, _)| Operation::Unary(*unary, x));
    let binaries = BINARIES.iter().map(|(binary, _)| Operation::Binary(*binary, x, y));
    let comparisons = COMPARISONS.iter().map(|(relation, _)| Operation::Compare(*relation, x, y));
    let loads = LOADS.iter().map(|&((load, aligned), _)| Operation::Load { load, aligned, address: x, offset: 0 });
    let lanes = [0, 1, 15, 16].into_iter().flat_map(|at| [Operation::Lane(x, at), Operation::WithLane(x, y, at)]);
    let choices = [Operation::Select(x, y, y), Operation::Blend(x, y, y), Operation::Shuffle(x, y, [0; 32])];
    unaries.chain(binaries).chain(comparisons).chain(loads).chain(lanes).chain(choices).collect()
}

#[test]
fn operations_on_types_that_the_check_accepts_are_code() {
    let mut times = vec![0; operations(Value(0), Value(0)).len()];
    let mut wrong = Vec::new();
    for (ty, left) in types().flat_map(|ty| types().map(move |left| (ty, left))) {
        for right in types() {
            for (number, times) in times.iter_mut().enumerate() {
                let program = program([left, right], |x, y| operations(x, y).swap_remove(number), ty);
                match accepted(&program) {
                    Some(Ok(())) => *times += 1,
                    Some(Err(why)) => wrong.push(why),
                    None => {}
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for (operation, times) in operations(Value(0), Value(0)).iter().zip(times) {
        let is_beyond = matches!(operation, Operation::Lane(_, 16) | Operation::WithLane(_, _, 16));
        assert_eq!(times == 0, is_beyond, "{operation:?} is accepted {times} times");
    }
}
