//! Machine code in memory, made by Cranelift: the one place that makes it and the one that calls it.

use std::mem::transmute;
use std::sync::atomic::AtomicPtr;
use std::sync::{Arc, OnceLock};

use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::ir::{InstBuilder, UserFuncName, Value};
use cranelift_codegen::isa::{OwnedTargetIsa, TargetIsa};

use super::builder::{FunctionBuilder, POINTER, signature};
use super::pages::CodePages;
use super::scalar::Call;
use super::shared::SharedCode;
use super::target::{Unsupported, host};

/// A generated function: takes the addresses of the state and of scratch memory and a number, and returns a number.
type Entry = unsafe extern "C" fn(*mut u8, u64, *mut u64) -> u64;

/// Bytes of stack that every caller of code is assumed to have left.
const STACK: usize = 64 << 10;
/// Bytes of stack for functions that code calls.
const CALLED: usize = 64 << 10;

/// A function of generated code.
#[derive(Debug, Clone, Copy)]
pub(super) struct Code {
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
    pub fn is_called(self, b: &mut FunctionBuilder) {
        b.stack_of_called = b.stack_of_called.max(self.stack);
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
        std::thread::scope(|scope| {
            let thread = std::thread::Builder::new().stack_size(self.stack + CALLED).spawn_scoped(scope, run);
            thread
                .expect("the system has a thread and its stack to give")
                .join()
                .expect("generated code does not panic")
        })
    }

    /// Emits a call of it in another function.
    pub fn emit_call(self, b: &mut FunctionBuilder, state: Value, argument: Value) -> Value {
        self.is_called(b);
        let scratch = b.scratch();
        b.call(self.entry as usize, &[state, argument, scratch], true).expect("it gives a number")
    }
}

/// A function in memory.
pub(super) struct Made {
    code: Code,
    /// Where it is.
    _pages: CodePages,
}

/// Makes functions, and keeps them in memory.
pub(super) struct Jit {
    target: OwnedTargetIsa,
    context: Context,
    made: Vec<Arc<Made>>,
    shared: Arc<SharedCode>,
    /// The objects that functions refer to by address.
    calls: Vec<Arc<Call>>,
    /// The most limbs of scratch memory that a function takes.
    pub scratch: usize,
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

    /// Prepares for a machine.
    pub fn on(target: OwnedTargetIsa) -> Jit {
        let (made, calls, shared) = (Vec::new(), Vec::new(), Arc::default());
        Jit { target, context: Context::new(), made, shared, calls, scratch: 0 }
    }

    /// Makes a function. `body` gets the builder in the entry block, the address of the state and the argument, and
    /// must end with a return of one number.
    ///
    /// # Panics
    ///
    /// There is no memory for code.
    pub fn function(&mut self, body: impl FnOnce(&mut FunctionBuilder, Value, Value)) -> Code {
        self.try_function(body).unwrap_or_else(|refused| panic!("{refused}"))
    }

    /// Makes a function that calls the function at an address, with a number, the address of the state and the
    /// argument.
    pub fn calling(&mut self, address: usize, number: i64) -> Code {
        self.function(|builder, state, argument| {
            let number = builder.ins().iconst(POINTER, number);
            let left = builder.call(address, &[number, state, argument], true).expect("it gives a number");
            builder.ins().return_(&[left]);
        })
    }

    fn try_function(&mut self, body: impl FnOnce(&mut FunctionBuilder, Value, Value)) -> Result<Code, Unsupported> {
        self.context.clear();
        self.context.func.name = UserFuncName::user(0, 0);
        self.context.func.signature = signature(self.target.default_call_conv(), 3, true);
        let (mut builder, state, argument) = FunctionBuilder::new(&mut self.context.func);
        body(&mut builder, state, argument);
        let FunctionBuilder { calls, most_scratch, stack_of_called, .. } = builder;
        self.calls.extend(calls);
        self.scratch = self.scratch.max(most_scratch);
        let (context, target) = (&mut self.context, &*self.target);
        // What is made of a function changes it.
        let origin = self.shared.is_shared().then(|| (context.func.stencil.clone(), stack_of_called));
        let make = |context: &mut Context| made(context, target, stack_of_called);
        let made = match origin {
            Some(origin) => self.shared.find_or_make(origin, || make(context))?,
            None => Arc::new(make(context)?),
        };
        let code = made.code;
        self.made.push(made);
        Ok(code)
    }
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
pub(crate) fn unsupported() -> Option<Unsupported> {
    static REFUSED: OnceLock<Option<Unsupported>> = OnceLock::new();
    let try_one = || {
        let returning = |b: &mut FunctionBuilder, _, argument| {
            b.ins().return_(&[argument]);
        };
        Jit::new().and_then(|mut jit| jit.try_function(returning)).err()
    };
    REFUSED.get_or_init(try_one).clone()
}

#[cfg(test)]
mod tests {
    use cranelift_codegen::ir::{MemFlagsData, StackSlotData, StackSlotKind, types};

    use super::*;

    #[test]
    #[allow(unsafe_code, reason = "calls generated code")]
    fn a_function_reads_and_writes_the_state() {
        let mut jit = Jit::new().unwrap();
        let code = jit.function(|b, state, argument| {
            let old = b.ins().load(types::I64, MemFlagsData::trusted(), state, 8);
            let sum = b.ins().iadd(old, argument);
            b.ins().store(MemFlagsData::trusted(), sum, state, 8);
            b.ins().return_(&[old]);
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
        let inner = jit.function(|b, _, argument| {
            let slot = StackSlotData::new(StackSlotKind::ExplicitSlot, FRAME, 3);
            let slot = b.func.create_sized_stack_slot(slot);
            let [low, high] = [0, FRAME as i32 - 8].map(|at| b.ins().stack_addr(types::I64, slot, at));
            for at in [low, high] {
                b.ins().store(MemFlagsData::trusted(), argument, at, 0);
            }
            let [low, high] = [low, high].map(|at| b.ins().load(types::I64, MemFlagsData::trusted(), at, 0));
            let sum = b.ins().iadd(low, high);
            b.ins().return_(&[sum]);
        });
        let outer = jit.function(|b, state, argument| {
            let sum = inner.emit_call(b, state, argument);
            b.ins().return_(&[sum]);
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
        let mut jit = Jit::new().unwrap();
        let _ = jit.function(|b, _, argument| {
            // Some machines round by a function of the C library.
            let signature = signature(b.func.signature.call_conv, 1, true);
            let signature = b.func.import_signature(signature);
            let name = cranelift_codegen::ir::ExternalName::LibCall(cranelift_codegen::ir::LibCall::Memcpy);
            let data = cranelift_codegen::ir::ExtFuncData { name, signature, colocated: false, patchable: false };
            let function = b.func.import_function(data);
            let call = b.ins().call(function, &[argument]);
            let result = b.func.dfg.inst_results(call)[0];
            b.ins().return_(&[result]);
        });
    }
}
