//! A circuit of and-gates and inverters, as Yosys writes it in the binary AIGER format.
//!
//! A literal is twice a variable's number, plus one if it is inverted. Variable 0 is false. Then come the inputs, the
//! latches, and the gates.

use std::collections::BTreeMap;

/// The circuit.
pub struct Circuit {
    inputs: usize,
    /// What each latch takes in.
    latches: Vec<u32>,
    /// Where each latch starts: at zero, as it is read.
    start: Vec<bool>,
    outputs: Vec<u32>,
    /// The assumptions of the design.
    constraints: Vec<u32>,
    gates: Vec<[u32; 2]>,
    /// The bits of each port, the lowest first: indices of inputs or of outputs.
    ports: BTreeMap<String, Vec<usize>>,
}

/// The runs of random inputs, the clocks of each, and how often inputs are chosen that the assumptions do not allow.
const GUESSES: usize = 4;
const GUESSED: usize = 300;
const TRIES: usize = 20;
/// The most gates that are computed in one of these runs, so that a large circuit costs little time.
const GUESSED_GATES: usize = 20_000_000;

/// A random bit.
fn xorshift(random: &mut u64) -> bool {
    *random ^= *random << 13;
    *random ^= *random >> 7;
    *random ^= *random << 17;
    *random >> 40 & 1 == 1
}

/// The values of all variables in a clock, and the next ones of the latches.
pub struct State {
    values: Vec<bool>,
}

impl Circuit {
    /// Reads a circuit; `None` if it is none.
    pub fn read(bytes: &[u8]) -> Option<Circuit> {
        let mut lines = Lines { bytes, at: 0 };
        let header: Vec<usize> =
            lines.next()?.strip_prefix("aig ")?.split(' ').map(|it| it.parse().ok()).collect::<Option<_>>()?;
        let count = |index: usize| header.get(index).copied().unwrap_or(0);
        let [inputs, latches, outputs, gates] = [1, 2, 3, 4].map(count);
        let literals =
            |count: usize, lines: &mut Lines| (0..count).map(|_| lines.literal()).collect::<Option<Vec<u32>>>();
        let latches = literals(latches, &mut lines)?;
        let outputs = literals(outputs, &mut lines)?;
        let _bad = literals(count(5), &mut lines)?;
        let constraints = literals(count(6), &mut lines)?;
        let gates = gates_from(1 + inputs + latches.len(), gates, &mut lines)?;
        let mut ports: BTreeMap<String, BTreeMap<usize, usize>> = BTreeMap::new();
        while let Some(line) = lines.next().filter(|line| *line != "c") {
            let (place, names) = line.split_once(' ')?;
            let Some(index) = place.strip_prefix(['i', 'o']) else { continue };
            let index = index.parse().ok()?;
            // A bit of several ports has all their names.
            for (port, bit) in names.split(' ').filter_map(bit_of) {
                ports.entry(port.to_owned()).or_default().insert(bit, index);
            }
        }
        let ports = ports.into_iter().map(|(name, bits)| (name, bits.into_values().collect())).collect();
        let start = vec![false; latches.len()];
        Some(Circuit { inputs, latches, start, outputs, constraints, gates, ports })
    }

    /// The circuit, which starts in the state that follows this one.
    pub fn after(self, state: &State) -> Circuit {
        let start = self.latches.iter().map(|next| state.literal(*next)).collect();
        Circuit { start, ..self }
    }

