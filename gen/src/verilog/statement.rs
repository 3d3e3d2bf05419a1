//! Statements of always blocks, laid out.

/// A statement.
pub enum Statement {
    /// A complete `target <= value;` or `target = value;`.
    Assign(String),
    /// `if ... else if ... else`: conditions with bodies, then the last `else`, which may be empty.
    If(Vec<(String, Vec<Statement>)>, Vec<Statement>),
    /// `case (subject)` with labels and bodies, then `default`.
    Case {
        subject: String,
        arms: Vec<(String, Vec<Statement>)>,
        default: Vec<Statement>,
        /// The meaning of the default, as a comment.
        note: Option<String>,
    },
}

/// Whether one of the statements assigns under all conditions.
pub fn assign_always(statements: &[Statement]) -> bool {
    statements.iter().any(|statement| match statement {
        Statement::Assign(_) => true,
        Statement::If(arms, last) => assign_always(last) && arms.iter().all(|(_, body)| assign_always(body)),
        Statement::Case { arms, default, .. } => {
            assign_always(default) && arms.iter().all(|(_, body)| assign_always(body))
        }
    })
}

/// The same statements, with successive ones under the same conditions merged.
pub fn merged(statements: Vec<Statement>) -> Vec<Statement> {
    let mut out: Vec<Statement> = Vec::with_capacity(statements.len());
    for statement in statements {
        match (out.last_mut(), statement) {
            (Some(Statement::If(arms, last)), Statement::If(more, more_last))
                if have_same_conditions(arms, &more) && last.is_empty() == more_last.is_empty() =>
            {
                for ((_, body), (_, more)) in arms.iter_mut().zip(more) {
                    body.extend(more);
                }
                last.extend(more_last);
            }
            (_, statement) => out.push(statement),
        }
    }
    for statement in &mut out {
        if let Statement::If(arms, last) = statement {
            arms.iter_mut().map(|(_, body)| body).chain([last]).for_each(|body| *body = merged(std::mem::take(body)));
        }
    }
    out
}

fn have_same_conditions(arms: &[(String, Vec<Statement>)], others: &[(String, Vec<Statement>)]) -> bool {
    arms.iter().map(|(condition, _)| condition).eq(others.iter().map(|(condition, _)| condition))
}

/// The lines of the statements, indented by `indent` steps.
pub fn lines(statements: &[Statement], indent: usize) -> Vec<String> {
    let mut out = Vec::new();
    statements.iter().for_each(|statement| print(statement, indent, &mut out));
    out
}

fn print(statement: &Statement, indent: usize, out: &mut Vec<String>) {
    let pad = "    ".repeat(indent);
    match statement {
        Statement::Assign(text) => out.push(format!("{pad}{text}")),
        Statement::If(arms, last) => {
            let short = arms.iter().map(|(_, body)| body).chain([last]).all(|body| is_short(body));
            let mut head = format!("{pad}if ");
            for (condition, body) in arms {
                print_body(&format!("{head}({condition})"), body, short, indent, out);
                head = if short { format!("{pad}else if ") } else { format!("{pad}end else if ") };
            }
            if !last.is_empty() {
                let head = if short { format!("{pad}else") } else { format!("{pad}end else") };
                print_body(&head, last, short, indent, out);
            }
            if !short {
                out.push(format!("{pad}end"));
            }
        }
        Statement::Case { subject, arms, default, note } => {
            out.push(format!("{pad}case ({subject})"));
            for (label, body) in arms {
                print_arm(label, body, indent + 1, out);
            }
            let head = out.len();
            print_arm("default", default, indent + 1, out);
            if let Some(note) = note {
                out[head].push_str(&format!(" // {note}"));
            }
            out.push(format!("{pad}endcase"));
        }
    }
}

fn print_arm(label: &str, body: &[Statement], indent: usize, out: &mut Vec<String>) {
    let pad = "    ".repeat(indent);
    // One condition with one assignment follows its label on the line.
    if let [Statement::If(arms, last)] = body
        && let ([(condition, body)], []) = (&arms[..], &last[..])
        && let [Statement::Assign(text)] = &body[..]
        && condition.len() + text.len() < 70
    {
        out.push(format!("{pad}{label}: if ({condition}) {text}"));
        return;
    }
    let short = is_short(body);
    print_body(&format!("{pad}{label}:"), body, short, indent, out);
    if !short {
        out.push(format!("{pad}end"));
    }
}

/// Whether the body fits on the line of its condition.
fn is_short(body: &[Statement]) -> bool {
    match body {
        [] => true,
        [Statement::Assign(text)] => text.len() < 60,
        _ => false,
    }
}

fn print_body(head: &str, body: &[Statement], short: bool, indent: usize, out: &mut Vec<String>) {
    match body {
        [Statement::Assign(text)] if short => out.push(format!("{head} {text}")),
        [] if short => out.push(format!("{head} ;")),
        _ => {
            out.push(format!("{head} begin"));
            out.extend(lines(body, indent + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assign(text: &str) -> Statement {
        Statement::Assign(text.to_string())
    }

    fn when(condition: &str, body: Vec<Statement>, last: Vec<Statement>) -> Statement {
        Statement::If(vec![(condition.to_string(), body)], last)
    }

    #[test]
    fn what_follows_under_the_same_conditions_is_under_one() {
        let [one, two] = ["x", "y"].map(|name| {
            let inner = when("b", vec![assign(&format!("{name} <= 1;"))], vec![assign(&format!("{name} <= 2;"))]);
            when("a", vec![inner], vec![])
        });
        let other = when("a", vec![assign("z <= 1;")], vec![assign("z <= 2;")]);
        let printed = lines(&merged(vec![one, two, other, when("c", vec![assign("w <= 1;")], vec![])]), 0);
        let expected = "\
if (a) begin
    if (b) begin
        x <= 1;
        y <= 1;
    end else begin
        x <= 2;
        y <= 2;
    end
end
if (a) z <= 1;
else z <= 2;
if (c) w <= 1;";
        assert_eq!(printed.join("\n"), expected);
    }
}
