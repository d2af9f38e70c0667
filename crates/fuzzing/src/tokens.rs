//! Texts changed by their words: what stands between blanks and signs is replaced, doubled, moved, nested.

use crate::rng::FuzzRng;

/// A text as its words, signs and blanks.
struct Tokens(Vec<Vec<u8>>);

impl Tokens {
    fn of(text: &[u8]) -> Self {
        let class = |byte: &u8| match byte {
            b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' | b'_' | b'.' | b'-' | b'+' | 128.. => 0,
            b' ' | b'\t' => 1,
            other => 2 + usize::from(*other),
        };
        Self(text.chunk_by(|a, b| class(a) == class(b) && class(a) < 2).map(<[u8]>::to_vec).collect())
    }

    fn bytes(self) -> Vec<u8> {
        self.0.concat()
    }

    fn any_index(&self, rng: &mut FuzzRng) -> usize {
        rng.below(self.0.len())
    }

    /// A place of something that says something, if a few tries find one.
    fn word_index(&self, rng: &mut FuzzRng) -> usize {
        let says = |i: &usize| {
            self.0.get(*i).is_some_and(|token| token[0].is_ascii_alphanumeric() || token[0] == b'-')
        };
        let tries: Vec<usize> = (0..8).map(|_| self.any_index(rng)).collect();
        tries.iter().copied().find(says).unwrap_or(tries[0])
    }

    fn mutate(&mut self, rng: &mut FuzzRng, words: &[&str]) {
        let (at, word) = (self.any_index(rng), self.word_index(rng));
        match rng.below(9) {
            0 | 1 => self.0[word] = rng.number_text().into_bytes(),
            2 => self.0[word] = rng.choose(words).as_bytes().to_vec(),
            3 => drop(self.0.remove(at)),
            4 => self.0.insert(at, rng.choose(words).as_bytes().to_vec()),
            5 => self.0[at] = self.0[at].repeat(rng.repeat_count()),
            6 => self.0.insert(at, rng.stray_bytes().to_vec()),
            7 => self.0.insert(at, self.0[word].clone()),
            _ => self.0.swap(at, word),
        }
    }
}

/// What opens, closes and separates in TOML.
const TOML_PUNCTUATION: [&str; 12] = ["[", "]", "{", "}", "[[", "]]", "\"", "'''", "=", ",", "#", "\n"];

/// The signs of TOML, and behind them the words of a format.
pub fn with_toml_punctuation<'a>(words: &[&'a str]) -> Vec<&'a str> {
    [&TOML_PUNCTUATION, words].concat()
}

/// A longer text is not changed again: one change repeats a part of it up to thousands of times.
const MAX_MUTATED_BYTES: usize = 1 << 16;

/// One to four changes of words and lines; `words` are those of the format.
pub fn mutate(rng: &mut FuzzRng, text: &[u8], words: &[&str]) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..=rng.below(4) {
        if bytes.len() > MAX_MUTATED_BYTES {
            break;
        }
        if rng.one_in(3) {
            bytes = mutate_lines(rng, &bytes);
        } else {
            let mut tokens = Tokens::of(&bytes);
            if !tokens.0.is_empty() {
                tokens.mutate(rng, words);
            }
            bytes = tokens.bytes();
        }
    }
    bytes
}

fn mutate_lines(rng: &mut FuzzRng, text: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return vec![];
    }
    let (at, other) = (rng.below(lines.len()), rng.below(lines.len()));
    match rng.below(6) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(at, lines[other]),
        2 => lines.swap(at, other),
        3 => lines.truncate(at),
        4 => lines.extend_from_within(at.min(other)..at.max(other)),
        _ => {
            let many = std::iter::repeat_n(lines[other], rng.repeat_count());
            lines.splice(at..at, many);
        }
    }
    lines.concat()
}
