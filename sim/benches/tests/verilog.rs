//! The printed and the hand-written Verilog of the designs, in the tools that read Verilog.

use tilewright_benches::designs::{Core, Pim, Pxpl, Qt, Regions, Simd, Vc1Frames};
use tilewright_benches::{HandWritten, RESET_CYCLES, Subject, reset};
use tilewright_gen::tools::{lint, replay_in_icarus};
use tilewright_gen::{VerilogFile, testbench, verilog};
use tilewright_hdl::{Design, elaborate};
use tilewright_rtl::parameter::Screen;
use tilewright_sim::Simulation;

/// Small designs; a small screen, because Yosys is slow with the contents of memories.
fn small() -> [Design; 7] {
    let pim = elaborate(&Pim { stages: 2, columns: 7, rows: 5 });
    let vc1 = elaborate(&Vc1Frames::new(Screen { width: 12, height: 8 }, 2).unwrap());
    let core = elaborate(&Core { processors: 2 });
    let qt = elaborate(&Qt::new(2, false));
    let regions = elaborate(&Regions::new(8).unwrap());
    let (simd, pxpl) = (elaborate(&Simd { edge: 3 }), elaborate(&Pxpl { edge: 8 }));
    [pim, qt, core, simd, pxpl, vc1, regions].map(|design| design.unwrap())
}

#[test]
fn no_linter_complains_of_what_is_printed() {
    for design in small() {
        lint(&verilog(&design)).unwrap();
    }
}

#[test]
fn icarus_repeats_what_is_printed() {
    for design in small() {
        let mut sim = Simulation::from_design(&design).unwrap();
        let recording = sim.recording();
        reset(&mut sim).unwrap();
        sim.run(1000);
        let bench = testbench(&design, &recording.take());
        let _ = replay_in_icarus(&verilog(&design), &bench).unwrap();
    }
}

#[test]
fn what_is_written_by_hand_has_the_known_checksums() {
    for name in ["pim16", "qt16", "simd16", "pxpl16"] {
        let subject: Subject = name.parse().unwrap();
        let (cycles, checksum) = subject.known().next().unwrap();
        let all = subject.hand_written();
        assert!(!all.is_empty(), "{name} was not written by hand");
        for written in all {
            let file = VerilogFile { name: format!("{}.v", written.module), text: written.text.to_owned() };
            let bench = bench(&written, cycles, checksum);
            let _ = replay_in_icarus(&[file], &bench).unwrap_or_else(|problems| panic!("{subject}: {problems}"));
        }
    }
}

/// A testbench that compares the checksum after `cycles` cycles.
fn bench(written: &HandWritten, cycles: u64, checksum: u32) -> VerilogFile {
    let (module, (parameter, value)) = (written.module, written.parameter);
    let text = format!(
        "module bench;
    reg clk = 0;
    reg rst = 1;
    wire [31:0] csum;
    {module} #(.{parameter}({value})) dut (.clk(clk), .rst(rst), .csum(csum));
    initial begin
        repeat ({RESET_CYCLES}) begin #1 clk = 1; #1 clk = 0; end
        rst = 0;
        repeat ({cycles}) begin #1 clk = 1; #1 clk = 0; end
        if (csum === 32'h{checksum:x}) $display(\"PASS: {cycles} cycles\");
        else $display(\"{module}: checksum %h instead of {checksum:x}\", csum);
        $finish;
    end
endmodule
"
    );
    VerilogFile { name: "bench.v".to_owned(), text }
}
