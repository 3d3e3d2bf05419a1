//! A processor of RV32I without fences, system calls and control registers: an instruction every clock.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, Signal, bit, bits, block, case, cat, def, lit, mux, select};

use super::program::program;

/// Words of the data memory.
const WORDS: u32 = 1024;

block! {
    /// One of the processors.
    pub struct Processor;
    in ProcessorIn {
        /// It starts at address 0 when this goes low.
        rst: bit(),
        /// The word read at addresses from 2^31 on.
        word: bits(32),
    }
    out ProcessorOut {
        /// The address of the instruction.
        pc: bits(32),
        /// The instruction.
        instruction: bits(32),
        /// The new value of a register.
        result: bits(32),
        /// The address of a load or store.
        address: bits(32),
        /// The bytes that are stored.
        stores: bits(4),
        /// The word to store.
        data: bits(32),
        /// The sum of all results and addresses.
        sum: bits(32),
    }
}

impl Processor {
    fn build(&self, m: Module, i: ProcessorIn) -> ProcessorOut {
        let words = program();
        def!(pc = m.reg(32));
        def!(code = m.memory(words.len().next_power_of_two() as u32, 32, ReadUnderWrite::Old));
        let code = code.words(words);
        def!(instruction = code.read_async(pc.slice(2..2 + code.address_width())));
        let Decoded { opcode, function, alternative, immediate, to, from } = decode(instruction);
        let is = |code: u64| opcode.eq(code);

        def!(registers = m.memory(32, 32, ReadUnderWrite::Old).fill(Bits::zero(32)));
        let [left, right] = from.map(|from| registers.read_async(from));
        let (left, right) = (left.named("left"), right.named("right"));

        // Arithmetic: on two registers, or on one and a constant.
        def!(operand = mux(is(0b01100), right, immediate));
        def!(places = operand.trunc(5));
        def!(subtracts = is(0b01100) & alternative);
        let results: [(u64, Signal); 8] = [
            (0, mux(subtracts, left - operand, left + operand)),
            (1, left << places),
            (2, left.signed().lt(operand.signed()).zext(32)),
            (3, left.lt(operand).zext(32)),
            (4, left ^ operand),
            (5, mux(alternative, (left.signed() >> places).bits(), left >> places)),
            (6, left | operand),
            (7, left & operand),
        ];
        def!(computed = case(function, results, lit(32, 0)));

        // Memory: bytes side by side.
        def!(address = left + immediate);
        def!(place = address.slice(2..12));
        let size = function.trunc(2);
        let lowest = address.trunc(2);
        def!(bytes = case(size, [(0, lit(4, 1) << lowest), (1, lit(4, 3) << lowest)], lit(4, 15)));
        def!(stores = mux(is(0b01000) & !i.rst, bytes, 0));
        def!(data = right << cat![lowest, lit(3, 0)]);
        let lanes = [0, 1, 2, 3].map(|byte: u32| {
            let lane = m.memory(&format!("byte{byte}"), WORDS, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
            lane.write(stores.bit(byte), place, data.slice(8 * byte..8 * byte + 8));
            lane.read_async(place)
        });
        def!(fetched = mux(address.msb(), i.word, cat![lanes[3], lanes[2], lanes[1], lanes[0]]));
        def!(moved = fetched >> cat![lowest, lit(3, 0)]);
        let narrow = |width: u32| mux(function.bit(2), moved.trunc(width).zext(32), moved.trunc(width).sext(32));
        def!(loaded = case(size, [(0, narrow(8)), (1, narrow(16))], fetched));

        // The next address.
        def!(following = *pc + 4);
        let (less, less_unsigned) = (left.signed().lt(right.signed()), left.lt(right));
        let holds = case(function.slice(1..3), [(0, left.eq(right)), (2, less)], less_unsigned);
        def!(branches = is(0b11000) & (holds ^ function.bit(0)));
        def!(target = *pc + immediate);
        let next = select([(is(0b11001), address), (is(0b11011) | branches, target)], following);
        pc.next(mux(i.rst, 0, next));

        let results =
            [(0b00000, loaded), (0b00101, target), (0b01101, immediate), (0b11001, following), (0b11011, following)];
        def!(result = case(opcode, results, computed));
        def!(writes = !is(0b11000) & !is(0b01000) & to.ne(0) & !i.rst);
        registers.write(writes, to, result);

        def!(sum = m.reg(32));
        sum.next(mux(i.rst, 0, sum.rotate_left(1) + (result ^ address)));
        ProcessorOut { pc: *pc, instruction, result, address, stores, data, sum: *sum }
    }
}

/// The parts of an instruction.
struct Decoded {
    /// The kind of instruction, without the two bits that are always set.
    opcode: Signal,
    /// The operation among those of its kind.
    function: Signal,
    /// Whether it subtracts, or shifts with the sign.
    alternative: Signal,
    /// The constant in it, decoded for its kind.
    immediate: Signal,
    /// The register that takes the result.
    to: Signal,
    /// The registers that it reads.
    from: [Signal; 2],
}

fn decode(word: Signal) -> Decoded {
    let opcode = word.slice(2..7).named("opcode");
    let function = word.slice(12..15).named("function");
    let upper = cat![word.slice(12..32), lit(12, 0)];
    let short = word.slice(20..32).sext(32);
    let store = cat![word.slice(25..32), word.slice(7..12)].sext(32);
    let branch = cat![word.bit(31), word.bit(7), word.slice(25..31), word.slice(8..12), lit(1, 0)].sext(32);
    let jump = cat![word.bit(31), word.slice(12..20), word.bit(20), word.slice(21..31), lit(1, 0)].sext(32);
    let forms = [(0b00101, upper), (0b01101, upper), (0b01000, store), (0b11000, branch), (0b11011, jump)];
    let immediate = case(opcode, forms, short).named("immediate");
    // In an addition of a constant, part of the constant is where other operations have this flag.
    let alternative = (word.bit(30) & (opcode.eq(0b01100) | function.eq(5))).named("alternative");
    Decoded {
        opcode,
        function,
        alternative,
        immediate,
        to: word.slice(7..12),
        from: [(15, 20), (20, 25)].map(|(low, high)| word.slice(low..high)),
    }
}
