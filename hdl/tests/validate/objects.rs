//! Edits of registers, memories, properties, ports and instances.

use crate::validate::common::*;
use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design, Period, ReadUnderWrite, Reset};

#[test]
fn registers() {
    let phase = |it: &mut Edit, change: fn(&mut Register)| change(&mut it.top().registers[0]);
    refused("`top.phase` is register 0, whose node is node 0", |it| phase(it, |r| r.node = NodeId(0)));
    refused("the clock of `top.phase` is clock 2 of 2", |it| phase(it, |r| r.clock = ClockId(2)));
    refused("the next value of `top.phase`, `top.c`, has 1 bit, not 2 bits", |it| phase(it, |r| r.next = NodeId(2)));
    refused("the enable of `top.phase`, `top.a`, has 8 bits, not 1 bit", |it| {
        phase(it, |r| r.enable = Some(NodeId(0)))
    });
    refused("the reset value of `top.phase` has 3 bits, not 2", |it| {
        phase(it, |r| r.reset = Some(Init::Same(Bits::new(3, 0))))
    });
    refused("`top.phase` has a reset value, but its clock has no reset port", |it| phase(it, |r| r.clock = ClockId(1)));
    let named = |it: &mut Edit, codes, values| {
        let node = it.top().registers[0].node.0 as usize;
        it.top().nodes[node].kind = Kind::Code(Names { of: "Phase", codes, values });
    };
    refused("`Phase` has codes of 3 bits, which do not fit into 2", |it| named(it, &["A", "B"], &[0, 4]));
    refused("`Phase` has 0 codes with 0 numbers, not one for each", |it| named(it, &[], &[]));
    refused("`Phase` has 2 codes with 1 numbers, not one for each", |it| named(it, &["A", "B"], &[0]));
    refused("`Phase` has two codes whose number is 2", |it| named(it, &["A", "B", "C"], &[2, 0, 2]));
    refused("`Phase` has a code whose name is not legal: `a b`", |it| named(it, &["a b"], &[0]));
    refused("`Phase` has a code whose name is not legal: ``", |it| named(it, &["A", ""], &[0, 1]));
    refused("`top.phase` has the attribute `no name`, which is not a plain name", |it| {
        let attribute = Attribute { name: "no name".to_owned(), value: "1".to_owned() };
        it.top().registers[0].attributes.push(attribute);
    });
    refused("`top.register 0` has node 0, which is something else", |it| {
        let (node, input) = (it.top().registers[0].node.0 as usize, NodeId(0));
        it.top().registers[0].node = input;
        it.top().nodes[node].op = Op::Const(Bits::zero(2));
    });
    refused("`top.node 17` is a register without a name", |it| {
        let node = it.top().registers[0].node.0 as usize;
        it.top().nodes[node].name = None;
    });
}

#[test]
fn memories() {
    let memory = |it: &mut Edit, change: fn(&mut Memory)| change(&mut it.top().memories[0]);
    refused("memory `top.words` has the attribute `begin`, which is not a plain name", |it| {
        memory(it, |m| m.attributes.push(Attribute { name: "begin".to_owned(), value: "1".to_owned() }));
    });
    refused("memory `top.words` has no words", |it| memory(it, |m| m.depth = 0));
    refused("memory `top.words` has words of 0 bits, not 1 to 1048576", |it| memory(it, |m| m.width = 0));
    refused("memory `top.words` has 5 words, but contents of 6", |it| {
        memory(it, |m| m.contents = Contents::Words(vec![Bits::zero(8); 6]));
    });
    let contents = "the contents of memory `top.words` are not as wide as a word, which has 8 bits";
    refused(contents, |it| memory(it, |m| m.contents = Contents::Fill(Bits::zero(9))));
    refused(contents, |it| memory(it, |m| m.contents = Contents::Words(vec![Bits::zero(8), Bits::zero(7)])));
    refused("the address of read port 0 of `top.words`, `top.part`, has 3 bits, not 7 bits", |it| {
        memory(it, |m| m.depth = 65);
    });
    refused("the address of write port 0 of `top.words`, `top.a`, has 8 bits, not 3 bits", |it| {
        memory(it, |m| m.writes[0].address = NodeId(0));
    });
    refused("the data of write port 0 of `top.words`, `top.c`, has 1 bit, not 8 bits", |it| {
        memory(it, |m| m.writes[0].data = NodeId(2));
    });
    refused("the enable of write port 0 of `top.words`, `top.a`, has 8 bits, not 1 bit", |it| {
        memory(it, |m| m.writes[0].enable = NodeId(0));
    });
    refused("the clock of write port 0 of `top.words` is clock 5 of 2", |it| {
        memory(it, |m| m.writes[0].clock = ClockId(5))
    });
    refused("the clock of read port 0 of `top.words` is clock 5 of 2", |it| {
        memory(it, |m| m.reads[0].clock = Some(ClockId(5)))
    });
    let new =
        "read port 0 of `top.words` is synchronous, but gives the word that is written: that is a register beside it";
    refused(new, |it| memory(it, |m| m.policy = ReadUnderWrite::New));
    refused("read port 0 of `top.words` is asynchronous but has an enable", |it| {
        memory(it, |m| m.reads[0].clock = None)
    });
    refused("the enable of read port 0 of `top.words`, `top.a`, has 8 bits, not 1 bit", |it| {
        memory(it, |m| m.reads[0].enable = Some(NodeId(0)));
    });
    refused("the data of read port 1 of `top.words`, `top.found_now`, has 9 bits, not 8 bits", |it| {
        it.node("found_now").width = 9;
    });
    refused("read port 2 of `top.words` has node 2, which is something else", |it| {
        memory(it, |m| {
            let port = ReadPort { node: NodeId(2), ..m.reads[1].clone() };
            m.reads.push(port);
        });
    });
}

