//! The examples satisfy their own assertions.

#[path = "../examples/cache.rs"]
mod cache;
#[path = "../examples/counter.rs"]
mod counter;
#[path = "../examples/crossing.rs"]
mod crossing;
#[path = "../examples/fifo.rs"]
mod fifo;
#[path = "../examples/program.rs"]
mod program;
#[path = "../examples/rv32i.rs"]
mod rv32i;
#[path = "../examples/systolic.rs"]
mod systolic;
#[path = "../examples/transform.rs"]
mod transform;
#[path = "../examples/uart.rs"]
mod uart;
#[path = "../examples/windows.rs"]
mod windows;

use tilewright_gen::{testbench, tools, verilog};

#[test]
fn the_counter_runs() {
    counter::main().unwrap();
}

#[test]
fn the_crossing_runs() {
    crossing::main().unwrap();
}

#[test]
fn the_queue_runs() {
    fifo::main().unwrap();
}

#[test]
fn the_matrices_are_multiplied() {
    systolic::main().unwrap();
}

#[test]
fn the_program_runs() {
    program::main().unwrap();
}

#[test]
fn the_processor_runs() {
    let left = rv32i::run(&[]).unwrap();
    assert_eq!([10, 13, 14].map(|number| left.registers[number]), [385, 0xffff_ff81, 0x81]);
}

/// Stores and loads words, halves and bytes at unaligned addresses, and branches.
#[rustfmt::skip]
const MISALIGNED: [u32; 25] = [
    0x1234_50b7, // lui  x1, 0x12345
    0x6780_8093, // addi x1, x1, 0x678
    0x2000_0113, // li   x2, 0x200
    0x0011_20a3, // sw   x1, 1(x2)
    0x0011_23a3, // sw   x1, 7(x2)
    0x0011_17a3, // sh   x1, 15(x2)
    0x0011_01a3, // sb   x1, 3(x2), within the first word
    0x0011_2183, // lw   x3, 1(x2)
    0x0071_2203, // lw   x4, 7(x2)
    0x00f1_1283, // lh   x5, 15(x2)
    0x0021_5303, // lhu  x6, 2(x2)
    0x0041_0383, // lb   x7, 4(x2)
    0xf800_0413, // li   x8, -128
    0x0081_19a3, // sh   x8, 19(x2)
    0x0131_1483, // lh   x9, 19(x2)
    0x0131_5503, // lhu  x10, 19(x2)
    0x0131_0583, // lb   x11, 19(x2)
    0x0131_4603, // lbu  x12, 19(x2)
    0x0050_0693, // li   x13, 5
    0x00d7_0733, // loop: add x14, x14, x13
    0xfff6_8693, // addi x13, x13, -1
    0xfe06_9ce3, // bnez x13, loop
    0x0004_4463, // bltz x8, stop
    0x0630_0713, // li   x14, 99
    0x0000_006f, // stop: j stop
];

#[test]
fn the_processor_runs_a_binary_to_its_stop_address() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("misaligned.bin");
    std::fs::write(&file, MISALIGNED.map(u32::to_le_bytes).concat()).unwrap();
    let run = |more: &[&str]| {
        let file = [file.display().to_string()];
        rv32i::run(&file.into_iter().chain(more.iter().map(|text| (*text).to_owned())).collect::<Vec<_>>())
    };
    let left = run(&["0x60"]).unwrap();
    let expected = [
        0,
        0x1234_5678,
        0x200,
        0x1278_5678,
        0x1234_5678,
        0x5678,
        0x7856,
        0x12,
        0xffff_ff80,
        0xffff_ff80,
        0xff80,
        0xffff_ff80,
        0x80,
        0,
        15,
    ];
    assert_eq!(left.registers[..15], expected);
    // 19 instructions before the loop, 5 times 3 in it, and a branch over an instruction.
    assert_eq!((left.instructions, run(&["96", "35"]).unwrap().instructions), (35, 35));
    let refused = |more: &[&str]| run(more).err().unwrap();
    assert!(refused(&["0x60", "34"]).starts_with("it does not come to 0x60 in 34 instructions: correct the address"));
    assert!(refused(&["6o"]).starts_with("`6o` is no number: write it in decimal, or in hexadecimal with 0x"));
    assert_eq!(refused(&["0x100000000"]), "0x100000000 is no address of 32 bits");
    assert!(refused(&[]).starts_with("give a flat binary, a stop address"));
}

#[test]
fn the_bytes_go_over_the_line() {
    uart::main().unwrap();
}

#[test]
fn the_vectors_are_transformed() {
    transform::main().unwrap();
}

#[test]
fn the_cache_does_what_its_model_does() {
    cache::main().unwrap();
}

#[test]
fn the_verilog_of_the_examples_does_the_same() {
    for (design, recording) in [uart::run(), transform::run(), cache::run()].map(Result::unwrap) {
        let files = verilog(&design);
        tools::lint(&files).unwrap();
        let _ = tools::replay_in_icarus(&files, &testbench(&design, &recording)).unwrap();
    }
}

#[test]
fn the_windows_are_divided() {
    windows::main().unwrap();
}

#[test]
fn what_a_page_shows_of_a_block_is_in_that_block() {
    let page = include_str!("../../docs/decisions/lines.md");
    let mut pieces = page.split("```rust\n");
    let mut before = pieces.next().unwrap();
    let (mut count, root) = (0, concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    for piece in pieces {
        let file =
            before.trim_end().strip_suffix("`:").and_then(|named| named.rsplit_once('`')).expect("a file is named").1;
        let source = std::fs::read_to_string(format!("{root}/{file}")).expect(file);
        let (code, after) = piece.split_once("\n```").expect("the code ends");
        let flat = |text: &str| text.lines().map(|line| line.trim().to_owned() + "\n").collect::<String>();
        assert!(flat(&source).contains(&flat(code)), "{file} has no\n{code}");
        (before, count) = (after, count + 1);
    }
    assert!(count > 8, "only {count} pieces are found");
}
