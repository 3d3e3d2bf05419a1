//! Edits that break nothing, and edits of names, of paths through the design and of its size.

use crate::validate::common::*;
use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design, Period};

#[test]
fn what_was_not_edited_is_a_design_again() {
    assert_eq!(problems(|_| ()), Vec::<String>::new());
    assert_eq!(design().modules().len(), 2);
}

#[test]
fn edits_that_keep_the_rules_are_a_design() {
    let harmless = |it: &mut Edit| {
        let b = it.id("b");
        it.op("add", |op| *op = Op::Wire(b));
        it.top().properties.clear();
        it.top().registers[0].reset = None;
    };
    assert_eq!(problems(harmless), Vec::<String>::new());
}

#[test]
fn a_problem_names_place_and_remedy() {
    let mut modules = design().into_modules();
    let index = modules[1].nodes.iter().position(|node| node.name.as_deref() == Some("part")).unwrap();
    modules[1].nodes[index].op = Op::Slice { of: NodeId(0), low: 6 };
    let text = Design::new(modules).unwrap_err().to_string();
    let (sentence, rest) = text.split_once('\n').unwrap();
    assert_eq!(sentence, "`top.part` is the slice 6..9 of 8 bits [T902]");
    assert!(
        rest.starts_with("  --> hdl/tests/validate/common.rs:") && rest.contains("  help: this circuit was edited"),
        "{rest}"
    );
}

#[test]
fn every_problem_of_every_module_is_reported() {
    let found = problems(|it| {
        it.stage().registers[0].reset = Some(Init::Same(Bits::new(7, 0)));
        it.node("part").width = 4;
    });
    assert_eq!(
        found,
        [
            "the reset value of `stage.q` has 7 bits, not 8",
            "`top.twice` has 6 bits, but its repetition has 8",
            "the address of read port 0 of `top.words`, `top.part`, has 4 bits, not 3 bits",
            "the address of read port 1 of `top.words`, `top.part`, has 4 bits, not 3 bits",
            "the address of write port 0 of `top.words`, `top.part`, has 4 bits, not 3 bits",
        ]
    );
}

#[test]
fn names() {
    let illegal = "`top.a b` has a name that is not legal";
    refused(illegal, |it| it.node("add").name = Some("a b".to_owned()));
    refused(illegal, |it| it.top().memories[0].name = "a b".to_owned());
    refused(illegal, |it| it.top().instances[0].name = "a b".to_owned());
    refused(illegal, |it| it.top().outputs[0].name = "a b".to_owned());
    refused("`top.wire` has a name that is not legal", |it| it.node("add").name = Some("wire".to_owned()));
    let twice = "`top.less` is the name of two things";
    refused(twice, |it| it.node("add").name = Some("less".to_owned()));
    refused(twice, |it| it.top().memories[0].name = "less".to_owned());
    refused(twice, |it| it.top().instances[0].name = "less".to_owned());
    refused("`top.clk` is the name of two things", |it| it.node("add").name = Some("clk".to_owned()));
    refused("`top.sum` is the name of two things", |it| it.node("less").name = Some("sum".to_owned()));
    refused("two modules are called `top`", |it| it.stage().name = "top".to_owned());
    refused("`module` cannot be the name of a module", |it| it.stage().name = "module".to_owned());
}

/// Lane 0 is the first input, and lane 1 is lane 0: no lane depends on itself.
#[test]
fn a_row_that_is_made_of_its_own_lanes() {
    let chain = |it: &mut Edit, index: u32| {
        let (add, a) = (it.id("add"), it.first(|op| matches!(op, Op::Input(0))).clone());
        it.node("add").shape = Shape::Row(2);
        let lane = it.id("lane_two");
        it.op("lane_two", |op| *op = Op::Lane { of: add, axis: 0, index });
        let input = NodeId(it.top().nodes.iter().position(|node| node.op == a.op).unwrap() as u32);
        it.op("add", |op| *op = Op::Stack { parts: vec![input, lane], axis: 0 });
        it.top().outputs[0].node = input;
        it.top().memories[0].writes[0].data = input;
    };
    assert_eq!(problems(|it| chain(it, 0)), Vec::<String>::new());
    refused("a combinational loop in `top`: `add[1]` -> `lane_two` -> `add[1]`", |it| chain(it, 1));
}

