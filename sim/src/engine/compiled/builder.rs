//! Writes the instructions of a function, block by block.

use std::sync::Arc;

use cranelift_codegen::ir::{
    AbiParam, Block, DataFlowGraph, Function, InsertBuilder, Inst, InstBuilder, InstInserterBase, JumpTable,
    JumpTableData, Signature, Type, Value, types,
};
use cranelift_codegen::isa::CallConv;

use super::scalar::Call;

/// The type of addresses.
pub(super) const POINTER: Type = types::I64;

/// A function with this number of parameters, which are numbers or addresses; it returns a number if `returns`.
pub(super) fn signature(convention: CallConv, parameters: usize, returns: bool) -> Signature {
    let mut signature = Signature::new(convention);
    signature.params.extend(vec![AbiParam::new(types::I64); parameters]);
    signature.returns.extend(returns.then(|| AbiParam::new(types::I64)));
    signature
}

/// A function whose code is being written. Instructions go to the end of the current block.
pub(super) struct FunctionBuilder<'f> {
    pub func: &'f mut Function,
    block: Block,
    /// The address of the scratch memory.
    scratch: Value,
    /// The limbs of it in use, now and at most.
    taken: usize,
    pub most_scratch: usize,
    /// The objects that the code refers to by address.
    pub calls: Vec<Arc<Call>>,
    /// The largest stack of the functions that it calls, in bytes.
    pub stack_of_called: usize,
}

impl<'f> FunctionBuilder<'f> {
    /// Starts in the entry block of a function with three parameters, the last of which is the address of scratch
    /// memory; returns the others.
    pub fn new(func: &'f mut Function) -> (Self, Value, Value) {
        let block = func.dfg.make_block();
        func.layout.append_block(block);
        let [state, argument, scratch] = [(); 3].map(|()| func.dfg.append_block_param(block, types::I64));
        let (calls, stack_of_called) = (Vec::new(), 0);
        let builder = FunctionBuilder { func, block, scratch, taken: 0, most_scratch: 0, calls, stack_of_called };
        (builder, state, argument)
    }

    /// The next instruction.
    pub fn ins(&mut self) -> InsertBuilder<'_, End<'_>> {
        InsertBuilder::new(End { func: self.func, block: self.block })
    }

    /// A block, which is empty and not yet placed.
    pub fn create_block(&mut self) -> Block {
        self.func.dfg.make_block()
    }

    /// Adds a parameter to a block.
    pub fn append_block_param(&mut self, block: Block, of: Type) -> Value {
        self.func.dfg.append_block_param(block, of)
    }

    /// The parameters of a block.
    pub fn block_params(&self, block: Block) -> &[Value] {
        self.func.dfg.block_params(block)
    }

    /// Continues in this block, and places it after the previous ones.
    pub fn switch_to_block(&mut self, block: Block) {
        self.func.layout.append_block(block);
        self.block = block;
    }

    /// A table of blocks to branch to.
    pub fn create_jump_table(&mut self, table: JumpTableData) -> JumpTable {
        self.func.create_jump_table(table)
    }

    /// Calls the function at an address, in the convention of `extern "C"` on this machine.
    pub fn call(&mut self, address: usize, arguments: &[Value], returns: bool) -> Option<Value> {
        let signature = signature(self.func.signature.call_conv, arguments.len(), returns);
        let signature = self.func.import_signature(signature);
        let address = self.ins().iconst(POINTER, address as i64);
        let call = self.ins().call_indirect(signature, address, arguments);
        self.func.dfg.inst_results(call).first().copied()
    }

    /// Calls generated code that takes at most this much stack.
    pub fn call_code(&mut self, address: Value, arguments: &[Value], stack: usize) {
        let signature = signature(self.func.signature.call_conv, arguments.len(), true);
        let signature = self.func.import_signature(signature);
        self.ins().call_indirect(signature, address, arguments);
        self.stack_of_called = self.stack_of_called.max(stack);
    }

    /// The address of the scratch memory.
    pub fn scratch(&self) -> Value {
        self.scratch
    }

    /// Allocates limbs of the scratch memory; returns the first.
    pub fn take(&mut self, limbs: usize) -> usize {
        let first = self.taken;
        self.taken += limbs;
        self.most_scratch = self.most_scratch.max(self.taken);
        first
    }

    /// The limbs of scratch memory in use.
    pub fn taken(&self) -> usize {
        self.taken
    }

    /// Frees everything allocated since `taken` limbs were in use.
    pub fn give_back(&mut self, taken: usize) {
        self.taken = taken;
    }
}

/// The end of a block.
pub(super) struct End<'b> {
    func: &'b mut Function,
    block: Block,
}

impl<'b> InstInserterBase<'b> for End<'b> {
    fn data_flow_graph(&self) -> &DataFlowGraph {
        &self.func.dfg
    }

    fn data_flow_graph_mut(&mut self) -> &mut DataFlowGraph {
        &mut self.func.dfg
    }

    fn insert_built_inst(self, inst: Inst) -> &'b mut DataFlowGraph {
        self.func.layout.append_inst(inst, self.block);
        &mut self.func.dfg
    }

    fn insert_aux_inst(&mut self, inst: Inst) {
        self.func.layout.append_inst(inst, self.block);
    }
}
