//! Strip programs that are evaluated in place of code, on the memory that code would use. So the evaluation, and
//! targets with other vectors than this processor's, run any design.

use std::mem::transmute;

use super::jit::VECTOR;
use crate::engine::strips::{Builder, Calls, Places, Program, Wild};

/// The program of code that has a program evaluated, and returns its result.
pub(super) fn evaluating(program: &Program) -> Program {
    let [state, argument, scratch] = Program::PARAMETERS;
    let mut builder = Builder::new(VECTOR);
    let address = builder.address(std::ptr::from_ref(program) as usize);
    let result = builder.call(evaluate as *const () as usize, &[address, state, argument, scratch]);
    builder.calls_code(program.stack_of_called);
    builder.give(result);
    builder.finish().0
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn evaluate(program: *const Program, state: u64, argument: u64, scratch: u64) -> u64 {
    // SAFETY: the engine that owns the calling code also keeps the program.
    let program = unsafe { &*program };
    let result = program.evaluate([state, argument, scratch], &mut Process, &mut Process);
    result.unwrap_or_else(|Wild(address)| unreachable!("a checked program accesses {address:#x}"))
}

/// The memory and the functions of this process.
struct Process;

impl Places for Process {
    #[allow(unsafe_code, reason = "a program has addresses, as code has")]
    fn place(&mut self, at: u64, size: usize) -> Result<&mut [u8], Wild> {
        // SAFETY: the check of the program shows that each access is in an allocation of its engine, which calls it
        // and waits. Others see these bytes as cells.
        Ok(unsafe { std::slice::from_raw_parts_mut(at as *mut u8, size) })
    }
}

impl Calls for Process {
    #[allow(unsafe_code, reason = "calls what code would call")]
    fn call(&mut self, function: u64, arguments: &[u64], returns: bool) -> u64 {
        macro_rules! call {
            ($($argument:ident: $number:ty),*) => {
                // SAFETY: the address is that of a function of the C convention with so many numbers, by which the
                // emitter has it called.
                unsafe {
                    if returns {
                        transmute::<usize, extern "C" fn($($number),*) -> u64>(function as usize)($(*$argument),*)
                    } else {
                        transmute::<usize, extern "C" fn($($number),*)>(function as usize)($(*$argument),*);
                        0
                    }
                }
            };
        }
        match arguments {
            [a] => call!(a: u64),
            [a, b] => call!(a: u64, b: u64),
            [a, b, c] => call!(a: u64, b: u64, c: u64),
            [a, b, c, d] => call!(a: u64, b: u64, c: u64, d: u64),
            _ => unreachable!("no function of {} numbers is called", arguments.len()),
        }
    }
}
