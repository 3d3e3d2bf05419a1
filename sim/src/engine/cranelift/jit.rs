//! Machine code in memory, made by Cranelift: the one place that makes it and the one that calls it.

use std::iter;
use std::mem::transmute;
use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicPtr, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, OnceLock};
use std::thread::{self, available_parallelism};

use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::ir::UserFuncName;
use cranelift_codegen::isa::{OwnedTargetIsa, TargetIsa};

use super::evaluated::evaluating;
use super::pages::CodePages;
use super::shared::SharedCode;
use super::target::{Unsupported, host};
use super::translate::{signature, translate};
use crate::engine::strips::{Builder, Examined, Kept, Notes, Only, Program, Surroundings, Type, Value};

/// A generated function: takes the addresses of the state and of scratch memory and a number, and returns a number.
type Entry = unsafe extern "C" fn(*mut u8, u64, *mut u64) -> u64;

/// Bits of a vector in code.
pub(in crate::engine) const VECTOR: u32 = 128;
/// Bytes of stack that every caller of code is assumed to have left.
const STACK: usize = 64 << 10;
/// Bytes of stack for functions that code calls.
const CALLED: usize = 64 << 10;

/// A function of generated code.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Code {
    entry: Entry,
    /// Bytes of stack that it takes, including the functions that it calls.
    stack: usize,
}

impl Code {
    /// Runs it, on a stack of its own if it takes much, so that no design overflows a thread's stack.
    ///
    /// # Safety
    ///
    /// The [`Jit`] that gave it is alive. `state` has the layout that the code was made for, and `scratch` has as
    /// many limbs as the [`Jit`] says. Nobody else uses them.
    #[allow(unsafe_code, reason = "generated code is a foreign function")]
    #[inline]
    pub unsafe fn call(self, state: *mut u8, argument: u64, scratch: *mut u64) -> u64 {
        // SAFETY: the caller's promise.
        match self.stack <= STACK {
            true => unsafe { (self.entry)(state, argument, scratch) },
            false => unsafe { self.call_apart(state, argument, scratch) },
        }
    }

    /// Runs it if there is stack enough: see [`Code::is_called`].
    ///
    /// # Safety
    ///
    /// As [`Code::call`].
    #[allow(unsafe_code, reason = "generated code is a foreign function")]
    pub unsafe fn call_within(self, state: *mut u8, argument: u64, scratch: *mut u64) -> u64 {
        // SAFETY: the caller's promise.
        unsafe { (self.entry)(state, argument, scratch) }
    }

    /// Its address, if it takes no more than this much stack.
    pub fn address_within(self, stack: usize) -> Option<usize> {
        (self.stack <= stack).then_some(self.entry as usize)
    }

    /// Tells a function that it calls this code.
    pub fn is_called(self, b: &mut Builder) {
        b.calls_code(self.stack);
    }

    /// Runs it on a stack of its own.
    ///
    /// # Safety
    ///
    /// As [`Code::call`].
    #[allow(unsafe_code, reason = "generated code is a foreign function")]
    #[cold]
    unsafe fn call_apart(self, state: *mut u8, argument: u64, scratch: *mut u64) -> u64 {
        let (state, scratch) = (AtomicPtr::new(state), AtomicPtr::new(scratch));
        let run = || {
            // SAFETY: the caller's promise; the caller waits until this is done.
            unsafe { (self.entry)(state.into_inner(), argument, scratch.into_inner()) }
        };
        thread::scope(|scope| {
            let thread = thread::Builder::new().stack_size(self.stack + CALLED).spawn_scoped(scope, run);
            thread
                .expect("the system has a thread and its stack to give")
                .join()
                .expect("generated code does not panic")
        })
    }

    /// Emits a call of it in another function.
    pub fn emit_call(self, b: &mut Builder, state: Value, argument: Value) -> Value {
        self.is_called(b);
        let scratch = b.scratch();
        b.call(self.entry as usize, &[state, argument, scratch])
    }
}

