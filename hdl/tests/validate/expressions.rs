//! Edits of expressions.

use crate::validate::common::*;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::*;

#[test]
fn widths() {
    refused("`top.any` has 0 bits, not 1 to 1048576", |it| it.node("any").width = 0);
    refused("`top.add` has 1048577 bits, not 1 to 1048576", |it| it.node("add").width = (1 << 20) + 1);
    refused("the operand of `top.both`, `top.a`, has 8 bits, not 9 bits", |it| {
        it.op("both", |op| *op = Op::Unary(Unary::Not, NodeId(0)));
    });
}

#[test]
fn ids_lead_somewhere() {
    refused("an operand of `top.add` is node 4000000000 of 53", |it| {
        it.op("add", |op| *op = Op::Binary(Binary::Add, NodeId(0), NodeId(4_000_000_000)));
    });
    refused("`top.add` is input 3, which does not exist", |it| it.op("add", |op| *op = Op::Input(3)));
    refused("`top.add` is input 1, whose node is node 1", |it| it.op("add", |op| *op = Op::Input(1)));
    refused("`top.add` is register 9, which does not exist", |it| it.op("add", |op| *op = Op::Register(RegisterId(9))));
    refused("`top.add` is read port 2 of memory 0, which does not exist", |it| {
        it.op("add", |op| *op = Op::Read(MemoryId(0), 2));
    });
    refused("`top.add` is read port 0 of memory 1, which does not exist", |it| {
        it.op("add", |op| *op = Op::Read(MemoryId(1), 0));
    });
    refused("`top.add` is output 2 of instance 0, which does not exist", |it| {
        it.op("add", |op| *op = Op::Output(InstanceId(0), 2));
    });
    refused("`top.add` is output 0 of instance 7, which does not exist", |it| {
        it.op("add", |op| *op = Op::Output(InstanceId(7), 0));
    });
}

#[test]
fn operators() {
    refused("`top.slow` has 1 bit, but its constant has 3", |it| {
        it.op("slow", |op| *op = Op::Const(Bits::new(3, 0)));
    });
    refused("`top.any` has 2 bits, but its operator gives 1", |it| it.node("any").width = 2);
    refused("an operand of `top.add`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("add", |op| *op = Op::Binary(Binary::Add, NodeId(0), NodeId(2)));
    });
    refused("`top.product` has 16 bits, but its product has 9", |it| {
        it.op("product", |op| *op = Op::Binary(Binary::MulSigned, NodeId(0), NodeId(2)));
    });
    refused("the right operand of `top.less`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("less", |op| {
            *op = Op::Compare { relation: Relation::Lt, signed: true, operands: [NodeId(0), NodeId(2)] }
        });
    });
    refused("`top.add` has 8 bits, but its comparison gives 1", |it| {
        it.op("add", |op| *op = Op::Compare { relation: Relation::Lt, signed: true, operands: [NodeId(0), NodeId(1)] });
    });
    refused("the operand of `top.shifted`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("shifted", |op| *op = Op::Shift(Shift::Left, NodeId(2), NodeId(0)));
    });
    refused("the driver of `top.add`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("add", |op| *op = Op::Wire(NodeId(2)))
    });
    refused("the driver of `top.add`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("add", |op| *op = Op::QuasiStatic(NodeId(2), String::new()));
    });
}

#[test]
fn choices() {
    refused("the select of `top.chosen`, `top.a`, has 8 bits, not 1 bit", |it| {
        it.op("chosen", |op| *op = Op::Mux { select: NodeId(0), on_true: NodeId(0), on_false: NodeId(1) });
    });
    refused("a value of `top.chosen`, `top.c`, has 1 bit, not 8 bits", |it| {
        it.op("chosen", |op| *op = Op::Mux { select: NodeId(2), on_true: NodeId(0), on_false: NodeId(2) });
    });
    let select = |it: &mut Edit, arm, default| {
        it.op("first", |op| *op = Op::Select { arms: vec![arm], default });
    };
    refused("a condition of `top.first`, `top.a`, has 8 bits, not 1 bit", |it| {
        select(it, (NodeId(0), NodeId(0)), NodeId(0))
    });
    refused("a value of `top.first`, `top.c`, has 1 bit, not 8 bits", |it| {
        select(it, (NodeId(2), NodeId(2)), NodeId(0))
    });
    refused("the default of `top.first`, `top.c`, has 1 bit, not 8 bits", |it| {
        select(it, (NodeId(2), NodeId(0)), NodeId(2))
    });
    let case = |it: &mut Edit, keys: &[Bits], value, default| {
        let arms = keys.iter().map(|key| (key.clone(), value)).collect();
        it.op("keyed", |op| *op = Op::Case { subject: NodeId(0), arms, default });
    };
    refused("the key 9'h100 of `top.keyed` is not as wide as its subject, which has 8 bits", |it| {
        case(it, &[Bits::new(9, 256)], NodeId(0), NodeId(0));
    });
    refused("the key 8'h05 of `top.keyed` occurs twice", |it| {
        case(it, &[Bits::new(8, 5), Bits::new(8, 5)], NodeId(0), NodeId(0));
    });
    refused("a value of `top.keyed`, `top.c`, has 1 bit, not 8 bits", |it| {
        case(it, &[Bits::new(8, 5)], NodeId(2), NodeId(0));
    });
    refused("the default of `top.keyed`, `top.c`, has 1 bit, not 8 bits", |it| case(it, &[], NodeId(0), NodeId(2)));
}

