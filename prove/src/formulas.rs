//! The formulas of a design, written out for one state after another.
//!
//! Yosys defines functions of a state. An older solver puts the state into a function at each use again, and takes
//! exponentially long for that. So each function becomes a constant of each state.

/// A function of the state, or of the state and the next one.
struct Function {
    name: String,
    /// Its result's sort, and its body.
    rest: String,
    is_step: bool,
}

/// The formulas of a design.
pub struct Formulas {
    /// What comes before all states.
    pub prelude: String,
    functions: Vec<Function>,
}

impl Formulas {
    /// Reads what Yosys wrote.
    pub fn read(text: &str) -> Formulas {
        let (mut prelude, mut functions) = (String::new(), Vec::new());
        for form in forms(text) {
            match function(form.trim()) {
                Some(function) => functions.push(function),
                None => prelude += &(form + "\n"),
            }
        }
        Formulas { prelude, functions }
    }

    /// The functions of state `at`, and if there is one before, of the step to it.
    pub fn of(&self, at: u32) -> String {
        let functions = self.functions.iter().filter(|function| at > 0 || !function.is_step);
        let text = |Function { name, rest, is_step }: &Function| {
            let (now, next) = if *is_step { (at - 1, at) } else { (at, at) };
            format!("(define-fun |{name}@{at}| () {})\n", instantiate(rest, now, next))
        };
        functions.map(text).collect()
    }
}

/// A body with these states in place of `state` and `next_state`.
fn instantiate(body: &str, now: u32, next: u32) -> String {
    let mut text = String::with_capacity(body.len());
    let mut rest = body;
    while let Some(at) = rest.find("(|") {
        let Some(end) = rest[at + 2..].find('|').map(|end| at + 2 + end) else { break };
        let (name, after) = (&rest[at + 2..end], &rest[end + 1..]);
        text += &states(&rest[..at], now, next);
        let (state, after) = match (after.strip_prefix(" state)"), after.strip_prefix(" next_state)")) {
            (Some(after), _) => (now, after),
            (_, Some(after)) => (next, after),
            _ => panic!("`{name}` is a function of a state"),
        };
        text += &format!("|{name}@{state}|");
        rest = after;
    }
    text + &states(rest, now, next)
}

/// The names of the states themselves.
fn states(text: &str, now: u32, next: u32) -> String {
    text.replace(" next_state)", &format!(" s{next})")).replace(" state)", &format!(" s{now})"))
}

/// A definition `(define-fun |name| ((state |sort|)) ..)`.
fn function(form: &str) -> Option<Function> {
    let (name, rest) = form.strip_prefix("(define-fun |")?.split_once("| ((state |")?;
    let (parameters, rest) = rest.split_once(")) ")?;
    let is_step = parameters.contains("(next_state |");
    Some(Function { name: name.to_owned(), rest: rest.strip_suffix(')')?.to_owned(), is_step })
}

/// The forms of a text, without comments.
fn forms(text: &str) -> Vec<String> {
    let (mut forms, mut form, mut depth, mut quoted) = (Vec::new(), String::new(), 0, false);
    for line in text.lines() {
        for c in line.chars() {
            match c {
                '|' => quoted = !quoted,
                ';' if !quoted => break,
                '(' if !quoted => depth += 1,
                ')' if !quoted => depth -= 1,
                _ => {}
            }
            form.push(c);
            if depth == 0 && c == ')' {
                forms.push(std::mem::take(&mut form));
            }
        }
        form.push(' ');
    }
    forms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_become_constants_of_each_state() {
        let text = "; a comment (\n(define-sort |t_s| () (_ BitVec 2))\n\
                    (define-fun |t#0| ((state |t_s|)) Bool (= ((_ extract 0 0) state) #b1)) ; \\x\n\
                    (define-fun |t_t| ((state |t_s|) (next_state |t_s|)) Bool (and\n  (= (|t#0| state) (|t#0| next_state)) ; y\n))\n";
        let formulas = Formulas::read(text);
        assert_eq!(formulas.prelude.trim(), "(define-sort |t_s| () (_ BitVec 2))");
        assert_eq!(formulas.of(0), "(define-fun |t#0@0| () Bool (= ((_ extract 0 0) s0) #b1))\n");
        assert!(formulas.of(3).contains("(= |t#0@2| |t#0@3|)"), "{}", formulas.of(3));
    }
}