/// A function in memory.
pub(in crate::engine) struct Made {
    code: Code,
    /// Where it is.
    _pages: CodePages,
}

/// Makes functions, and keeps them in memory.
pub(in crate::engine) struct Jit {
    target: OwnedTargetIsa,
    made: Vec<Arc<Made>>,
    shared: Arc<SharedCode>,
    /// The objects that functions refer to by address.
    kept: Kept,
    /// The most limbs of scratch memory that a function takes.
    pub scratch: usize,
    /// Programs are examined, and no code is made of them.
    pub examined: Option<Examined>,
    /// Bits of a vector.
    vector: u32,
    /// Code has programs evaluated.
    evaluates: bool,
}

impl Jit {
    /// Prepares for the machine that it runs on.
    pub fn new() -> Result<Jit, Unsupported> {
        host().map(Jit::on)
    }

    /// It takes functions that others of the same circuit have made.
    pub fn sharing(self, shared: Arc<SharedCode>) -> Jit {
        Jit { shared, ..self }
    }

    /// Programs have vectors of so many bits, and are evaluated.
    pub fn evaluating(self, vector: u32) -> Jit {
        Jit { vector, evaluates: true, ..self }
    }

    /// Prepares for a machine.
    pub fn on(target: OwnedTargetIsa) -> Jit {
        let (made, kept, shared) = (Vec::new(), Kept::new(), Arc::default());
        Jit { target, made, shared, kept, scratch: 0, examined: None, vector: VECTOR, evaluates: false }
    }

    /// Makes a function in this memory. `body` gets the builder in the entry block, the address of the state and the
    /// argument, and must end with a return of one number.
    ///
    /// # Panics
    ///
    /// There is no memory for code.
    pub fn function_in(&mut self, memory: &dyn Surroundings, body: impl FnOnce(&mut Builder, Value, Value)) -> Code {
        self.try_function(memory, body).unwrap_or_else(|refused| panic!("{refused}"))
    }

    /// Makes several functions in this memory, on all processors.
    ///
    /// # Panics
    ///
    /// There is no memory for code.
    pub fn functions_in(
        &mut self,
        memory: &dyn Surroundings,
        bodies: impl Iterator<Item = impl FnOnce(&mut Builder, Value, Value)>,
    ) -> Vec<Code> {
        let programs = bodies.map(|body| self.program(memory, body)).collect();
        self.code(programs).unwrap_or_else(|refused| panic!("{refused}"))
    }

    /// Makes a function that accesses nothing but a state of up to a megabyte.
    #[cfg(test)]
    pub fn function(&mut self, body: impl FnOnce(&mut Builder, Value, Value)) -> Code {
        self.function_in(&Only(1 << 20), body)
    }

    /// Makes a function that calls the function at an address, with a number, the address of the state and the
    /// argument.
    pub fn calling(&mut self, address: usize, number: i64) -> Code {
        self.function_in(&Only(0), |builder, state, argument| {
            let number = builder.constant(Type::ADDRESS, number);
            let left = builder.call(address, &[number, state, argument]);
            builder.give(left);
        })
    }

    fn try_function(
        &mut self,
        memory: &dyn Surroundings,
        body: impl FnOnce(&mut Builder, Value, Value),
    ) -> Result<Code, Unsupported> {
        let program = self.program(memory, body);
        self.code(vec![program]).map(|codes| codes[0])
    }

    /// The program of a function.
    fn program(&mut self, memory: &dyn Surroundings, body: impl FnOnce(&mut Builder, Value, Value)) -> Program {
        let mut builder = Builder::new(self.vector);
        let [state, argument, _] = Program::PARAMETERS;
        body(&mut builder, state, argument);
        let (program, kept) = builder.finish();
        if let Some(examined) = &mut self.examined {
            examined.add(&program, memory);
        } else if (self.evaluates || cfg!(debug_assertions))
            && let Err(rule) = program.check(memory)
        {
            panic!("a strip program breaks a rule: {rule}\n{}", program.text(&Notes::NONE));
        }
        self.kept.extend(kept);
        self.scratch = self.scratch.max(program.scratch);
        if self.evaluates { self.evaluated(program) } else { program }
    }

