//! The strip programs of every block of the catalogues, with vectors of each width. Their text is read as it was
//! printed. Every access is shown to stay in its allocation, and old values are read before they change. Programs that
//! have lost a mask or a minimum of an address are refused, unless its index stays in the padding. So are programs that
//! read what they have changed.

use tilewright_cosim::workers;
use tilewright_hdl::catalog::Entry;
use tilewright_sim::{Examined, Passes, Target, examined};

#[test]
fn the_programs_of_every_block_pass_the_checks_and_mutants_do_not() {
    let entries: Vec<&Entry> =
        tilewright_rtl::catalog::ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES).collect();
    let targets = [Target::Code, Target::Strips { vector: 64 }, Target::Strips { vector: 256 }];
    let cases: Vec<(&Entry, Target)> =
        entries.iter().flat_map(|entry| targets.map(|target| (*entry, target))).collect();
    let all = workers::each(&cases, |(entry, target)| {
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        examined(&design, &Passes { target: *target, ..Passes::default() })
    });
    let wrong: Vec<String> = cases
        .iter()
        .zip(&all)
        .flat_map(|((entry, target), found)| {
            found.wrong.iter().map(move |wrong| format!("{} for {target:?}: {wrong}", entry.name))
        })
        .collect();
    assert!(wrong.is_empty(), "{} programs are wrong, the first of them:\n{}", wrong.len(), wrong[0]);
    let sum = |of: fn(&Examined) -> usize| all.iter().map(of).sum::<usize>();
    let (programs, accesses) = (sum(|it| it.programs), sum(|it| it.accesses));
    let (clamps, refused, wild) = (sum(|it| it.clamps), sum(|it| it.refused), sum(|it| it.wild));
    let (padded, bounded) = (sum(|it| it.padded), sum(|it| it.bounded));
    let (late, found) = (sum(|it| it.late), sum(|it| it.found));
    let probed = sum(|it| it.probed);
    println!(
        "{programs} programs, {probed} run on large numbers, {accesses} accesses; refused: {found} of {late} late"
    );
    println!(
        "{clamps} unclamped: {refused} refused ({wild} run wild), {padded} in padding, {bounded} bounded otherwise"
    );
    assert!(programs > 200 && accesses > 20_000, "{programs} programs with {accesses} accesses");
    assert!(10 * probed > 9 * programs, "{probed} of {programs} programs run on large numbers");
    assert!(clamps > 50 && 5 * refused > 2 * clamps, "{refused} of {clamps} without a clamp are refused");
    // What is accepted is run on the largest numbers, and must stay in its memory; what is refused need not.
    assert!(wild > 10 && padded > 10 && bounded > 0, "{wild} run wild, {padded} and {bounded} are accepted");
    assert_eq!(refused + padded + bounded, clamps);
    assert!(late > 100 && found == late, "{found} of {late} that read what they have changed are refused");
}