#[test]
fn wiring() {
    refused("`top.part` is the slice 4294967295..4294967298 of 8 bits", |it| {
        it.op("part", |op| *op = Op::Slice { of: NodeId(0), low: u32::MAX });
    });
    refused("`top.both` has 9 bits, but its parts have 16", |it| {
        it.op("both", |op| *op = Op::Concat(vec![NodeId(0), NodeId(1)]));
    });
    refused("`top.both` has 9 bits, but its parts have 0", |it| it.op("both", |op| *op = Op::Concat(vec![])));
    refused("`top.twice` has 6 bits, but its repetition has 34359738360", |it| {
        it.op("twice", |op| *op = Op::Repeat(NodeId(0), u32::MAX));
    });
    refused("`top.wide` extends 8 bits to 8", |it| {
        it.op("wide", |op| *op = Op::Extend { of: NodeId(0), signed: true })
    });
}

#[test]
fn lanes() {
    refused("an operand of `top.add`, `top.a`, has no lanes, not 4 lanes", |it| {
        it.node("add").shape = Shape::Row(4);
    });
    refused("`top.lane_two` is lane 1000000 of 4", |it| {
        it.op("lane_two", |op| {
            let Op::Lane { index, .. } = op else { panic!("{op:?}") };
            *index = 1_000_000;
        });
    });
    refused("`top.lane_two` goes along axis 0 of `top.a`, which has no lanes", |it| {
        it.op("lane_two", |op| *op = Op::Lane { of: NodeId(0), axis: 0, index: 0 });
    });
    refused("`top.total` goes along axis 0 of `top.a`, which has no lanes", |it| {
        it.op("total", |op| *op = Op::Reduce { by: Reduction::Add, of: NodeId(0), axis: 0 });
    });
    let named = |it: &mut Edit, is: fn(&Op) -> bool| it.first(is).name = Some("lanes".to_owned());
    let is_list: fn(&Op) -> bool = |op| matches!(op, Op::Stack { .. });
    let is_shifted: fn(&Op) -> bool = |op| matches!(op, Op::Map { .. });
    let is_broadcast: fn(&Op) -> bool = |op| matches!(op, Op::Broadcast { .. });
    refused("`top.lanes` is laid out along axis 0, but has no lanes", |it| {
        named(it, is_broadcast);
        it.node("lanes").shape = Shape::Plain;
    });
    refused("`top.lanes` needs at least 1 lane", |it| {
        named(it, is_list);
        it.node("lanes").shape = Shape::Row(0);
    });
    refused("`top.lanes` lists 2 signals for 5 lanes", |it| {
        named(it, is_list);
        it.node("lanes").shape = Shape::Row(5);
    });
    refused("a lane of `top.lanes`, `top.c`, has 1 bit, not 8 bits", |it| {
        named(it, is_list);
        it.op("lanes", |op| *op = Op::Stack { parts: vec![NodeId(0), NodeId(2)], axis: 0 });
    });
    refused("the operand of `top.lanes`, `top.a`, has no lanes, not 4 lanes", |it| {
        named(it, is_shifted);
        it.op("lanes", |op| *op = Op::Map { of: NodeId(0), axis: 0, index: Affine::shift(1), edge: Some(NodeId(0)) });
    });
    refused("the edge of `top.lanes`, `top.c`, has 1 bit, not 8 bits", |it| {
        named(it, is_shifted);
        it.op("lanes", |op| {
            let Op::Map { edge, .. } = op else { panic!("{op:?}") };
            *edge = Some(NodeId(2));
        });
    });
    refused("the operand of `top.add`, `top.lanes`, has 4 lanes, but must be plain", |it| {
        named(it, is_shifted);
        let lanes = it.id("lanes");
        it.op("add", |op| *op = Op::Unary(Unary::Not, lanes));
    });
}
