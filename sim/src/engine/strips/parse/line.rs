//! A line of a strip program in words.

use super::super::value::Type;

/// The words of a line, and the place of the next one.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub number: usize,
    /// Levels of two spaces before it.
    pub depth: usize,
    pub words: Vec<String>,
    pub at: usize,
}

impl Line {
    pub fn new(number: usize, line: &str) -> Line {
        let text = line.split(';').next().unwrap_or_default();
        let mut words = vec![String::new()];
        for character in text.chars() {
            match character {
                ' ' => words.push(String::new()),
                '[' | ']' | '(' | ')' | ',' | ':' | '=' => words.extend([character.to_string(), String::new()]),
                _ => words.last_mut().expect("there is one").push(character),
            }
        }
        words.retain(|word| !word.is_empty());
        let depth = (text.len() - text.trim_start_matches(' ').len()) / 2;
        Line { number, depth, words, at: 0 }
    }

    /// A sentence about the line.
    pub fn wrong(&self, what: impl std::fmt::Display) -> String {
        format!("line {}: `{}` {what}", self.number, self.words.join(" "))
    }

    pub fn peek(&self) -> Option<&str> {
        self.words.get(self.at).map(String::as_str)
    }

    pub fn next(&mut self, what: &str) -> Result<String, String> {
        let word = self.words.get(self.at).cloned();
        self.at += 1;
        word.ok_or_else(|| self.wrong(format_args!("ends too early: add {what}")))
    }

    /// Whether this is the next word, which is then taken.
    pub fn takes(&mut self, word: &str) -> bool {
        let is_next = self.peek() == Some(word);
        self.at += usize::from(is_next);
        is_next
    }

    pub fn skip(&mut self, word: &str) -> Result<(), String> {
        match self.takes(word) {
            true => Ok(()),
            false => {
                let found = self.peek().map_or("its end".to_owned(), |found| format!("`{found}`"));
                Err(self.wrong(format_args!("has {found} where `{word}` belongs: write `{word}` there")))
            }
        }
    }

    pub fn end(&self) -> Result<(), String> {
        match self.peek() {
            None => Ok(()),
            Some(word) => Err(self.wrong(format_args!("goes on with `{word}`, which nothing takes: remove it"))),
        }
    }

    pub fn number<T: std::str::FromStr>(&mut self) -> Result<T, String> {
        let word = self.next("a number")?;
        word.parse().map_err(|_| self.wrong(format_args!("has `{word}` in place of a number that fits: write one")))
    }

    /// Numbers up to the end.
    pub fn numbers<T: std::str::FromStr>(&mut self) -> Result<Vec<T>, String> {
        let mut all = Vec::new();
        while self.peek().is_some() {
            all.push(self.number()?);
        }
        Ok(all)
    }

    pub fn ty(&mut self) -> Result<Type, String> {
        let word = self.next("a type")?;
        let found = Type::all().find(|ty| ty.to_string() == word);
        found.ok_or_else(|| self.wrong(format_args!("has `{word}` in place of a type: write one as `i64` or `i8x16`")))
    }
}
