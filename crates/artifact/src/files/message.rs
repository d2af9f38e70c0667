//! Messages about files, kept short whatever a file contains: a damaged file's value of megabytes is not
//! repeated, neither in one line nor in many.

use std::borrow::Cow;

/// Maximum line length of a message, bytes: room for a list of all vehicles, but not for megabytes of damage.
const LINE_BYTES: usize = 4096;
/// Bytes kept of the start and end of a longer line, where file and rule are named.
const KEPT_BYTES: [usize; 2] = [3072, 512];
/// Maximum number of lines of a message: a hundred broken rules of a scene and their context.
const LINES: usize = 128;
/// Lines kept of the start and end of a longer message.
const KEPT_LINES: [usize; 2] = [112, 8];

/// Shortens a message: cuts out the middle of overlong lines, and the middle of an overlong list of lines.
pub fn truncated(text: &str) -> Cow<'_, str> {
    let lines: Vec<&str> = text.lines().collect();
    if lines.len() <= LINES && lines.iter().all(|line| line.len() <= LINE_BYTES) {
        return text.into();
    }
    let [head, tail] = if lines.len() > LINES { KEPT_LINES } else { [lines.len(), 0] };
    let left_out = lines.len() - head - tail;
    let note = (left_out > 0).then(|| format!("… {left_out} lines left out …").into());
    let end = lines[lines.len() - tail..].iter().map(|line| truncated_line(line));
    let kept = lines[..head].iter().map(|line| truncated_line(line)).chain(note).chain(end);
    kept.collect::<Vec<_>>().join("\n").into()
}

fn truncated_line(line: &str) -> Cow<'_, str> {
    if line.len() <= LINE_BYTES {
        return line.into();
    }
    let [head, tail] = KEPT_BYTES;
    let (begin, end) = (line.floor_char_boundary(head), line.ceil_char_boundary(line.len() - tail));
    format!("{} … {} bytes left out … {}", &line[..begin], end - begin, &line[end..]).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_stays_and_of_a_words_megabytes_beginning_and_end_do() {
        let short = format!("a.model: one\n{}", "é".repeat(LINE_BYTES / 2));
        assert_eq!(truncated(&short), short);
        let long = format!("a.model: layers {} are not these\nnext", "é".repeat(3 << 20));
        let told = truncated(&long);
        assert!(told.starts_with("a.model: layers é") && told.ends_with("é are not these\nnext"), "{told}");
        assert!(told.contains("bytes left out") && told.len() < LINE_BYTES, "{}", told.len());
    }

    #[test]
    fn of_a_words_million_lines_beginning_and_end_stay() {
        let most = vec!["rule"; LINES].join("\n");
        assert_eq!(truncated(&most), most);
        let long = format!("a.model: layers {} are not these", "a,b\nc".repeat(1 << 20));
        let told = truncated(&long);
        assert!(
            told.starts_with("a.model: layers a,b\nca,b") && told.ends_with("\nc are not these"),
            "{told}"
        );
        assert!(told.contains("1048457 lines left out"), "{told}");
        let longest = truncated(&vec!["é".repeat(LINE_BYTES); 1 << 10].join("\n")).len();
        assert!(longest < LINES * LINE_BYTES, "{longest}");
    }
}
