//! The types of operations that a check of a strip program accepts, beside those that Cranelift accepts.

use cranelift_codegen::ir::{self, UserFuncName};
use cranelift_codegen::isa::CallConv;
use cranelift_codegen::settings::{self, Flags};
use cranelift_codegen::verify_function;

use super::{signature, translate};
use crate::engine::strips::{Binary, Comparison, Load, Operation, Program, Statement, Type, Unary, Value};

const UNARY: [Unary; 17] = [
    Unary::Not,
    Unary::Neg,
    Unary::CountOnes,
    Unary::ZeroExtend,
    Unary::SignExtend,
    Unary::Truncate,
    Unary::Cast,
    Unary::Splat,
    Unary::Lowest,
    Unary::WidenLow { signed: false },
    Unary::WidenLow { signed: true },
    Unary::WidenHigh { signed: false },
    Unary::WidenHigh { signed: true },
    Unary::HighBits,
    Unary::AnyBit,
    Unary::ToFloat,
    Unary::ToInteger,
];
const BINARY: [Binary; 17] = [
    Binary::Add,
    Binary::Sub,
    Binary::Mul,
    Binary::Div,
    Binary::And,
    Binary::Or,
    Binary::Xor,
    Binary::Shl,
    Binary::Shr,
    Binary::Sar,
    Binary::RotateLeft,
    Binary::Min,
    Binary::Narrow { signed: false },
    Binary::Narrow { signed: true },
    Binary::Swizzle,
    Binary::LookUp,
    Binary::MulFloat,
];

/// Numbers, and vectors of 128 bits.
fn types() -> impl Iterator<Item = Type> {
    let all = [8, 16, 32, 64].into_iter().flat_map(|element| [Type::integer(element), Type::vector(element, 128)]);
    all.flat_map(|ty| [ty, ty.floats()]).filter(|ty| !ty.is_float() || ty.element() >= 32)
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
    let unary = UNARY.map(|unary| Operation::Unary(unary, x));
    let binary = BINARY.map(|binary| Operation::Binary(binary, x, y));
    let lanes = [0, 1, 15, 16].into_iter().flat_map(|at| [Operation::Lane(x, at), Operation::WithLane(x, y, at)]);
    let loads = [Load::Whole, Load::ZeroExtended, Load::SignExtended];
    let loads = loads.map(|load| Operation::Load { load, aligned: false, address: x, offset: 0 });
    let relations = [Comparison::Equal, Comparison::SignedLessThan, Comparison::UnsignedGreaterThanOrEqual];
    let comparisons = relations.map(|relation| Operation::Compare(relation, x, y));
    let choices = [Operation::Select(x, y, y), Operation::Blend(x, y, y), Operation::Shuffle(x, y, [0; 32])];
    unary.into_iter().chain(binary).chain(lanes).chain(loads).chain(comparisons).chain(choices).collect()
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
