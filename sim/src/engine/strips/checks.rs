//! What the parser and the checks say of programs.

use super::bounds::{Base, Extent, Surroundings};
use super::program::Program;
use super::text::Notes;

/// A register of 64 bytes with padding before and behind it, and one of 4 bits behind that. Then a memory of 32 bytes, a place with the
/// address of one of 64, and a table of numbers up to 63.
struct Memory;

const ADDRESS: usize = 4096;

impl Surroundings for Memory {
    fn extent(&self, base: Base, at: i64) -> Option<Extent> {
        let extent = |start, end, integer, most, is_state| Some(Extent { start, end, integer, most, is_state });
        match (base, at) {
            (Base::State, 0..128) => extent(0, 128, 8, 255, true),
            (Base::State, 128..136) => extent(128, 136, 64, 15, true),
            (Base::State, 136..144) => extent(136, 144, 64, u64::MAX, false),
            (Base::State, 160..176) => extent(160, 176, 8, 63, false),
            (Base::Known(ADDRESS), 0..32) => extent(0, 32, 8, 255, true),
            (Base::Stored(136), 0..64) => extent(0, 64, 64, u64::MAX, false),
            _ => None,
        }
    }

    fn is_address(&self, offset: i64) -> bool {
        offset == 136
    }
}

fn parsed(text: &str) -> Program {
    Program::parse(text, &[ADDRESS]).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// What the checks say of a program that ends by returning its argument.
fn said(text: &str) -> String {
    parsed(&format!("{text}\nreturn argument")).check(&Memory).err().unwrap_or_default()
}

const LOOP: &str = "
loop v0: i64 = 0
  v1: i64 = add state v0
  v2: i8x16 = load [v1 + 32] ; q
  v3: i8x16 = add v2 0x01
  store i8x16 [v1 + 32] v3
  v4: i64 = add v0 16
  v5: i8 = ult i64 v4 64
again if v5 with v4";

#[test]
fn a_text_is_read_as_it_was_printed() {
    let text = "scratch 3
stack 64
v0: i32x4 = load_unaligned [state + -4]
v1: i16x8 = load_sign_extended [scratch]
v2: i32x4 = shuffle v0 (0x00000001 0x00000002 0x00000003 0x00000004) by 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 31
v3: i32x4 = set lane 2 of v2 to 7
v4: i32 = lane 2 of i32x4 v3
v5: i64 = zero_extend i32 v4
loop v6: i64 = 3, v7: f32x4 = 0x3f800000
  v8: i8 = ne i64 v6 0
  leave unless v8 with i64 v5 f32x4 v7
  if v8
    store_unaligned f32x4 [state + 16] v7
  else
    call @0 v6 scratch
  switch v6 by 1 0
  case 0
    then
  case 1
    v9: i64 = call @0
  v10: i64 = sub v6 1
again if v8 with v10 v7, else v11: i64, v12: f32x4 = 0 v7
return v11
";
    let program = parsed(text);
    assert_eq!(program.text_and_addresses(&Notes::NONE), (text.to_owned(), vec![ADDRESS]));
    assert_eq!((program.settled(), program.scratch, program.stack_of_called), (program, 3, 64));
}

#[test]
fn a_text_that_is_wrong_is_refused_with_its_line_and_a_remedy() {
    let refused = |text: &str| Program::parse(text, &[ADDRESS]).expect_err("it is wrong");
    let sentences = [
        refused("v0: i64 = add state argument\nv1: i64 = sum v0 v0"),
        refused("v0: i64 = add state v1"),
        refused("v0: i65 = add state 1"),
        refused("v0: i64 = add state"),
        refused("v0: i64 = add state 1 2"),
        refused("v0 i64 = add state 1"),
        refused("store i64 state 1"),
        refused("v0: i8x16 = add 0x01 0x0001"),
        refused("state: i64 = add state 1"),
        refused("loop v0: i64 = 0\n  v1: i64 = add v0 1\nreturn v1"),
        refused("  return state"),
        refused("call @1"),
        refused("scratch many"),
    ];
    let expected = [
        "line 2: `v1 : i64 = sum v0 v0` has `sum`, which is no operation: write one such as `add` or `load`",
        "line 1: `v0 : i64 = add state v1` uses `v1` before it is defined: define it above, or write a number",
        "line 1: `v0 : i65 = add state 1` has `i65` in place of a type: write one as `i64` or `i8x16`",
        "line 1: `v0 : i64 = add state` ends too early: add a value",
        "line 1: `v0 : i64 = add state 1 2` goes on with `2`, which nothing takes: remove it",
        "line 1: `v0 i64 = add state 1` is no statement: begin it with one such as `store`, or with a value as in \
         `v0: i64 =`",
        "line 1: `store i64 state 1` has `state` where `[` belongs: write `[` there",
        "line 1: `v0 : i8x16 = add 0x01 0x0001` has a constant that is no i8x16: write `0x` and 2 digits for each lane",
        "line 1: `state : i64 = add state 1` defines `state` again: give it a name of its own",
        "line 1: `loop v0 : i64 = 0` begins a loop without an end: add `once`, or `again if` and a flag, below its body",
        "line 1: `return state` does not belong here: indent what a loop, a branch or a case contains by two spaces, \
         and nothing else",
        "line 1: `call @1` has `@1`, and there are 1 addresses: write one below",
        "line 1: `scratch many` has `many` in place of a number that fits: write one",
    ];
    assert_eq!(sentences, expected);
}

#[test]
fn an_access_that_stays_in_its_allocation_is_shown_to() {
    for text in [
        LOOP,
        // A mask, a minimum, a shift, a remainder and a quotient.
        "v0: i64 = and argument 31\nv1: i64 = add @0 v0\nv2: i8 = load [v1]",
        "v0: i64 = min argument 28\nv1: i64 = add v0 @0\nv2: i32 = load [v1]",
        "v0: i64 = shr argument 59\nv1: i64 = add @0 v0\nv2: i8 = load [v1]",
        "v0: i64 = and argument 4095\nv1: i64 = mul v0 366503875926\nv2: i64 = shr v1 40\nv3: i64 = mul v2 3
v4: i64 = sub v0 v3\nv5: i64 = add @0 v4\nv6: i8 = load [v5 + 29]",
        "v0: i64 = shr argument 3\nv1: i64 = mul v0 8\nv2: i64 = sub argument v1\nv3: i64 = add @0 v2
v4: i8 = load [v3 + 24]",
        // A difference that is no remainder, because its divisor would be 0.
        "v0: i64 = shr argument 59\nv1: i64 = mul v0 0\nv2: i64 = sub v0 v1\nv3: i64 = add @0 v2\nv4: i8 = load [v3]",
        // Numbers of 4 bits; a lane of a masked vector; the last lane that exists.
        "v0: i64 = load [state + 128]\nv1: i64 = add @0 v0\nv2: i8x16 = load_unaligned [v1 + 1]",
        "v0: i8x16 = load [state]\nv1: i8x16 = and v0 0x1f\nv2: i8 = lane 3 of i8x16 v1\nv3: i64 = zero_extend i8 v2
v4: i64 = add @0 v3\nv5: i8 = load [v4]",
        // Four bytes at once.
        "v0: i32 = load [state + 160]\nv1: i32x4 = lowest i32 v0\nv2: i8x16 = cast i32x4 v1\nstore i8x16 [state + 160] v2",
        "v0: i64 = load [state + 136]\nv1: i64 = and argument 7\nv2: i64 = shl v1 3\nv3: i64 = add v0 v2
v4: i64 = load [v3]",
        "loop v0: i64 = 48\n  v1: i64 = add state v0\n  v2: i8x16 = load [v1 + 64]\n  v3: i64 = add v0 -16
again if v0 with v3",
        // The address of the next one; shifted by any amount; a product of bytes, two and two.
        "v0: i64 = load [state + 136]\nv1: i64 = add v0 8\nstore i64 [state + 136] v1",
        "v0: i8x16 = load [state]\nv1: i8x16 = and v0 0x07\nv2: i16x8 = cast i8x16 v1\nv3: i16x8 = mul v2 v2
v4: i16x8 = and v3 0x00ff\nv5: i16x8 = shr v2 8\nv6: i16x8 = and v2 0xff00\nv7: i16x8 = mul v5 v6\nv8: i16x8 = or v4 v7
v9: i8x16 = cast i16x8 v8\nstore i8x16 [state + 160] v9",
        "v0: i8x16 = and 0x3f 0x3f\nv1: i8x16 = shr v0 argument\nstore i8x16 [state + 160] v1",
        "v0: i8 = eq i64 argument 7\nv1: i64 = and argument 15\nv2: i64 = select v0 31 v1\nv3: i64 = add @0 v2
v4: i8 = load [v3]",
    ] {
        assert_eq!(said(text), "", "{text}");
    }
}

#[test]
fn an_access_that_may_be_elsewhere_is_refused() {
    for (text, sentence) in [
        ("v0: i64 = add @0 argument\nv1: i8 = load [v0]", "value 4 is an address of no allocation"),
        (
            "v0: i64 = min argument 29\nv1: i64 = add v0 @0\nv2: i32 = load [v1]",
            "value 6 leads to bytes 0 to 33 of Known(4096), and the allocation there has 0 to 32",
        ),
        ("v0: i64 = load [state + 144]", "value 0 leads to byte 144 of State, where no allocation is"),
        (
            "v0: i64 = load [state + 124]",
            "value 0 leads to bytes 124 to 132 of State, and the allocation there has 0 to 128",
        ),
        ("store i64 [scratch] 1", "value 2 leads to bytes 0 to 8 of Scratch, and the allocation there has 0 to 0"),
        ("v0: i64 = add state argument\nv1: i8 = load [v0]", "value 3 leads to byte 0 of Unit, where no allocation is"),
        ("v0: i64 = div 8 argument", "value 4 may divide by zero"),
        ("store i64 [state + 136] 1", "value 3 is no address, and it is stored in the place of one"),
        (
            "v0: i8x16 = load [state + 160]\nv1: i8x16 = add v0 v0\nstore i8x16 [state + 160] v1",
            "value 4 may be more than 63, and it is stored in the allocation of 160 to 176, whose numbers are at most that",
        ),
        ("switch argument by 0 0\ncase 0\n  then", "value 1 may be 18446744073709551615, and a switch has 2 cases"),
    ] {
        assert_eq!(said(text), sentence, "{text}");
    }
    // The loop goes too far: up, and by steps that skip the last number below the limit.
    for limit in ["97", "1000000"] {
        assert!(said(&LOOP.replace("v4 64", &format!("v4 {limit}"))).contains("of State"), "{limit}");
    }
    assert_eq!(said(&LOOP.replace("v4 64", "v4 96")), "");
}

#[test]
fn old_values_are_read_before_they_are_changed() {
    for (text, sentence) in [
        ("v0: i8 = load [state]\nstore i8 [state] v0", ""),
        ("store i8 [state] 1\nv0: i8 = load [state]", "value 4 is loaded after it was changed"),
        ("store i8 [state] 1\nv0: i8 = load [state + 1]", ""),
        ("store i8 [state] 1\nthen\nv0: i8 = load [state]", ""),
        // What is no state, and what a memory keeps.
        ("v0: i64 = load [state + 136]\nstore i64 [state + 136] v0\nv1: i64 = load [state + 136]", ""),
        ("store i8 [@0] 1\nv0: i8 = load [@0]", "value 6 is loaded after it was changed"),
        ("v0: i64 = add @0 1\nstore i8 [v0] 1\nv1: i8 = load [v0]\nstore i8 [v0] v1", ""),
        // Cases of one branch do not follow each other, but what is behind them does.
        ("if argument\n  store i8 [state] 1\nelse\n  v0: i8 = load [state]", ""),
        ("if argument\n  store i8 [state] 1\nv0: i8 = load [state]", "value 4 is loaded after it was changed"),
    ] {
        assert_eq!(said(text), sentence, "{text}");
    }
}

#[test]
fn lanes_are_read_before_another_lane_changes_them() {
    let other = "is loaded after another lane was changed";
    // The neighbour before a lane changes first, unless the loop descends.
    let ascending = |at: &str| LOOP.replace("load [v1 + 32]", &format!("load_unaligned [v1 + {at}]"));
    let descending = |at: &str| {
        let count = "  v4: i64 = add v0 -16\nagain if v0 with v4";
        let body = ascending(at).replace("v0: i64 = 0", "v0: i64 = 48");
        format!("{}{count}", body.split_once("  v4").expect("there is one").0)
    };
    assert_eq!([said(LOOP), said(&ascending("33")), said(&descending("31"))], ["", "", ""]);
    for text in [ascending("31"), descending("33")] {
        assert!(said(&text).ends_with(other), "{text}\n{}", said(&text));
    }
    // The store comes first.
    let (load, store) = ("  v2: i8x16 = load [v1 + 32] ; q\n", "  store i8x16 [v1 + 32] 0x00\n");
    assert_eq!(said(&LOOP.replace(load, &format!("{load}{store}"))), "");
    assert!(said(&LOOP.replace(load, &format!("{store}{load}"))).ends_with("is loaded after it was changed"));
    // A later loop reads it.
    let later = LOOP.replace("v0", "w0").replace("v1", "w1").replace("v2", "w2").replace("v3", "w3");
    let later = later.replace("v4", "w4").replace("v5", "w5");
    assert!(said(&format!("{LOOP}{later}")).ends_with("is loaded after it was changed"));
    assert_eq!(said(&format!("{LOOP}\nthen{later}")), "");
}

/// The nearest step that a loop can make.
#[test]
fn bytes_are_read_before_an_earlier_byte_changes_them() {
    let ascending = |at: u32| {
        said(&format!(
            "loop v0: i64 = 0\n  v1: i64 = add state v0\n  v2: i8 = load [v1 + 32]\n  store i8 [v1 + {at}] v2
  v3: i64 = add v0 1\n  v4: i8 = ult i64 v3 16\nagain if v4 with v3"
        ))
    };
    // A byte that is five ahead changes before the loop reads it; what is behind, or beyond the last, does not matter.
    assert_eq!([27, 32, 48].map(ascending), ["", "", ""]);
    for at in [33, 37, 47] {
        assert!(ascending(at).ends_with("is loaded after another lane was changed"), "{at}: {}", ascending(at));
    }
}

#[test]
fn a_minimum_of_lanes_keeps_which_lanes_they_may_be() {
    let said = |start: &str, neighbour: &str, limit: &str, next: &str| {
        said(&format!(
            "loop v0: i64 = {start}\n  v1: i64 = add v0 {neighbour}\n  v2: i64 = min v1 {limit}\n  v3: i64 = shl v2 3
  v4: i64 = add state v3\n  v5: i64 = load [v4 + 32]\n  v6: i64 = shl v0 3\n  v7: i64 = add state v6
  store i64 [v7 + 32] v5\n  {next} with v8"
        ))
    };
    let ascending = |limit: &str| said("0", "1", limit, "v8: i64 = add v0 1\n  v9: i8 = ult i64 v8 4\nagain if v9");
    let descending = |limit: &str| said("3", "-1", limit, "v8: i64 = add v0 -1\nagain if v0");
    // The last lane takes itself, or the one before, which has changed.
    assert_eq!(ascending("3"), "");
    assert!(ascending("2").ends_with("after another lane was changed"), "{}", ascending("2"));
    // The first lane takes itself, or the last one, which has changed.
    assert_eq!(descending("v0"), "");
    assert!(descending("3").ends_with("after another lane was changed"), "{}", descending("3"));
}
