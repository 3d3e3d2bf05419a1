//! From a strip program to Cranelift's instructions.

#[cfg(test)]
mod accepted;
#[cfg(test)]
mod tests;

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    self, AbiParam, Block, BlockArg, BlockCall, ConstantData, DataFlowGraph, Endianness, InsertBuilder, Inst,
    InstBuilder, InstInserterBase, JumpTableData, MemFlagsData, Signature, types,
};
use cranelift_codegen::isa::CallConv;

use crate::engine::strips::Loop;
use crate::engine::strips::{Binary, Comparison, Load, Operation, Program, Statement, Type, Unary, Value};

/// A function of numbers; it returns a number if `returns`.
pub(in crate::engine) fn signature(convention: CallConv, parameters: usize, returns: bool) -> Signature {
    let mut signature = Signature::new(convention);
    signature.params.extend(vec![AbiParam::new(types::I64); parameters]);
    signature.returns.extend(returns.then(|| AbiParam::new(types::I64)));
    signature
}

/// Writes the instructions of a program into a function, which is empty and has its signature.
pub(in crate::engine) fn translate(program: &Program, func: &mut ir::Function) {
    let block = func.dfg.make_block();
    func.layout.append_block(block);
    let mut translator =
        Translator { program, values: vec![None; program.values.len()], func, block, leaves: Vec::new() };
    translator.parameters(block, &Program::PARAMETERS);
    translator.region(&program.body);
}

/// A function in progress. Instructions go to the end of the current block.
struct Translator<'p, 'f> {
    program: &'p Program,
    /// Cranelift's values for those that have been computed.
    values: Vec<Option<ir::Value>>,
    func: &'f mut ir::Function,
    block: Block,
    /// The blocks after the loops whose bodies these are.
    leaves: Vec<Block>,
}

impl Translator<'_, '_> {
    /// The next instruction.
    fn ins(&mut self) -> InsertBuilder<'_, End<'_>> {
        InsertBuilder::new(End { func: self.func, block: self.block })
    }

    fn blocks<const N: usize>(&mut self) -> [Block; N] {
        std::array::from_fn(|_| self.func.dfg.make_block())
    }

    /// Continues in this block, and places it after the previous ones.
    fn switch_to(&mut self, block: Block) {
        self.func.layout.append_block(block);
        self.block = block;
    }

    fn of(&self, value: Value) -> ir::Value {
        self.values[value.index()].expect("a value is computed before its use")
    }

    fn all(&self, values: &[Value]) -> Vec<ir::Value> {
        values.iter().map(|value| self.of(*value)).collect()
    }

    fn arguments(&self, values: &[Value]) -> Vec<BlockArg> {
        values.iter().map(|value| BlockArg::from(self.of(*value))).collect()
    }

    /// Gives a block these parameters.
    fn parameters(&mut self, block: Block, values: &[Value]) {
        for value in values {
            let parameter = self.func.dfg.append_block_param(block, ty(self.program.type_of(*value)));
            self.values[value.index()] = Some(parameter);
        }
    }

