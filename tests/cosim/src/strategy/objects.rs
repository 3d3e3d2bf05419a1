//! What holds state, crosses clocks, or is an instance.

use super::lanes::lane_work;
use super::*;
use tilewright_hdl::ReadUnderWrite;

pub fn object() -> impl Strategy<Value = Make> {
    prop_oneof![
        8 => register(),
        2 => chain(),
        1 => (meaning(), pick(), of(pick()), of(control()))
            .prop_map(|(meaning, of, beside, enable)| Make::Pipe { meaning, of, beside, enable }),
        1 => control().prop_map(Make::Toggle),
        2 => machine().prop_map(Make::Machine),
        3 => memory().prop_map(Make::Memory),
        1 => records().prop_map(Make::Records),
        1 => rom().prop_map(Make::Rom),
        1 => coded().prop_map(Make::Coded),
        1 => (meaning(), pattern(), of(pattern()), pick())
            .prop_map(|(meaning, initial, reset, next)| Make::PowerOn { meaning, initial, reset, next }),
        1 => in_parts().prop_map(Make::InParts),
        1 => declared().prop_map(Make::Declared),
        2 => library().prop_map(Make::Library),
        2 => lane_work().prop_map(Make::Lanes),
        2 => (crossing(), pick()).prop_map(|(by, of)| Make::Cross { by, of }),
        3 => (part_pick(), vec(pick(), 0..5)).prop_map(|(part, inputs)| Make::Instance { part, inputs }),
        4 => arrays::array(1..6),
        2 => pad().prop_map(Make::Pad),
        1 => (1..4u8, pick()).prop_map(|(times, of)| Make::Again { times, of }),
    ]
}

fn pad() -> impl Strategy<Value = Pad> {
    let drives = prop_oneof![
        1 => Just(Drives::Never),
        1 => Just(Drives::Always),
        2 => control().prop_map(Drives::Low),
        3 => control().prop_map(Drives::While),
    ];
    (width(), any::<bool>(), drives, pick()).prop_map(|(width, pull_up, drives, out)| Pad {
        width,
        pull_up,
        drives,
        out,
    })
}

/// An attribute, in a fifth.
fn attribute() -> impl Strategy<Value = bool> {
    prop_oneof![4 => Just(false), 1 => Just(true)]
}

fn register() -> impl Strategy<Value = Make> {
    let takes = prop_oneof![
        2 => pick().prop_map(|next| (Vec::new(), Some(next))),
        1 => (vec((control(), pick()), 1..4), of(pick())),
    ];
    (form(), attribute(), of(pattern()), of(control()), takes).prop_map(
        |(form, attribute, reset, enable, (updates, next))| Make::Register {
            form,
            attribute,
            reset,
            enable,
            updates,
            next,
        },
    )
}

fn chain() -> impl Strategy<Value = Make> {
    (width(), 1..5u32, any::<bool>(), of(control()), pick())
        .prop_map(|(width, length, ring, enable, from)| Make::Chain { width, length, ring, enable, from })
}

fn machine() -> impl Strategy<Value = Machine> {
    let state = || (vec((pick(), 0..4u8), 0..3), of(0..4u8)).prop_map(|(when, otherwise)| Exits { when, otherwise });
    let ask = prop_oneof![
        (0..4u8).prop_map(Ask::Leaves),
        (0..4u8).prop_map(Ask::Enters),
        (0..4u8, 0..4u8).prop_map(|(from, to)| Ask::Goes(from, to)),
    ];
    ([state(), state(), state(), state()], picks(), vec(ask, 0..4)).prop_map(|(states, chosen, asks)| Machine {
        states,
        chosen,
        asks,
    })
}