    /// The program of code that has a program evaluated.
    fn evaluated(&mut self, program: Program) -> Program {
        let program = Arc::new(program);
        let code = evaluating(&program);
        self.kept.push(program);
        code
    }

    /// The code of these programs.
    fn code(&mut self, programs: Vec<Program>) -> Result<Vec<Code>, Unsupported> {
        if self.examined.is_some() {
            return Ok(vec![Code { entry: nothing, stack: 0 }; programs.len()]);
        }
        let made = match self.shared.is_shared() {
            true => self.shared.find_or_make(&programs, |programs| make_all(&*self.target, programs))?,
            false => make_all(&*self.target, &programs.iter().collect::<Vec<_>>())?.into_iter().map(Arc::new).collect(),
        };
        let code = made.iter().map(|made| made.code).collect();
        self.made.extend(made);
        Ok(code)
    }
}

/// Makes code of these programs, several at a time if there are processors for it.
fn make_all(target: &dyn TargetIsa, programs: &[&Program]) -> Result<Vec<Made>, Unsupported> {
    // The system is asked only if there is something to share.
    let threads = match programs.len() {
        0 | 1 => 1,
        count => available_parallelism().map_or(1, NonZeroUsize::get).min(count),
    };
    let next = AtomicUsize::new(0);
    let work = || {
        let mut context = Context::new();
        let taken = iter::from_fn(|| {
            let at = next.fetch_add(1, Relaxed);
            programs.get(at).map(|program| (at, program))
        });
        taken.map(|(at, program)| (at, make(&mut context, target, program))).collect::<Vec<_>>()
    };
    let mut made = thread::scope(|scope| {
        // Without another thread, this one makes all.
        let start = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        let others: Vec<_> = (1..threads).filter_map(start).collect();
        let mut made = work();
        for other in others {
            made.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        made
    });
    made.sort_by_key(|(at, _)| *at);
    made.into_iter().map(|(_, made)| made).collect()
}

/// Makes the code of a program.
fn make(context: &mut Context, target: &dyn TargetIsa, program: &Program) -> Result<Made, Unsupported> {
    begin(context, target);
    translate(program, &mut context.func);
    made(context, target, program.stack_of_called)
}

/// In place of code that is not made.
extern "C" fn nothing(_: *mut u8, _: u64, _: *mut u64) -> u64 {
    0
}

/// Begins a function.
fn begin(context: &mut Context, target: &dyn TargetIsa) {
    context.clear();
    context.func.name = UserFuncName::user(0, 0);
    context.func.signature = signature(target.default_call_conv(), 3, true);
}

/// Makes the function of a context; `stack_of_called` is that of the functions that it calls.
fn made(context: &mut Context, target: &dyn TargetIsa, stack_of_called: usize) -> Result<Made, Unsupported> {
    let code = match context.compile(target, &mut ControlPlane::default()) {
        Ok(code) => &code.buffer,
        Err(error) => panic!("generated code is not accepted: {:?}\n{}", error.inner, error.func.display()),
    };
    // Everything that code refers to is within it, or is in it as an address.
    assert!(code.relocs().is_empty(), "generated code refers to what nobody fills in: {:?}", code.relocs());
    let frame = code.frame_layout().map_or(0, |frame| frame.frame_to_fp_offset as usize);
    let pages = CodePages::new(code.data(), code.alignment as usize)?;
    // SAFETY: the function was just made with this signature, in the C convention of this machine.
    #[allow(unsafe_code, reason = "a function pointer is made of an address")]
    let entry = unsafe { transmute::<*const u8, Entry>(pages.entry()) };
    Ok(Made { code: Code { entry, stack: frame + stack_of_called }, _pages: pages })
}

impl std::fmt::Debug for Jit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Jit").finish_non_exhaustive()
    }
}

