//! A processor of the RV32I instruction set, one instruction a clock, without interrupts; words and halves may be at
//! any address. It loads a flat binary at address 0 and runs it until a stop address, decimal or with `0x`:
//! `cargo run -p tilewright-hdl --example rv32i -- program.bin 0x80`. Without arguments, it runs a program of its
//! own. A third argument limits the number of instructions; the default is a thousand million. If the program exceeds
//! it, the exit code is 1.

use std::process::ExitCode;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

codes! {
    /// The kind of an instruction, by its bits 2 to 6.
    enum Opcode {
        Load = 0b00_000, Fence = 0b00_011, Immediate = 0b00_100, AddToPc = 0b00_101,
        Store = 0b01_000, Register = 0b01_100, LoadUpper = 0b01_101,
        Branch = 0b11_000, JumpRegister = 0b11_001, Jump = 0b11_011, System = 0b11_100,
    }

    /// The operation of the arithmetic unit, by `funct3`.
    enum Operation { Add, ShiftLeft, Less, LessUnsigned, Xor, ShiftRight, Or, And }
}

bundle! {
    /// The immediate operands of the instruction formats.
    struct Immediates<T> { i: T, s: T, b: T, u: T, j: T }
}

fn immediates(instruction: Signal) -> Immediates {
    let sign = instruction.bit(31);
    Immediates {
        i: instruction.part(20, 12).sext(32),
        s: cat![instruction.part(25, 7), instruction.part(7, 5)].sext(32),
        b: cat![sign, instruction.bit(7), instruction.part(25, 6), instruction.part(8, 4), lit(1, 0)].sext(32),
        u: cat![instruction.part(12, 20), lit(12, 0)],
        j: cat![sign, instruction.part(12, 8), instruction.bit(20), instruction.part(21, 10), lit(1, 0)].sext(32),
    }
}

block! {
    /// The processor with its memory.
    struct Core {
        /// The words of memory, a power of two.
        words: u32,
        /// The address at which it stops.
        stop: u32,
    }
    ranges { words: powers_of_two(2..) }
    out CoreOut {
        /// The address of the instruction.
        pc: bits(32),
        /// It has come to the address at which it stops.
        stopped: bit(),
    }
}

impl Core {
    fn build(&self, m: Module, _: ()) -> CoreOut {
        def!(pc = m.reg(32).reset(0));
        def!(stopped = pc.eq(self.stop));

        // Four bytes side by side, each with an address of its own: an access that is not aligned to 4 bytes is
        // spread over two words.
        def!(memory = m.memory(self.words, bits(8).of(4), ReadUnderWrite::Any));
        let place = |address: Signal| address.part(2, memory.address_width());
        let places = |address: Signal| place(address.of(4) + constants(bits(32).of(4), |lane| 3 - lane));
        def!(instruction = memory.read_async(place(*pc)).pack());
        def!(opcode = instruction.part(2, 5).code::<Opcode>());
        def!(funct3 = instruction.part(12, 3));
        let immediate = immediates(instruction);

        let registers = m.memory("x", 32, 32, ReadUnderWrite::Any).fill(Bits::zero(32));
        def!(left = registers.read_async(instruction.part(15, 5)));
        def!(right = registers.read_async(instruction.part(20, 5)));

        let computes_with_register = opcode.is(Opcode::Register);
        def!(operand = mux(computes_with_register, right, immediate.i));
        let is_other = instruction.bit(30);
        let amount = operand.trunc(5);
        def!(operation = funct3.code::<Operation>());
        def! { computed = choose!(operation, Operation {
            Add => mux(computes_with_register & is_other, left - operand, left + operand),
            ShiftLeft => left << amount,
            Less => left.signed().lt(operand.signed()).zext(32),
            LessUnsigned => left.lt(operand).zext(32),
            Xor => left ^ operand,
            ShiftRight => mux(is_other, (left.signed() >> amount).bits(), left >> amount),
            Or => left | operand,
            And => left & operand,
        }) }

        // Branches: equal, less, less unsigned, or the reverse.
        let less = [(2, left.signed().lt(right.signed())), (3, left.lt(right))];
        def!(taken = case(funct3.part(1, 2), less, left.eq(right)) ^ funct3.bit(0));
        def!(following = pc + 4);
        def! { target = choose!(opcode, Opcode {
            Jump => pc + immediate.j,
            JumpRegister => cat![(left + immediate.i).part(1, 31), lit(1, 0)],
            Branch => mux(taken, pc + immediate.b, following),
            _ => following,
        }) }
        pc.when(!stopped, target);

        // Loads and stores of 1, 2 or 4 bytes.
        def!(address = left + mux(opcode.is(Opcode::Store), immediate.s, immediate.i));
        let offset = address.trunc(2);
        let bits_below = cat![offset, lit(3, 0)];
        def!(found = memory.read_async(places(address)).pack());
        def!(word = (cat![found, found] >> bits_below).trunc(32));
        let is_unsigned = funct3.bit(2);
        let extended = |bits: u32| mux(is_unsigned, word.trunc(bits).zext(32), word.trunc(bits).sext(32));
        def!(loaded = case(funct3.part(0, 2), [(0, extended(8)), (1, extended(16))], word));
        let size = funct3.part(0, 2);
        let bytes = (cat![right, right] << bits_below).part(32, 32);
        let those = case(size, arms![0 => lit(4, 1), 1 => 3], 15);
        def!(written = (cat![those, those] << offset).part(4, 4));
        memory.write(opcode.is(Opcode::Store) & !stopped & written.unpack(4), places(address), bytes.unpack(4));

        def! { result = choose!(opcode, Opcode {
            Load => loaded,
            LoadUpper => immediate.u,
            AddToPc => pc + immediate.u,
            Jump | JumpRegister => following,
            _ => computed,
        }) }
        let has_none = [Opcode::Store, Opcode::Branch, Opcode::Fence, Opcode::System].map(|none| opcode.is(none));
        let to = instruction.part(7, 5);
        registers.write(!stopped & to.ne(0) & !stack(has_none).or_all(), to, result);
        CoreOut { pc: *pc, stopped }
    }
}