fn memory() -> impl Strategy<Value = Memory> {
    let contents = prop_oneof![
        Just(Contents::Unknown),
        pattern().prop_map(Contents::Fill),
        vec(pattern(), 1..8).prop_map(Contents::Words),
    ];
    let policy =
        prop_oneof![3 => Just(ReadUnderWrite::Old), 3 => Just(ReadUnderWrite::Any), 1 => Just(ReadUnderWrite::New)];
    let read = (any::<bool>(), of(control()), pick()).prop_map(|(asynchronous, enable, address)| Read {
        asynchronous,
        enable,
        address,
    });
    let write = || (control(), picks()).prop_map(|(enable, [address, data])| Write { enable, address, data });
    let ports = (vec(read, 1..3), prop_oneof![1 => vec(write(), 0), 4 => vec(write(), 1), 2 => vec(write(), 2)]);
    let depth = prop_oneof![2 => 1..9u32, 2 => 9..40u32, 1 => select(vec![2, 4, 8, 16, 32])];
    let width = prop_oneof![2 => width(), 1 => select(vec![1, 8, 16, 32, 48, 64, 65, 100])];
    let words = (width, meaning(), attribute(), weighted(0.25, super::width()));
    // One in three has the same address in all lanes, if the first value is the same there.
    let options = (weighted(0.3, Just(())), weighted(0.35, Just(Pick(0))));
    (depth, words, policy, contents, ports, options).prop_map(
        |(depth, (width, meaning, attribute, twin), policy, contents, (mut reads, mut writes), (crossing, common))| {
            if let Some(common) = common {
                reads.iter_mut().for_each(|read| read.address = common);
                writes.iter_mut().for_each(|write| write.address = common);
            }
            let (form, crossing) = (Form { width, meaning }, crossing.is_some());
            Memory { depth, form, attribute, policy, contents, reads, writes, crossing, twin }
        },
    )
}

fn records() -> impl Strategy<Value = Records> {
    let forms = ([form(), form(), form(), form()], 0..3u32);
    let register = (of(pattern()), weighted(0.3, pattern()), attribute());
    let updates = (vec((control(), of(pick())), 0..4), of(pick()));
    let memory = (1..20u32, vec(pattern(), 0..4), any::<bool>(), picks());
    (forms, register, updates, memory, 0..4u32).prop_map(
        |(
            (forms, list),
            (reset, initial, attribute),
            (updates, otherwise),
            (depth, contents, asynchronous, ports),
            stages,
        )| Records {
            forms,
            list,
            reset,
            initial,
            attribute,
            updates,
            otherwise,
            depth,
            contents,
            asynchronous,
            ports,
            stages,
        },
    )
}

fn rom() -> impl Strategy<Value = Rom> {
    (form(), vec([pattern(), pattern()], 1..9), pick(), any::<bool>(), picks()).prop_map(
        |(operand, words, address, asynchronous, chosen)| Rom { operand, words, address, asynchronous, chosen },
    )
}

fn coded() -> impl Strategy<Value = Coded> {
    (any::<bool>(), 0..5u8, vec((control(), 0..5u8), 1..4), picks(), any::<bool>(), pick()).prop_map(
        |(begins_with_reset, first, updates, chosen, records, raw)| Coded {
            begins_with_reset,
            first,
            updates,
            chosen,
            records,
            raw,
        },
    )
}

fn in_parts() -> impl Strategy<Value = InParts> {
    let form =
        (prop_oneof![1 => Just(8), 1 => 1..20u32], meaning()).prop_map(|(width, meaning)| Form { width, meaning });
    (1..5u32, form, 1..20u32, any::<bool>(), picks()).prop_map(|(parts, form, depth, asynchronous, ports)| InParts {
        parts,
        form,
        depth,
        asynchronous,
        ports,
    })
}

fn declared() -> impl Strategy<Value = Declared> {
    let lanes = prop_oneof![Just(0), 1..6u32];
    ([width(), width()], meaning(), 1..4u32, lanes, any::<u64>(), picks()).prop_map(
        |(widths, meaning, list, lanes, numbers, picks)| Declared { widths, meaning, list, lanes, numbers, picks },
    )
}

fn library() -> impl Strategy<Value = Library> {
    use LibraryBlock::{Counter, Crc, Encoders, Lfsr, Multiplier, ShiftRegister, Shifter};
    let block = select(vec![Counter, ShiftRegister, Lfsr, Encoders, Shifter, Multiplier, Crc]);
    (block, 1..40u32, picks()).prop_map(|(block, width, picks)| Library { block, width, picks })
}

fn crossing() -> impl Strategy<Value = Crossing> {
    prop_oneof![
        2 => Just(Crossing::QuasiStatic),
        1 => Just(Crossing::Synchronize),
        1 => any::<bool>().prop_map(Crossing::SynchronizeFrom),
    ]
}