/// Why no code can be generated for this machine, if none can. A small function is made to find out, because a system
/// may forbid it.
pub(in crate::engine) fn unsupported() -> Option<Unsupported> {
    static REFUSED: OnceLock<Option<Unsupported>> = OnceLock::new();
    let try_one = || {
        let returning = |b: &mut Builder, _, argument| b.give(argument);
        Jit::new().and_then(|mut jit| jit.try_function(&Only(0), returning)).err()
    };
    REFUSED.get_or_init(try_one).clone()
}

#[cfg(test)]
mod tests {
    use cranelift_codegen::cursor::{Cursor, FuncCursor};
    use cranelift_codegen::ir::{
        self, ExtFuncData, ExternalName, InstBuilder, LibCall, MemFlagsData, StackSlotData, StackSlotKind, types,
    };

    use super::*;

    /// A function of these instructions; they get the argument.
    fn of_instructions(jit: &mut Jit, write: impl FnOnce(&mut FuncCursor, ir::Value)) -> Code {
        let mut context = Context::new();
        begin(&mut context, &*jit.target);
        let func = &mut context.func;
        let block = func.dfg.make_block();
        let [_, argument, _] = [(); 3].map(|()| func.dfg.append_block_param(block, types::I64));
        let mut at = FuncCursor::new(func);
        at.insert_block(block);
        write(&mut at, argument);
        let made = Arc::new(made(&mut context, &*jit.target, 0).unwrap());
        jit.made.push(made.clone());
        made.code
    }

    #[test]
    #[allow(unsafe_code, reason = "calls generated code")]
    fn a_function_reads_and_writes_the_state() {
        let mut jit = Jit::new().unwrap();
        let code = jit.function(|b, state, argument| {
            let old = b.load(Type::I64, state, 8);
            let sum = b.add(old, argument);
            b.store(sum, state, 8);
            b.give(old);
        });
        let mut state = [1u64, 40];
        // SAFETY: the code accesses only the second number of the state.
        let old = unsafe { code.call(state.as_mut_ptr().cast(), 2, std::ptr::null_mut()) };
        assert_eq!((old, state), (40, [1, 42]));
    }

    #[test]
    #[allow(unsafe_code, reason = "calls generated code")]
    fn a_function_with_a_large_frame_runs_on_a_stack_of_its_own() {
        const FRAME: u32 = 64 << 20;
        let mut jit = Jit::new().unwrap();
        let inner = of_instructions(&mut jit, |at, argument| {
            let slot = at.func.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, FRAME, 3));
            let ends = [0, FRAME as i32 - 8].map(|offset| at.ins().stack_addr(types::I64, slot, offset));
            for end in ends {
                at.ins().store(MemFlagsData::trusted(), argument, end, 0);
            }
            let [low, high] = ends.map(|end| at.ins().load(types::I64, MemFlagsData::trusted(), end, 0));
            let sum = at.ins().iadd(low, high);
            at.ins().return_(&[sum]);
        });
        let outer = jit.function(|b, state, argument| {
            let sum = inner.emit_call(b, state, argument);
            b.give(sum);
        });
        assert!(inner.stack >= FRAME as usize && outer.stack >= inner.stack);
        for code in [inner, outer] {
            // SAFETY: the code accesses only its stack.
            assert_eq!(unsafe { code.call(std::ptr::null_mut(), 21, std::ptr::null_mut()) }, 42);
        }
    }

    #[test]
    #[should_panic(expected = "refers to what nobody fills in")]
    fn code_that_needs_an_address_filled_in_is_refused() {
        let _ = of_instructions(&mut Jit::new().unwrap(), |at, argument| {
            // Some machines round by a function of the C library.
            let signature = signature(at.func.signature.call_conv, 1, true);
            let signature = at.func.import_signature(signature);
            let name = ExternalName::LibCall(LibCall::Memcpy);
            let function = at.func.import_function(ExtFuncData { name, signature, colocated: false, patchable: false });
            let call = at.ins().call(function, &[argument]);
            let result = at.func.dfg.inst_results(call)[0];
            at.ins().return_(&[result]);
        });
    }
}
