//! The numbers of a PLY file after its header, one after another, in any form.

use super::super::lines::At;
use super::header::{Form, Header, Kind};
use crate::error::SceneError;
use crate::quote::quote;
use std::path::Path;

pub(super) struct Body<'a> {
    path: &'a Path,
    form: Form,
    rest: &'a [u8],
    /// In a text file, the line that was read last.
    line: usize,
}

impl<'a> Body<'a> {
    pub(super) fn new(path: &'a Path, header: &Header, bytes: &'a [u8]) -> Body<'a> {
        Body { path, form: header.form, rest: &bytes[header.length..], line: header.line }
    }

    /// The next number: that property of the element with that number, counted from 1.
    pub(super) fn number(&mut self, kind: Kind, of: Of) -> Result<f64, SceneError> {
        match self.form {
            Form::Text => self.word(kind, of),
            Form::Little => self.bytes(kind, of, false),
            Form::Big => self.bytes(kind, of, true),
        }
    }

    /// What is wrong with an element, at its line if it has one.
    pub(super) fn error(&self, of: Of, problem: &str, remedy: &str) -> SceneError {
        match self.form {
            Form::Text => At { path: self.path, line: self.line }.error(format!("{} {problem}", of.name), remedy),
            _ => SceneError::File {
                path: self.path.to_owned(),
                problem: format!("{} {} {problem}", of.name, of.number),
                remedy: remedy.to_owned(),
            },
        }
    }

    fn word(&mut self, kind: Kind, of: Of) -> Result<f64, SceneError> {
        let blanks = self.rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        self.line += self.rest[..blanks].iter().filter(|&&byte| byte == b'\n').count();
        let length = self.rest[blanks..].iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
        let (word, rest) = self.rest[blanks..].split_at(length);
        self.rest = rest;
        if word.is_empty() {
            return Err(self.ended(of));
        }
        let word = String::from_utf8_lossy(word);
        let number = if kind.is_whole() { word.parse::<i64>().ok().map(|i| i as f64) } else { word.parse().ok() };
        number.ok_or_else(|| {
            let what = if kind.is_whole() { "a whole number" } else { "a number" };
            self.error(of, &format!("has {} for {what}", quote(&word)), "correct it, or export the file again")
        })
    }

    fn bytes(&mut self, kind: Kind, of: Of, is_big: bool) -> Result<f64, SceneError> {
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::U8 => u8::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::I16 => i16::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::U16 => u16::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::I32 => i32::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::U32 => u32::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::F32 => f32::from_le_bytes(self.take(of, is_big)?).into(),
            Kind::F64 => f64::from_le_bytes(self.take(of, is_big)?),
        })
    }

    /// The next bytes, the least significant first.
    fn take<const N: usize>(&mut self, of: Of, is_big: bool) -> Result<[u8; N], SceneError> {
        let (&bytes, rest) = self.rest.split_first_chunk().ok_or_else(|| self.ended(of))?;
        self.rest = rest;
        let mut bytes: [u8; N] = bytes;
        if is_big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn ended(&self, of: Of) -> SceneError {
        SceneError::File {
            path: self.path.to_owned(),
            problem: format!("ends within {} {} of {}", of.name, of.number, of.count),
            remedy: "export it again".to_owned(),
        }
    }
}

/// What is read, for errors: its number, counted from 1, and the total.
#[derive(Clone, Copy)]
pub(super) struct Of<'a> {
    pub(super) name: &'a str,
    pub(super) number: u64,
    pub(super) count: u64,
}