    fn region(&mut self, region: &[Statement]) {
        region.iter().for_each(|statement| self.statement(statement));
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let(value) => {
                let (operation, of) = &self.program.values[value.index()];
                self.values[value.index()] = Some(self.operation(operation, ty(*of)));
            }
            Statement::Call { function, arguments } => {
                self.call(*function, arguments, false);
            }
            Statement::Store { value, aligned, address, offset } => {
                let [value, address] = [value, address].map(|value| self.of(*value));
                self.ins().store(flags(*aligned), value, address, *offset);
            }
            Statement::If { flag, then, otherwise } if otherwise.is_empty() => {
                let [taken, done] = self.blocks();
                let flag = self.of(*flag);
                self.ins().brif(flag, taken, &[], done, &[]);
                self.alternatives(&[(taken, then)], done);
            }
            Statement::If { flag, then, otherwise } => {
                let [taken, other, done] = self.blocks();
                let flag = self.of(*flag);
                self.ins().brif(flag, taken, &[], other, &[]);
                self.alternatives(&[(taken, then), (other, otherwise)], done);
            }
            Statement::Switch { subject, table, regions } => self.switch(*subject, table, regions),
            Statement::Loop(all) => self.repeat(all),
            Statement::LeaveUnless { flag, results } => {
                let (flag, results, [next]) = (self.of(*flag), self.arguments(results), self.blocks());
                let leave = *self.leaves.last().expect("it is in a loop");
                self.ins().brif(flag, next, &[], leave, &results);
                self.switch_to(next);
            }
            Statement::Then => {}
            Statement::Return(value) => {
                let value = self.of(*value);
                self.ins().return_(&[value]);
            }
        }
    }

    /// Regions in blocks of their own, all of which go on in the same one.
    fn alternatives(&mut self, regions: &[(Block, &Vec<Statement>)], done: Block) {
        for (block, region) in regions {
            self.switch_to(*block);
            self.region(region);
            self.ins().jump(done, &[]);
        }
        self.switch_to(done);
    }

    fn switch(&mut self, subject: Value, table: &[usize], regions: &[Vec<Statement>]) {
        let [done] = self.blocks();
        let blocks: Vec<Block> = regions.iter().map(|_| self.func.dfg.make_block()).collect();
        let subject = self.of(subject);
        match (table, blocks.as_slice()) {
            (_, &[only]) => {
                self.ins().jump(only, &[]);
            }
            (&[zero, one], _) => {
                self.ins().brif(subject, blocks[one], &[], blocks[zero], &[]);
            }
            _ => {
                let pool = &mut self.func.dfg.value_lists;
                let calls: Vec<BlockCall> =
                    table.iter().map(|&index| BlockCall::new(blocks[index], std::iter::empty(), pool)).collect();
                let table = self.func.create_jump_table(JumpTableData::new(calls[0], &calls));
                let subject = self.ins().ireduce(types::I32, subject);
                self.ins().br_table(subject, table);
            }
        }
        let regions: Vec<_> = blocks.into_iter().zip(regions).collect();
        self.alternatives(&regions, done);
    }

    fn repeat(&mut self, all: &Loop) {
        let Loop { parameters, start, body, again, end, results } = all;
        let [block, done] = self.blocks();
        self.parameters(block, parameters);
        self.parameters(done, results);
        let start = self.arguments(start);
        self.ins().jump(block, &start);
        self.switch_to(block);
        self.leaves.push(done);
        self.region(body);
        self.leaves.pop();
        let end = self.arguments(end);
        match again {
            Some((flag, next)) => {
                let (flag, next) = (self.of(*flag), self.arguments(next));
                self.ins().brif(flag, block, &next, done, &end);
            }
            None => {
                self.ins().jump(done, &end);
            }
        }
        self.switch_to(done);
    }

    fn call(&mut self, function: Value, arguments: &[Value], returns: bool) -> Inst {
        let signature = signature(self.func.signature.call_conv, arguments.len(), returns);
        let signature = self.func.import_signature(signature);
        let (function, arguments) = (self.of(function), self.all(arguments));
        self.ins().call_indirect(signature, function, &arguments)
    }

    fn operation(&mut self, operation: &Operation, ty: ir::Type) -> ir::Value {
        match operation {
            Operation::Parameter => unreachable!("a parameter is not computed"),
            Operation::Constant(number) => self.ins().iconst(ty, *number),
            Operation::Address(address) => self.ins().iconst(ty, *address as i64),
            Operation::Bytes(bytes) => {
                let bytes = self.func.dfg.constants.insert(ConstantData::from(&bytes[..16]));
                self.ins().vconst(ty, bytes)
            }
            Operation::Unary(unary, of) => {
                let of = self.of(*of);
                self.unary(*unary, of, ty)
            }
            Operation::Binary(binary, x, y) => {
                let [x, y] = [x, y].map(|value| self.of(*value));
                self.binary(*binary, x, y)
            }
            Operation::Compare(comparison, x, y) => {
                let [x, y] = [x, y].map(|value| self.of(*value));
                self.ins().icmp(relation(*comparison), x, y)
            }
            Operation::Select(flag, x, y) => {
                let [flag, x, y] = [flag, x, y].map(|value| self.of(*value));
                self.ins().select(flag, x, y)
            }
            Operation::Blend(mask, x, y) => {
                let [mask, x, y] = [mask, x, y].map(|value| self.of(*value));
                self.blend(mask, x, y)
            }
            Operation::Shuffle(x, y, bytes) => {
                let [x, y] = [x, y].map(|value| self.of(*value));
                let bytes = self.func.dfg.immediates.push(ConstantData::from(&bytes[..16]));
                self.ins().shuffle(x, y, bytes)
            }
            Operation::Lane(of, lane) => {
                let of = self.of(*of);
                self.ins().extractlane(of, *lane)
            }
            Operation::WithLane(vector, number, lane) => {
                let [vector, number] = [vector, number].map(|value| self.of(*value));
                self.ins().insertlane(vector, number, *lane)
            }
            Operation::Load { load, aligned, address, offset } => {
                let (flags, address) = (flags(*aligned), self.of(*address));
                match (load, ty) {
                    (Load::Whole, _) => self.ins().load(ty, flags, address, *offset),
                    (Load::ZeroExtended, types::I16X8) => self.ins().uload8x8(flags, address, *offset),
                    (Load::ZeroExtended, _) => self.ins().uload16x4(flags, address, *offset),
                    (Load::SignExtended, types::I16X8) => self.ins().sload8x8(flags, address, *offset),
                    (Load::SignExtended, _) => self.ins().sload16x4(flags, address, *offset),
                }
            }
            Operation::Call(function, arguments) => {
                let call = self.call(*function, arguments, true);
                self.func.dfg.inst_results(call)[0]
            }
        }
    }

    fn unary(&mut self, unary: Unary, of: ir::Value, ty: ir::Type) -> ir::Value {
        match unary {
            Unary::Not => self.ins().bnot(of),
            Unary::Neg => self.ins().ineg(of),
            Unary::CountOnes => self.ins().popcnt(of),
            Unary::ZeroExtend => self.ins().uextend(ty, of),
            Unary::SignExtend => self.ins().sextend(ty, of),
            Unary::Truncate => self.ins().ireduce(ty, of),
            Unary::Cast => self.cast(of, ty),
            Unary::Splat => self.ins().splat(ty, of),
            Unary::Lowest => self.ins().scalar_to_vector(ty, of),
            Unary::WidenLow { signed: false } => self.ins().uwiden_low(of),
            Unary::WidenLow { signed: true } => self.ins().swiden_low(of),
            Unary::WidenHigh { signed: false } => self.ins().uwiden_high(of),
            Unary::WidenHigh { signed: true } => self.ins().swiden_high(of),
            Unary::HighBits => self.ins().vhigh_bits(ty, of),
            Unary::AnyBit => self.ins().vany_true(of),
            Unary::ToFloat => self.ins().fcvt_from_sint(ty, of),
            // Gives 0x8000_0000 for numbers that are too large.
            Unary::ToInteger if cfg!(target_arch = "x86_64") => self.ins().x86_cvtt2dq(ty, of),
            Unary::ToInteger => self.ins().fcvt_to_uint_sat(ty, of),
        }
    }

    fn binary(&mut self, binary: Binary, x: ir::Value, y: ir::Value) -> ir::Value {
        match binary {
            Binary::Add => self.ins().iadd(x, y),
            Binary::Sub => self.ins().isub(x, y),
            Binary::Mul => self.ins().imul(x, y),
            Binary::Div => self.ins().udiv(x, y),
            Binary::And => self.ins().band(x, y),
            Binary::Or => self.ins().bor(x, y),
            Binary::Xor => self.ins().bxor(x, y),
            Binary::Shl => self.ins().ishl(x, y),
            Binary::Shr => self.ins().ushr(x, y),
            Binary::Sar => self.ins().sshr(x, y),
            Binary::RotateLeft => self.ins().rotl(x, y),
            Binary::Min => self.ins().umin(x, y),
            Binary::Narrow { signed: false } => self.ins().unarrow(x, y),
            Binary::Narrow { signed: true } => self.ins().snarrow(x, y),
            Binary::LookUp if cfg!(target_arch = "x86_64") => self.ins().x86_pshufb(x, y),
            Binary::LookUp | Binary::Swizzle => self.ins().swizzle(x, y),
            Binary::MulFloat => self.ins().fmul(x, y),
        }
    }

    /// The same bits in another type.
    fn cast(&mut self, value: ir::Value, to: ir::Type) -> ir::Value {
        match self.func.dfg.value_type(value) == to {
            true => value,
            false => self.ins().bitcast(to, MemFlagsData::new().with_endianness(Endianness::Little), value),
        }
    }

    fn blend(&mut self, mask: ir::Value, x: ir::Value, y: ir::Value) -> ir::Value {
        if !cfg!(target_arch = "x86_64") {
            return self.ins().bitselect(mask, x, y);
        }
        // This is always one instruction, of SSE4.1; `bitselect` is one only if Cranelift recognises the mask.
        let of = self.func.dfg.value_type(x);
        let [mask, x, y] = [mask, x, y].map(|value| self.cast(value, types::I8X16));
        let out = self.ins().blendv(mask, x, y);
        self.cast(out, of)
    }
}

