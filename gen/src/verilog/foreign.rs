//! Instances of foreign modules: of the module itself, with its parameters, or of its model.

use super::layout::{connect, with_place};
use super::literal::{Style, literal};
use super::text::{attribute, escaped, mark};
use tilewright_circuit::Loc;
use tilewright_circuit::ir::{Foreign, Module, Parameter};

/// The option with which simulators and linters take the models of foreign modules.
///
/// ```
/// assert_eq!(tilewright_gen::tools::WITH_MODELS, "-DTILEWRIGHT_MODELS");
/// ```
pub const WITH_MODELS: &str = "-DTILEWRIGHT_MODELS";

/// With this macro, models stand for foreign modules.
pub const MODELS: &str = WITH_MODELS.split_at(2).1;

/// The connections of an instance: those of both the module and its model, and those of the module alone.
type Connections<'a> = (&'a [(String, String)], Vec<(String, String)>);

/// An instance of `child`, with its place in the description. A foreign module and its model share the ports, but
/// those that only one of them has.
pub fn instantiate(child: &Module, name: &str, (connections, made): Connections, loc: Option<Loc>) -> Vec<String> {
    let placed = |line: String| loc.map_or(line.clone(), |loc| with_place(line, loc));
    let mut plain = connect(&child.name, name, connections).into_iter();
    let Some(foreign) = &child.foreign else {
        let first = plain.next().map(placed);
        return first.into_iter().chain(plain).collect();
    };
    let mut head = head(foreign, name);
    head[0] = placed(std::mem::take(&mut head[0]));
    let own: Vec<&str> = own_ports(child, foreign);
    let (of_model, shared): (Vec<_>, Vec<_>) =
        connections.iter().cloned().partition(|(port, _)| own.contains(&port.as_str()));
    // Those of one alone come first, so that each has a comma.
    let count = of_model.len();
    let all = connect(&child.name, name, &[of_model, made, shared.clone()].concat());
    let end = all.len().saturating_sub(1 + shared.len()).max(1);
    let (of_model, made) = all[1..end].split_at(count);
    let mut out = vec![format!("`ifdef {MODELS}")];
    if shared.is_empty() {
        out.extend(plain);
        out.push("`else".to_string());
        out.extend(head);
        out.extend(made.iter().map(|line| line.trim_end_matches(',').to_string()));
        out.extend([");", "`endif"].map(str::to_string));
        return out;
    }
    out.push(all[0].clone());
    out.extend(of_model.iter().cloned());
    out.push("`else".to_string());
    out.extend(head);
    out.extend(made.iter().cloned());
    out.push("`endif".to_string());
    out.extend(all[end..].iter().cloned());
    out
}

/// The ports that the model has and the module has not: clocks and resets for its assertions.
fn own_ports<'a>(child: &'a Module, foreign: &Foreign) -> Vec<&'a str> {
    let given = |ports: &[(_, String)], name: &str| ports.iter().any(|(_, port)| port == name);
    let clocks = child.clocks.iter().map(|clock| clock.port.as_str()).filter(|name| !given(&foreign.clocks, name));
    let resets = child.clocks.iter().filter_map(|clock| clock.reset.as_deref());
    clocks.chain(resets.filter(|name| !given(&foreign.resets, name))).collect()
}

/// The lines before the connections: the attributes, the module, its parameters and the name of the instance.
fn head(foreign: &Foreign, name: &str) -> Vec<String> {
    let mark = mark(foreign.attributes.iter().map(attribute).collect());
    if foreign.parameters.is_empty() {
        return vec![format!("{mark}{} {name} (", foreign.module)];
    }
    let longest = foreign.parameters.iter().map(|(parameter, _)| parameter.len()).max().unwrap_or(0);
    let mut out = vec![format!("{mark}{} #(", foreign.module)];
    for (i, (parameter, given)) in foreign.parameters.iter().enumerate() {
        let comma = if i + 1 < foreign.parameters.len() { "," } else { "" };
        out.push(format!("    .{parameter:longest$} ({}){comma}", value(given)));
    }
    out.push(format!(") {name} ("));
    out
}

fn value(parameter: &Parameter) -> String {
    match parameter {
        Parameter::Integer(number) if i32::try_from(*number).is_ok() => number.to_string(),
        // Unsized, it might be cut to 32 bits.
        Parameter::Integer(number) if *number < 0 => format!("-64'sd{}", number.unsigned_abs()),
        Parameter::Integer(number) => format!("64'd{number}"),
        Parameter::Bits(bits) => literal(bits, Style::Pattern),
        // With a point or an exponent.
        Parameter::Real(number) => format!("{number:?}"),
        Parameter::Text(text) => format!("\"{}\"", escaped(text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_circuit::Bits;

    #[test]
    fn values_of_parameters() {
        let values: [Parameter; 7] = [
            7u32.into(),
            (-7).into(),
            5_000_000_000i64.into(),
            u32::MAX.into(),
            10.0.into(),
            "say \"no\"".into(),
            Bits::new(7, 63).into(),
        ];
        let texts = ["7", "-7", "64'd5000000000", "64'd4294967295", "10.0", "\"say \\\"no\\\"\"", "7'h3f"];
        assert_eq!(values.each_ref().map(value), texts);
        assert_eq!(value(&Parameter::Integer(i64::MIN)), "-64'sd9223372036854775808");
    }
}
