//! The judge of ways: for mutants of a machine's hardware that change a frame, whether the first difference on the way of the first wrong pixel
//! is at the mutated block.
//!
//! `cargo run -p tilewright-machines --features mutation --example judge -- MACHINE [COUNT] [SEED]`: the mutants of a module that is chosen at
//! random, until COUNT of them change the frame. Each is rendered in a process of its own, as some never end.

mod subjects;

use std::collections::BTreeMap;
use std::io::Read;
use std::process::{Command, ExitCode, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tilewright_hdl::Design;
use tilewright_machines::Follower;
use tilewright_mutants::{Mutant, VARIABLE, block, mutants};

use subjects::{NAMES, SUBJECTS, Subject};

/// The seconds after which a rendering is stopped.
const PATIENCE: u64 = 40;

/// What a process says of the frame that it rendered.
enum Frames {
    Same,
    Wrong([u32; 2]),
    /// The run fails, or does not end.
    None,
}

/// What the first difference on a way is at.
struct Named {
    block: String,
    sentence: String,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let find = |name: &str| SUBJECTS.into_iter().find(|subject| subject.name == name);
    let Some(subject) = words.first().and_then(|name| find(name)) else {
        eprintln!("usage: judge MACHINE [COUNT] [SEED]; MACHINE is one of:");
        SUBJECTS.iter().for_each(|subject| eprintln!("  {}", subject.name));
        return ExitCode::from(2);
    };
    match words[1..] {
        ["frame"] => say_frame(&subject),
        ["way", x, y] => say_way(&subject, [x, y].map(|place| place.parse().expect("a number"))),
        _ => judge(&subject, number(&words, 1, 25), number(&words, 2, 1) as u64),
    }
    ExitCode::SUCCESS
}

fn number(words: &[&str], place: usize, otherwise: usize) -> usize {
    words.get(place).map_or(otherwise, |word| word.parse().expect("a number"))
}

fn say_frame(subject: &Subject) {
    let golden = (subject.golden)();
    match (subject.render)(None) {
        Err(error) => println!("failed {error}"),
        Ok(frame) => match (0..).zip(golden.words.iter().zip(&frame.words)).find(|(_, (a, b))| a != b) {
            Some((place, _)) => println!("wrong {} {}", place % golden.size().width(), place / golden.size().width()),
            None => println!("same"),
        },
    }
}

fn say_way(subject: &Subject, pixel: [u32; 2]) {
    let follower = Follower::new(pixel);
    let _ = (subject.render)(Some(&follower));
    let Some(way) = follower.take() else { return println!("none\tthere is no way") };
    match way.first_difference() {
        None => println!("none\tno step of {} differs", way.steps.len()),
        Some(step) => {
            let values = step.values.iter().filter(|value| value.differs());
            let values =
                values.map(|it| format!("{} {} not {}", it.what, it.hardware, it.golden.as_deref().unwrap_or("")));
            let values: Vec<String> = values.collect();
            println!(
                "{}\t{} {} in {} {}: {}",
                step.block,
                step.unit,
                step.does,
                step.clock,
                step.cycle,
                values.join(", ")
            );
        }
    }
}

/// The output of this program with those arguments and a mutant; `None` if it breaks, or does not end in time.
fn asked(arguments: &[&str], mutant: &str) -> Option<String> {
    let mut command = Command::new(std::env::current_exe().expect("it has a path"));
    command.args(arguments).env(VARIABLE, mutant).stdout(Stdio::piped()).stderr(Stdio::null());
    let (mut child, begin) = (command.spawn().expect("it can be run"), Instant::now());
    while child.try_wait().expect("it is a child").is_none() {
        if begin.elapsed() > Duration::from_secs(PATIENCE) {
            child.kill().expect("it runs");
            child.wait().expect("it is a child");
            return None;
        }
        sleep(Duration::from_millis(5));
    }
    let mut said = String::new();
    child.stdout.take()?.read_to_string(&mut said).ok()?;
    Some(said.trim().to_owned()).filter(|said| !said.is_empty())
}

fn frames(subject: &Subject, mutant: &str) -> Frames {
    let said = asked(&[subject.name, "frame"], mutant);
    let words: Vec<&str> = said.as_deref().unwrap_or_default().split(' ').collect();
    match words[..] {
        ["same"] => Frames::Same,
        ["wrong", x, y] => Frames::Wrong([x, y].map(|place| place.parse().expect("a number"))),
        _ => Frames::None,
    }
}

fn named(subject: &Subject, mutant: &str, [x, y]: [u32; 2]) -> Named {
    let said = asked(&[subject.name, "way", &x.to_string(), &y.to_string()], mutant);
    let said = said.unwrap_or_else(|| "none\tthe run breaks, or does not end".to_owned());
    let (block, sentence) = said.split_once('\t').unwrap_or(("none", &said));
    Named { block: block.to_owned(), sentence: sentence.to_owned() }
}

/// The name of a type of block in the catalogue.
fn catalogued(machine: &str, of: &str) -> String {
    if let Some((_, _, name)) = NAMES.iter().find(|(there, block, _)| (*there, *block) == (machine, of)) {
        return (*name).to_owned();
    }
    let mut name = String::new();
    for letter in of.chars() {
        if letter.is_uppercase() && !name.is_empty() {
            name.push('-');
        }
        name.extend(letter.to_lowercase());
    }
    name
}

/// The names of the blocks that have an instance of each block.
fn parents(machine: &str, designs: &[Design]) -> BTreeMap<String, Vec<String>> {
    let mut parents: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (design, module) in designs.iter().flat_map(|design| design.modules().iter().map(move |it| (design, it))) {
        for instance in &module.instances {
            let of = catalogued(machine, block(&design.modules()[instance.module.0 as usize]));
            parents.entry(of).or_default().push(catalogued(machine, block(module)));
        }
    }
    parents
}

/// A number below `most`, and the next state: SplitMix64.
fn random(state: &mut u64, most: usize) -> usize {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) % most as u64) as usize
}