#[test]
fn clocks_ports_and_assertions() {
    refused("clock `clk` of the top, `top`, has no period", |it| it.top().clocks[0].period = None);
    refused("`top.fast_clk` is a clock with a name, but has no period", |it| it.top().clocks[1].period = None);
    refused("`top.fast_clk` is a default clock, but not the first clock of its module", |it| {
        it.top().clocks[1].name = None
    });
    refused("the clock of `top.a` is clock 2 of 2", |it| it.top().inputs[0].clock = Some(ClockId(2)));
    refused("`top.a` is input 0, whose node is node 1", |it| it.top().inputs[0].node = NodeId(1));
    refused("the node of input `top.aa` has another name", |it| it.top().inputs[0].name = "aa".to_owned());
    refused("the driver of `top.sum` is node 70000 of 53", |it| it.top().outputs[0].node = NodeId(70_000));
    refused("the clock of a property of `top` is clock 2 of 2", |it| it.top().properties[0].clock = ClockId(2));
    refused("the condition of a property of `top`, `top.a`, has 8 bits, not 1 bit", |it| {
        it.top().properties[0].condition = NodeId(0);
    });
    refused("the text of a property of `top` does not show its values", |it| {
        it.top().properties[0].values.push(Shown { node: NodeId(0), kind: Kind::Number });
    });
    refused("a value of a property of `top` is node 900 of 53", |it| {
        let property = &mut it.top().properties[0];
        (property.directive, property.message) = (Directive::Display, "{}".to_owned());
        property.values.push(Shown { node: NodeId(900), kind: Kind::Number });
    });
}

#[test]
fn instances() {
    let one = |it: &mut Edit, change: fn(&mut Instance)| change(&mut it.top().instances[0]);
    refused("`top.u_one` is an instance of module 1, but only 1 come before", |it| one(it, |i| i.module = ModuleId(1)));
    refused("`top.u_one` has 1 inputs, but its module `stage` has 2", |it| {
        one(it, |i| i.inputs.truncate(1));
    });
    refused("`top.u_one` has 3 outputs, but its module `stage` has 2", |it| one(it, |i| i.outputs.push(NodeId(0))));
    refused("`top.u_one` has 0 clocks, but its module `stage` has 1", |it| one(it, |i| i.clocks.clear()));
    refused("input `a` of `top.u_one`, `top.c`, has 1 bit, not 8 bits", |it| one(it, |i| i.inputs[0] = NodeId(2)));
    refused("input `a` of `top.u_one`, `top.chosen`, has no lanes, not 3 lanes", |it| {
        one(it, |i| i.shape = Shape::Row(3))
    });
    refused("`top.u_one` is an array without lanes", |it| one(it, |i| i.shape = Shape::Row(0)));
    refused("the clock of `top.u_one` is clock 9 of 2", |it| one(it, |i| i.clocks[0] = ClockId(9)));
    refused("clock `clk` of `top.u_one` has a reset, but `fast_clk`, which drives it, has none", |it| {
        one(it, |i| i.clocks[0] = ClockId(1));
    });
    refused(
        "clock `clk` of `top.u_one` has an asynchronous reset, but `clk`, which drives it, has a synchronous reset",
        |it| it.stage().clocks[0].kind = Reset::Asynchronous,
    );
    refused("`stage.clk` is a clock without a reset, but has a reset port", |it| {
        it.stage().clocks[0].kind = Reset::PowerOn;
    });
    refused("clock `clk` of `top.u_one` is driven by `clk`, which has another period", |it| {
        it.stage().clocks[0].name = Some("slow");
        it.stage().clocks[0].period = Some(Period::ns(12));
    });
    let found = problems(|it| {
        let node = it.top().instances[0].outputs[0].0 as usize;
        it.top().nodes[node].width = 9;
    });
    assert_eq!(found.last().unwrap(), "output `at_once` of `top.u_one`, `top.node 32`, has 9 bits, not 8 bits");
    refused("`top.u_one` is an instance of module 0, but only 0 come before", |it| it.modules.reverse());
    assert_eq!(Design::new(Vec::new()).unwrap_err().0[0].message, "a design has at least one module, its top");
}
