//! The displayed frame, and the check of the refreshes' colours.
//!
//! Source: VC1-GFB, VC1-SW2, VC1-HOSTP, VC1-ACB. Each displayed frame is checked in its first refresh, and so is the average of a picture's
//! passes.

use tilewright_scenes::{Frame, Size, golden};

use super::cursor::Cursor;
use crate::error::Error;

/// Checks the display.
pub(crate) struct Viewer {
    size: Size,
    /// The number of passes of a picture.
    passes: usize,
    cursor: Option<Cursor>,
    /// Whether every refresh is checked, not only the first one of each frame.
    every: bool,
    /// Whether the colours that the display got are kept in place of a check.
    keeps: bool,
    kept: Vec<u32>,
    on_display: Option<OnDisplay>,
    /// The passes of the current picture.
    picture: Vec<Frame>,
    refresh: Option<Refresh>,
    /// Refreshes that had the right colours.
    pub judged: u64,
}

/// A frame on display.
pub(crate) struct OnDisplay {
    pub number: u32,
    /// The content of the displayed bank, with the cursor.
    pub frame: Frame,
    /// The average, for the last pass of a picture.
    pub average: Option<Frame>,
    is_seen: bool,
    is_average_seen: bool,
}

/// A refresh that is being checked.
struct Refresh {
    averages: bool,
    colours: Vec<u32>,
}

impl Viewer {
    /// A check of the first refresh of each frame, or of every one, for pictures of that number of passes, in which frames are passes. It may keep
    /// the colours in place of a check.
    pub fn new(size: Size, passes: Option<u32>, cursor: Option<Cursor>, (every, keeps): (bool, bool)) -> Viewer {
        Viewer {
            size,
            passes: passes.map_or(1, |passes| passes as usize),
            cursor,
            every,
            keeps,
            kept: Vec::new(),
            on_display: None,
            picture: Vec::new(),
            refresh: None,
            judged: 0,
        }
    }

    /// Notes a change of the banks, after which a frame of these words is on display.
    pub fn show(&mut self, number: u32, words: Vec<u64>) -> &OnDisplay {
        let mut frame = Frame::from_words(self.size, words).expect("there is a word of 48 bits for each pixel");
        if let Some(cursor) = self.cursor {
            cursor.draw(&mut frame);
        }
        let mut average = None;
        if self.passes > 1 {
            self.picture.push(frame.clone());
            if self.picture.len() == self.passes {
                average = Some(golden::average(&std::mem::take(&mut self.picture)));
            }
        }
        self.on_display.insert(OnDisplay { number, frame, average, is_seen: false, is_average_seen: false })
    }

    /// Notes the end of a blanking, before a refresh of the average or of the bank. Returns whether it is the first refresh of an average.
    pub fn begin(&mut self, averages: bool) -> bool {
        let Some(shown) = &self.on_display else { return false };
        let is_new = !if averages { shown.is_average_seen } else { shown.is_seen };
        if is_new || self.every {
            self.refresh = Some(Refresh { averages, colours: Vec::with_capacity(self.size.pixels()) });
        }
        is_new && averages
    }

    /// Whether a refresh is being checked.
    pub fn is_looking(&self) -> bool {
        self.refresh.is_some()
    }

    /// Whether a pixel of the refresh has been seen.
    pub fn has_begun(&self) -> bool {
        self.refresh.as_ref().is_some_and(|refresh| !refresh.colours.is_empty())
    }

    /// The receiver of the refresh's colours, if it is checked.
    pub fn colours(&mut self) -> Option<&mut Vec<u32>> {
        self.refresh.as_mut().map(|refresh| &mut refresh.colours)
    }

    /// The checked part of the refresh, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        let seen = self.refresh.as_ref().map_or(0, |refresh| refresh.colours.len());
        seen as f64 / self.size.pixels() as f64
    }

    /// Judges the refresh, if it is complete.
    ///
    /// # Errors
    /// [`Error::Displayed`].
    pub fn judge(&mut self) -> Result<(), Error> {
        let pixels = self.size.pixels();
        let Some(Refresh { averages, colours }) = self.refresh.take_if(|it| it.colours.len() == pixels) else {
            return Ok(());
        };
        let shown = self.on_display.as_mut().expect("a refresh is looked at when there is a frame");
        let (expected, is_seen) = match &shown.average {
            Some(average) if averages => (average, &mut shown.is_average_seen),
            _ => (&shown.frame, &mut shown.is_seen),
        };
        *is_seen = true;
        if self.keeps {
            self.kept = colours;
            return Ok(());
        }
        let differs = |(colour, word): (&u32, &u64)| u64::from(*colour) != word & 0xff_ffff;
        if let Some(place) = colours.iter().zip(&expected.words).position(differs) {
            let width = self.size.width() as usize;
            return Err(Error::Displayed { x: (place % width) as u32, y: (place / width) as u32 });
        }
        self.judged += 1;
        Ok(())
    }

    /// Ends a refresh that lacks pixels, which are black.
    ///
    /// # Errors
    /// As [`Viewer::judge`].
    pub fn give_up(&mut self) -> Result<(), Error> {
        let pixels = self.size.pixels();
        self.refresh.get_or_insert_with(|| Refresh { averages: false, colours: Vec::new() }).colours.resize(pixels, 0);
        self.judge()
    }

    /// Gives a frame the colours that the display got, if they are kept.
    pub fn colour(&self, frame: &mut Frame) {
        for (word, colour) in frame.words.iter_mut().zip(&self.kept) {
            *word = *word & !0xff_ffff | u64::from(*colour);
        }
    }

    /// Whether a displayed frame has been checked, or was replaced before a refresh showed it.
    pub fn has_seen(&self, number: u32) -> bool {
        self.on_display.as_ref().is_some_and(|shown| {
            let is_seen = match shown.average {
                // With a short sum its pass has no refresh.
                Some(_) => shown.is_average_seen,
                None => shown.is_seen,
            };
            shown.number > number || shown.number == number && is_seen
        })
    }
}