#[test]
fn loops() {
    refused("a combinational loop in `top`: `add` -> `add`", |it| {
        let add = it.id("add");
        it.op("add", |op| *op = Op::Wire(add));
    });
    let text = problems(|it| {
        let out = it.top().instances[0].outputs[0];
        it.op("chosen", |op| *op = Op::Wire(out));
    });
    assert!(text[0].starts_with("a combinational loop in `top`: `chosen` -> `node "), "{text:?}");
    let by_register = |it: &mut Edit| {
        let out = it.top().instances[0].outputs[1];
        it.op("chosen", |op| *op = Op::Wire(out));
    };
    assert_eq!(problems(by_register), Vec::<String>::new());
}

#[test]
fn sizes() {
    let arrays = |it: &mut Edit, levels: usize, lanes: u32| {
        let (cell, top) = (it.modules[0].clone(), it.modules[1].clone());
        it.modules = vec![cell.clone()];
        for level in 0..levels {
            let mut module = cell.clone();
            module.name = format!("level_{level}");
            module.registers.clear();
            module.clocks[0].period = Some(Period::ns(10));
            module.nodes.truncate(2);
            let list = |of: NodeId, width, loc| Node::new(Op::Broadcast { of, axis: 0 }, width, Shape::Row(lanes), loc);
            for port in 0..2 {
                let node = &module.nodes[port];
                let driver = list(NodeId(port as u32), node.width, node.loc);
                module.nodes.push(driver);
            }
            for port in 0..2 {
                let output = Node { op: Op::Output(InstanceId(0), port), ..list(NodeId(0), 8, module.loc) };
                module.nodes.push(output);
            }
            for port in 0..2u32 {
                let output = Node {
                    op: Op::Lane { of: NodeId(4 + port), axis: 0, index: 0 },
                    shape: Shape::Plain,
                    ..list(NodeId(0), 8, module.loc)
                };
                module.nodes.push(output);
                module.outputs[port as usize].node = NodeId(6 + port);
            }
            let array = Instance {
                name: "u_inner".to_owned(),
                module: ModuleId(level as u32),
                shape: Shape::Row(lanes),
                inputs: vec![NodeId(2), NodeId(3)],
                outputs: vec![NodeId(4), NodeId(5)],
                clocks: vec![ClockId(0)],
                loc: top.loc,
            };
            module.instances = vec![array];
            it.modules.push(module);
        }
    };
    assert_eq!(problems(|it| arrays(it, 5, 16)), Vec::<String>::new());
    refused("`level_1` has too many lanes: 17179869184, more than 16777216", |it| arrays(it, 2, 1 << 17));
    refused("`level_99` has instances nested too deep: 101, more than 100", |it| arrays(it, 101, 1));
    refused("`level_4` has a value of too many 64-bit words in all lanes: 134217728, more than 67108864", |it| {
        let constant = Node { op: Op::Const(Bits::zero(8192)), width: 8192, name: None, ..it.stage().nodes[0].clone() };
        it.stage().nodes.push(constant);
        arrays(it, 5, 16);
    });
    refused("`level_4` has a memory of too many 64-bit words in all lanes: 8589934592, more than 4294967296", |it| {
        let memory = Memory {
            depth: 8192,
            contents: Contents::Unknown,
            shape: Shape::Plain,
            reads: vec![],
            writes: vec![],
            ..it.top().memories[0].clone()
        };
        it.stage().memories.push(memory);
        arrays(it, 5, 16);
    });
}