/// Loads and stores do not trap: the program stays within the state.
fn flags(aligned: bool) -> MemFlagsData {
    if aligned { MemFlagsData::trusted() } else { MemFlagsData::new().with_notrap() }
}

fn ty(of: Type) -> ir::Type {
    let element = match (of.element(), of.is_float()) {
        (8, _) => types::I8,
        (16, _) => types::I16,
        (32, false) => types::I32,
        (32, true) => types::F32,
        (_, false) => types::I64,
        (_, true) => types::F64,
    };
    element.by(of.lanes()).expect("Cranelift has these vectors")
}

fn relation(comparison: Comparison) -> IntCC {
    match comparison {
        Comparison::Equal => IntCC::Equal,
        Comparison::NotEqual => IntCC::NotEqual,
        Comparison::SignedLessThan => IntCC::SignedLessThan,
        Comparison::SignedLessThanOrEqual => IntCC::SignedLessThanOrEqual,
        Comparison::SignedGreaterThan => IntCC::SignedGreaterThan,
        Comparison::SignedGreaterThanOrEqual => IntCC::SignedGreaterThanOrEqual,
        Comparison::UnsignedLessThan => IntCC::UnsignedLessThan,
        Comparison::UnsignedLessThanOrEqual => IntCC::UnsignedLessThanOrEqual,
        Comparison::UnsignedGreaterThan => IntCC::UnsignedGreaterThan,
        Comparison::UnsignedGreaterThanOrEqual => IntCC::UnsignedGreaterThanOrEqual,
    }
}

/// The end of a block.
struct End<'b> {
    func: &'b mut ir::Function,
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