    /// The circuit in the same format: an output that is never to be high, and outputs that are assumed to be, besides
    /// the constraints. All latches start at zero there: those that do not are inverted.
    pub fn question(&self, bad: &str, assumed: &[&str]) -> Vec<u8> {
        let first = 1 + self.inputs;
        let is_inverted =
            |variable: usize| variable.checked_sub(first).and_then(|latch| self.start.get(latch)) == Some(&true);
        let literal = |literal: u32| literal ^ u32::from(is_inverted((literal / 2) as usize));
        let output = |name: &str| self.port(name).first().map_or(0, |index| self.outputs[*index]);
        let constraints = self.constraints.iter().copied().chain(assumed.iter().map(|name| output(name)));
        let constraints: Vec<u32> = constraints.collect();
        let (inputs, latches, gates) = (self.inputs, self.latches.len(), self.gates.len());
        let all = inputs + latches + gates;
        let mut text = format!("aig {all} {inputs} {latches} 0 {gates} 1 {}\n", constraints.len());
        for (next, starts) in self.latches.iter().zip(&self.start) {
            text += &format!("{}\n", literal(*next) ^ u32::from(*starts));
        }
        for other in [output(bad)].iter().chain(&constraints) {
            text += &format!("{}\n", literal(*other));
        }
        let mut bytes = text.into_bytes();
        for (index, pair) in self.gates.iter().enumerate() {
            let own = 2 * (first + latches + index) as u32;
            let [left, right] = pair.map(literal);
            write_number(&mut bytes, own - left.max(right));
            write_number(&mut bytes, left.abs_diff(right));
        }
        bytes
    }

    /// Searches a run of random inputs in whose last clock the output `bad` is high; in each, `needed` is.
    pub fn guess(&self, bad: &str, needed: &str) -> Option<Vec<Vec<bool>>> {
        let mut random = 0x9e37_79b9_7f4a_7c15_u64;
        let is = |state: &State, name: &str| self.output(state, name) == [true];
        let clocks = GUESSED.min(GUESSED_GATES / self.gates().max(1));
        (0..GUESSES).find_map(|_| {
            let mut run: Vec<Vec<bool>> = Vec::new();
            let mut before = None;
            while run.len() < clocks {
                let (inputs, state) = (0..TRIES).find_map(|_| {
                    let inputs: Vec<bool> = (0..self.inputs).map(|_| xorshift(&mut random)).collect();
                    let inputs = self.with(needed, inputs)?;
                    let state = self.state(before.as_ref(), &inputs);
                    (self.is_allowed(&state) && is(&state, needed)).then_some((inputs, state))
                })?;
                run.push(inputs);
                if is(&state, bad) {
                    return Some(run);
                }
                before = Some(state);
            }
            None
        })
    }

    /// Inputs by which an output is high that depends on one of them alone.
    fn with(&self, needed: &str, mut inputs: Vec<bool>) -> Option<Vec<bool>> {
        let literal = self.outputs[*self.port(needed).first()?];
        let input = (literal / 2) as usize;
        if (1..=self.inputs).contains(&input) {
            inputs[input - 1] = literal.is_multiple_of(2);
        }
        Some(inputs)
    }

    /// Whether something is assumed.
    pub fn has_constraints(&self) -> bool {
        !self.constraints.is_empty()
    }

    /// The number of gates.
    pub fn gates(&self) -> usize {
        self.gates.len()
    }

    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The bits of a port: indices of inputs or of outputs.
    pub fn port(&self, name: &str) -> &[usize] {
        self.ports.get(name).map_or(&[], Vec::as_slice)
    }

    /// The state in a clock, after the one before if there is one.
    pub fn state(&self, before: Option<&State>, inputs: &[bool]) -> State {
        let mut values = Vec::with_capacity(1 + self.inputs + self.latches.len() + self.gates.len());
        values.push(false);
        values.extend_from_slice(inputs);
        match before {
            Some(state) => values.extend(self.latches.iter().map(|next| state.literal(*next))),
            None => values.extend_from_slice(&self.start),
        }
        for [left, right] in &self.gates {
            let value = |literal: &u32| values[(literal / 2) as usize] != (literal % 2 == 1);
            values.push(value(left) && value(right));
        }
        State { values }
    }

    /// The bits of an output.
    pub fn output(&self, state: &State, name: &str) -> Vec<bool> {
        self.port(name).iter().map(|index| state.literal(self.outputs[*index])).collect()
    }

    /// Whether the assumptions of the design hold.
    pub fn is_allowed(&self, state: &State) -> bool {
        self.constraints.iter().all(|literal| state.literal(*literal))
    }
}

impl State {
    fn literal(&self, literal: u32) -> bool {
        self.values[(literal / 2) as usize] != (literal % 2 == 1)
    }
}