/// The sum of the squares from 1 to 10, by additions only, and a byte stored and loaded again.
const PROGRAM: [u32; 14] = [
    0x00a0_0593, // li   a1, 10
    0x0000_0513, // li   a0, 0
    0x0005_8613, // outer: mv a2, a1
    0x00b5_0533, // inner: add a0, a0, a1
    0xfff6_0613, // addi a2, a2, -1
    0xfe06_1ce3, // bnez a2, inner
    0xfff5_8593, // addi a1, a1, -1
    0xfe05_96e3, // bnez a1, outer
    0x10a0_01a3, // sb   a0, 259(zero)
    0x1030_0683, // lb   a3, 259(zero)
    0x1030_4703, // lbu  a4, 259(zero)
    0x0000_0013, // nop
    0x0000_0013, // nop
    0x0000_006f, // stop: j stop
];

/// The result of a program.
pub struct Left {
    /// The number of instructions executed.
    pub instructions: u64,
    /// The values of the registers.
    pub registers: Vec<u32>,
}

/// Runs the program that the arguments name, or the one above; a test does so too.
pub fn run(arguments: &[String]) -> Result<Left, String> {
    let (bytes, stop, limit) = match arguments {
        [] => (PROGRAM.iter().flat_map(|word| word.to_le_bytes()).collect(), 4 * (PROGRAM.len() as u32 - 1), MOST),
        [file, stop, limit @ ..] if limit.len() < 2 => {
            let bytes = std::fs::read(file).map_err(|error| format!("{file} cannot be read: {error}"))?;
            let stop = u32::try_from(number(stop)?).map_err(|_| format!("{stop} is no address of 32 bits"))?;
            (bytes, stop, limit.first().map_or(Ok(MOST), |limit| number(limit))?)
        }
        _ => return Err("give a flat binary, a stop address and, if you like, a limit of instructions".to_owned()),
    };
    execute(&bytes, stop, limit).map_err(|error| error.to_string())?.ok_or_else(|| {
        format!("it does not come to {stop:#x} in {limit} instructions: correct the address, or give a higher limit as third argument")
    })
}

/// The default limit of instructions.
const MOST: u64 = 1_000_000_000;

fn number(text: &str) -> Result<u64, String> {
    let number = text.strip_prefix("0x").map_or_else(|| text.parse(), |digits| u64::from_str_radix(digits, 16));
    number.map_err(|_| format!("`{text}` is no number: write it in decimal, or in hexadecimal with 0x before it"))
}

/// The result of the program at its stop address; `None` if it did not reach that.
fn execute(bytes: &[u8], stop: u32, limit: u64) -> Result<Option<Left>, Box<dyn std::error::Error>> {
    let words = (bytes.len().div_ceil(4) as u32).next_power_of_two().max(16_384);
    let mut sim = Simulation::of(&Core { words, stop })?;
    for (address, byte) in bytes.iter().enumerate() {
        sim.poke_memory(&format!("memory[{}]", address % 4), address as u32 / 4, *byte)?;
    }
    sim.reset();
    let Some(instructions) = sim.run_until(sim.o.stopped, limit) else { return Ok(None) };
    let mut registers = Vec::new();
    for number in 0..32 {
        registers.push(sim.peek_memory("x", number)?.to_u64().expect("32 bits") as u32);
    }
    Ok(Some(Left { instructions, registers }))
}

/// Prints the result.
#[cfg_attr(test, allow(dead_code, reason = "tests look at what `run` gives"))]
fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(Left { instructions, registers }) => {
            println!("{instructions} instructions; gp = {}, a0 = {}", registers[3], registers[10]);
            ExitCode::SUCCESS
        }
        Err(sentence) => {
            eprintln!("error: {sentence}");
            ExitCode::FAILURE
        }
    }
}