/// The ends of runs that differ from the right one.
const KINDS: [&str; 2] = ["a wrong frame", "no frame"];

/// Mutants, those whose block the first difference names, and those of which it names the enclosing unit.
#[derive(Clone, Copy, Default)]
struct Counts {
    all: usize,
    named: usize,
    enclosing: usize,
}

fn judge(subject: &Subject, count: usize, seed: u64) {
    let (designs, golden) = ((subject.designs)(), (subject.golden)());
    let mut modules: Vec<Vec<Mutant>> =
        designs.iter().flat_map(|design| design.modules()).map(mutants).filter(|it| !it.is_empty()).collect();
    let parents = parents(subject.name, &designs);
    // For a run without a frame: the first pixel that something covers.
    let covered = golden.words.iter().position(|word| word >> 24 != 0xff_ffff).unwrap_or(0) as u32;
    let covered = [covered % golden.size().width(), covered / golden.size().width()];
    let (mut state, mut tried) = (seed, 0);
    // Of wrong frames, and of runs without a frame.
    let mut counts = [Counts::default(); 2];
    let mut misses = Vec::new();
    while counts[0].all < count && !modules.is_empty() {
        let module = random(&mut state, modules.len());
        let of_module = &mut modules[module];
        let mutant = of_module.swap_remove(random(&mut state, of_module.len()));
        if of_module.is_empty() {
            modules.remove(module);
        }
        tried += 1;
        let sentence = mutant.to_string();
        let (pixel, kind) = match frames(subject, &sentence) {
            Frames::Same => continue,
            Frames::Wrong(pixel) => (pixel, 0),
            Frames::None => (covered, 1),
        };
        let counts = &mut counts[kind];
        counts.all += 1;
        let found = named(subject, &sentence, pixel);
        let right = catalogued(subject.name, &mutant.block);
        let is_parent = parents.get(&right).is_some_and(|parents| parents.contains(&found.block));
        if found.block == right {
            counts.named += 1;
            eprintln!("named: {sentence}");
            continue;
        }
        counts.enclosing += usize::from(is_parent);
        let is_parent = if is_parent { " (the enclosing unit)" } else { "" };
        let miss = format!("{sentence}\n    {}: {}{is_parent}: {}", KINDS[kind], found.block, found.sentence);
        eprintln!("miss: {miss}");
        misses.push(miss);
    }
    println!("{tried} mutants\n\n| machine | the run ends with | mutants | named | the enclosing unit | missed |");
    println!("|---|---|---|---|---|---|");
    for (kind, Counts { all, named, enclosing }) in KINDS.into_iter().zip(counts) {
        println!("| {} | {kind} | {all} | {named} | {enclosing} | {} |", subject.name, all - named - enclosing);
    }
    misses.iter().for_each(|miss| println!("{miss}"));
}