/// What is left to read.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<&'a str> {
        let rest = self.bytes.get(self.at..)?;
        let end = rest.iter().position(|byte| *byte == b'\n')?;
        self.at += end + 1;
        std::str::from_utf8(&rest[..end]).ok()
    }

    /// The first number of a line.
    fn literal(&mut self) -> Option<u32> {
        self.next()?.split(' ').next()?.parse().ok()
    }

    /// A number in seven bits a byte, the lowest first.
    fn number(&mut self) -> Option<u32> {
        let (mut number, mut shift) = (0_u32, 0);
        loop {
            let byte = *self.bytes.get(self.at)?;
            self.at += 1;
            number |= u32::from(byte & 0x7f).checked_shl(shift)?;
            shift += 7;
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
    }
}

/// Writes a number as [`Lines::number`] reads it.
fn write_number(bytes: &mut Vec<u8>, mut number: u32) {
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

/// The gates, the first of which is this variable. Each is stored as differences from the number before.
fn gates_from(first: usize, count: usize, lines: &mut Lines) -> Option<Vec<[u32; 2]>> {
    (0..count)
        .map(|index| {
            let own = 2 * (first + index) as u32;
            let left = own.checked_sub(lines.number()?)?;
            Some([left, left.checked_sub(lines.number()?)?])
        })
        .collect()
}

/// A name such as `x[3]` or `x` as port and bit.
fn bit_of(name: &str) -> Option<(&str, usize)> {
    match name.strip_suffix(']').and_then(|name| name.rsplit_once('[')) {
        Some((port, bit)) => Some((port, bit.parse().ok()?)),
        None => Some((name, 0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A toggle: `q` takes in `q ^ enable`, by three gates. The output is `q`.
    fn toggle() -> Vec<u8> {
        let text = b"aig 5 1 1 1 3\n11\n4\n".to_vec();
        // 6 = 4 & 2; 8 = 5 & 3; 10 = 9 & 7, which is q ^ enable.
        let gates = [2, 2, 3, 2, 1, 2];
        [text, gates.to_vec(), b"i0 enable\nl0 q\no0 q\nc\nmade by hand\n".to_vec()].concat()
    }

    #[test]
    fn a_circuit_is_read_and_run() {
        let circuit = Circuit::read(&toggle()).unwrap();
        let mut state = circuit.state(None, &[true]);
        let mut seen = vec![circuit.output(&state, "q")];
        for enable in [true, false, true] {
            state = circuit.state(Some(&state), &[enable]);
            seen.push(circuit.output(&state, "q"));
        }
        // The latch takes in the inverse of the last gate: it keeps its value where the input is high.
        assert_eq!(seen.concat(), [false, false, false, true]);
        assert!(circuit.is_allowed(&state) && circuit.inputs() == 1);
    }

    #[test]
    fn a_question_is_a_circuit_with_another_header() {
        let question = Circuit::read(&toggle()).unwrap().question("q", &["q"]);
        assert!(question.starts_with(b"aig 5 1 1 0 3 1 1\n11\n4\n4\n\x02\x02"));
        assert!(Circuit::read(&question).unwrap().outputs.is_empty());
        assert!(Circuit::read(b"aag 0 0 0 0 0\n").is_none() && Circuit::read(b"aig 1 0 0 0 1\n\x02").is_none());
    }

    #[test]
    fn a_latch_that_starts_high_is_inverted_in_a_question() {
        // A clock in which the input is low inverts the latch.
        let circuit = Circuit::read(&toggle()).unwrap();
        let first = circuit.state(None, &[false]);
        let circuit = circuit.after(&first);
        assert_eq!(circuit.output(&circuit.state(None, &[false]), "q"), [true]);
        let question = circuit.question("q", &[]);
        assert!(question.starts_with(b"aig 5 1 1 0 3 1 0\n10\n5\n\x01\x03"), "{question:?}");
    }

    #[test]
    fn random_inputs_find_a_run() {
        let circuit = Circuit::read(&toggle()).unwrap().after(&State { values: vec![false; 6] });
        let run = circuit.guess("q", "q").unwrap();
        assert_eq!(run.len(), 1);
    }

    #[test]
    fn numbers_are_written_as_they_are_read() {
        for number in [0, 1, 127, 128, 300_000] {
            let mut bytes = Vec::new();
            write_number(&mut bytes, number);
            assert_eq!(Lines { bytes: &bytes, at: 0 }.number(), Some(number));
        }
    }
}
