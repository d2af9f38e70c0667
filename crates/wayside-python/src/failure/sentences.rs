//! Sentences of failures taken apart: `FILE:LINE:COLUMN: place: rule`, a line each.

/// A broken rule with its place, as a sentence tells them.
pub(crate) struct Sentence<'a> {
    /// Line in the file, from 1.
    pub(crate) line: Option<u32>,
    /// Column in the file, from 1.
    pub(crate) column: Option<u32>,
    /// Table, target or material concerned.
    pub(crate) place: Option<&'a str>,
    /// Rule that is broken.
    pub(crate) rule: &'a str,
}

/// Beginnings and ends of places.
const PLACES: [(&str, &str); 5] =
    [("[", "]"), ("target `", "`"), ("clutter `", "`"), ("radar `", "`"), ("material `", "`")];

/// Sentences about a file, one where the text does not begin with its name. A line that begins otherwise
/// belongs to the one before it, and the number of rules that are not told is no rule.
pub(crate) fn about<'a>(text: &'a str, file: Option<&str>) -> Vec<Sentence<'a>> {
    let begin = file.map(|file| format!("{file}:")).unwrap_or_default();
    match text.strip_prefix(&begin).filter(|_| !begin.is_empty()) {
        Some(rest) => told(rest).split(&format!("\n{begin}")).map(Sentence::behind_file).collect(),
        None => vec![Sentence { line: None, column: None, place: None, rule: text }],
    }
}

/// Text without the line that counts the rules left out.
fn told(text: &str) -> &str {
    let is_count = |last: &str| last.starts_with("and ") && last.ends_with(" more");
    text.rsplit_once('\n').filter(|(_, last)| is_count(last)).map_or(text, |(before, _)| before)
}

impl<'a> Sentence<'a> {
    fn behind_file(text: &'a str) -> Self {
        let (line, rest) = number(text);
        let (column, rest) = if line.is_some() { number(rest) } else { (None, rest) };
        let (place, rule) = placed(rest.trim_start());
        Self { line, column, place, rule }
    }
}

/// A number before a colon, and what is behind that.
fn number(text: &str) -> (Option<u32>, &str) {
    let parted = text.split_once(':').and_then(|(number, rest)| Some((number.parse().ok()?, rest)));
    parted.map_or((None, text), |(number, rest)| (Some(number), rest))
}

/// A place before a colon, and the rule behind it.
fn placed(text: &str) -> (Option<&str>, &str) {
    let place = |(opening, closing): (&str, &str)| {
        let inner = text.strip_prefix(opening)?;
        let (name, rule) = inner.split_once(&format!("{closing}: "))?;
        Some((&text[..opening.len() + name.len() + closing.len()], rule))
    };
    PLACES.into_iter().find_map(place).map_or((None, text), |(place, rule)| (Some(place), rule))
}
