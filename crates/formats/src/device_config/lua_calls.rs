//! Calls of `ar1` in a Lua script of mmWave Studio: those in code, not in comments and strings (Lua 5.1
//! Reference Manual, 2.1), with their branch of `if`. Nothing is executed: loops and functions count once,
//! conditions are unknown.

/// A call in the script.
#[derive(Debug, Clone, Copy)]
pub(super) struct LuaCall<'a> {
    /// Line of its name, from 1.
    pub(super) line: usize,
    pub(super) name: &'a str,
    /// Branch of the call, each with its own number; 0 outside of all.
    pub(super) branch: usize,
    /// Whether the call is in a function, which may be called elsewhere.
    pub(super) is_in_function: bool,
    /// Text after its opening bracket, with and without comments and strings.
    behind: [&'a str; 2],
}

/// Largest call: one with numbers takes some hundred bytes.
const LIMIT_BYTES: usize = 4096;

impl<'a> LuaCall<'a> {
    /// Arguments between the brackets; `None` if the call does not end.
    pub(super) fn words(&self) -> Option<Vec<&'a str>> {
        let [text, code] = self.behind;
        let code = &code[..code.len().min(LIMIT_BYTES)];
        let mut depth = 0_usize;
        let end = code.find(|c| match c {
            '(' => {
                depth += 1;
                false
            }
            ')' if depth > 0 => {
                depth -= 1;
                false
            }
            other => other == ')',
        })?;
        let mut start = 0;
        let words = code[..end].split(',').map(|word| {
            let place = start..start + word.len();
            start = place.end + 1;
            // A quoted string is blank in the code.
            let word = Some(word.trim()).filter(|word| !word.is_empty());
            word.unwrap_or_else(|| text[place].trim().trim_matches(['"', '\'']))
        });
        Some(words.filter(|word| !word.is_empty()).collect())
    }
}

/// The text with blanks in place of comments, quoted strings and long brackets; of equal length, line by
/// line.
pub(super) fn code_of(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut code = Vec::with_capacity(bytes.len());
    while code.len() < bytes.len() {
        let rest = &bytes[code.len()..];
        let hidden = hidden(rest);
        code.extend(rest[..hidden].iter().map(|byte| if *byte == b'\n' { b'\n' } else { b' ' }));
        // Characters beyond ASCII are not code, and keep their length.
        let kept = rest.get(hidden).filter(|_| hidden == 0);
        code.extend(kept.map(|byte| if byte.is_ascii() { *byte } else { b' ' }));
    }
    String::from_utf8(code).unwrap_or_default()
}

/// Calls of a text in order; `code` is the text without comments and strings.
pub(super) fn calls<'a>(text: &'a str, code: &'a str) -> Vec<LuaCall<'a>> {
    let (mut blocks, mut all, mut line, mut seen) = (Blocks::default(), vec![], 1, 0);
    for (at, word) in words(code) {
        line += code[seen..at].bytes().filter(|byte| *byte == b'\n').count();
        seen = at;
        if word != "ar1" {
            blocks.step(word);
        } else if let Some((name, open)) = call_behind(code, at + word.len()) {
            let Block { branch, is_in_function, .. } = blocks.inmost();
            let behind = [&text[open..], &code[open..]];
            all.push(LuaCall { line, name, branch, is_in_function, behind });
        }
    }
    all
}

/// Identifiers, keywords and numbers with their positions.
fn words(code: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    let apart = code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    let placed = apart.map(move |word| {
        let at = start;
        start += word.len() + 1;
        (at, word)
    });
    placed.filter(|(_, word)| !word.is_empty())
}

/// Name after `ar1.` and the position after its opening bracket.
fn call_behind(code: &str, at: usize) -> Option<(&str, usize)> {
    let behind = code[at..].strip_prefix('.')?;
    let length = behind.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))?;
    let (name, rest) = behind.split_at(length);
    let inside = rest.trim_start().strip_prefix('(')?;
    Some((name, code.len() - inside.len()))
}

/// Length of the comment or string that begins here; 0 if none does. An unterminated one hides the rest of
/// the text, in quotes that of its line.
fn hidden(rest: &[u8]) -> usize {
    let line = || rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
    match rest {
        [b'-', b'-', behind @ ..] => long_brackets(behind).map_or_else(line, |length| length + 2),
        [b'[', ..] => long_brackets(rest).unwrap_or(0),
        [quote @ (b'"' | b'\''), ..] => quoted(rest, *quote),
        _ => 0,
    }
}

/// Length of a long bracket, `[[` to `]]`, or with equal numbers of `=` within both.
fn long_brackets(rest: &[u8]) -> Option<usize> {
    let behind = rest.strip_prefix(b"[")?;
    let level = behind.iter().take_while(|byte| **byte == b'=').count();
    if behind.get(level) != Some(&b'[') {
        return None;
    }
    let closing = [b"]", &behind[..level], b"]"].concat();
    let end = rest.windows(closing.len()).position(|window| window == closing);
    Some(end.map_or(rest.len(), |end| end + closing.len()))
}

fn quoted(rest: &[u8], quote: u8) -> usize {
    let mut is_escaped = true; // the opening quote itself
    let end = rest.iter().position(|byte| {
        let ends = !is_escaped && *byte == quote || *byte == b'\n';
        is_escaped = !is_escaped && *byte == b'\\';
        ends
    });
    end.map_or(rest.len(), |end| if rest[end] == quote { end + 1 } else { end })
}

/// Open blocks.
#[derive(Default)]
struct Blocks {
    open: Vec<Block>,
    branches: usize,
}

#[derive(Debug, Clone, Copy, Default)]
struct Block {
    kind: Kind,
    /// Branch around it.
    outer: usize,
    branch: usize,
    is_in_function: bool,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Kind {
    If,
    /// A loop whose `do` has not come yet.
    Loop,
    #[default]
    Other,
}

impl Blocks {
    fn inmost(&self) -> Block {
        self.open.last().copied().unwrap_or_default()
    }

    fn step(&mut self, word: &str) {
        match word {
            "if" => self.begin(Kind::If),
            "for" | "while" => self.begin(Kind::Loop),
            "repeat" => self.begin(Kind::Other),
            "function" => {
                self.begin(Kind::Other);
                self.change(|block| block.is_in_function = true);
            }
            "do" if self.inmost().kind == Kind::Loop => self.change(|block| block.kind = Kind::Other),
            "do" => self.begin(Kind::Other),
            "then" | "else" if self.inmost().kind == Kind::If => {
                self.branches += 1;
                let branch = self.branches;
                self.change(|block| block.branch = branch);
            }
            "elseif" => self.change(|block| block.branch = block.outer),
            "end" | "until" => {
                self.open.pop();
            }
            _ => {}
        }
    }

    fn begin(&mut self, kind: Kind) {
        let around = self.inmost();
        self.open.push(Block { kind, outer: around.branch, ..around });
    }

    fn change(&mut self, change: impl FnOnce(&mut Block)) {
        if let Some(block) = self.open.last_mut() {
            change(block);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Name, line, branch and words of each call.
    fn found(text: &str) -> Vec<(String, usize, usize, String)> {
        let code = code_of(text);
        let told = |call: &LuaCall<'_>| {
            let words = call.words().map_or_else(|| "no end".to_owned(), |words| words.join(" "));
            (call.name.to_owned(), call.line, call.branch, words)
        };
        calls(text, &code).iter().map(told).collect()
    }

    fn names(text: &str) -> Vec<String> {
        found(text).into_iter().map(|(name, ..)| name).collect()
    }

    #[test]
    fn remarks_and_texts_are_no_code_and_hide_none() {
        assert_eq!(names("--[[ ar1.A(1)\n ar1.B(1)\n]] ar1.C(1)"), ["C"]);
        assert_eq!(names("--[==[ ar1.A(1) ]] ar1.B(1) ]==] ar1.C(1)"), ["C"]);
        assert_eq!(names("Log(\"--- it's\", 'red') ar1.C(1) -- ar1.D(1)"), ["C"]);
        assert_eq!(names("Log(\"a \\\" -- ar1.A(1)\") ar1.C(1)"), ["C"]);
        assert_eq!(names("x = [[ ar1.A(1) ]] ar1.C(1)"), ["C"]);
        assert_eq!(names("--[[ ar1.A(1)\nar1.B(1)"), [""; 0]);
        assert_eq!(names("print('\nar1.C(1)"), ["C"]);
        assert_eq!(names("my_ar1.A(1) ar1 = ar1.x ar1.B (1)"), ["B"]);
        assert_eq!(code_of("ü -- ü\nx").len(), "ü -- ü\nx".len());
    }

    #[test]
    fn words_are_those_between_the_brackets_wherever_they_end() {
        let told = found("ar1.A(1, f(2, 3), \"a,b)\") ar1.B(\n  4, -- five\n  6)\nar1.C(7");
        let words: Vec<(&str, usize, &str)> =
            told.iter().map(|(name, line, _, words)| (name.as_str(), *line, words.as_str())).collect();
        assert_eq!(words, [("A", 1, "1 f(2 3) a,b)"), ("B", 1, "4 6"), ("C", 4, "no end")]);
    }

    #[test]
    fn conditions_stand_outside_of_their_branches_and_loops_and_functions_are_none() {
        let text = "if (ar1.A() == 0) then ar1.B() elseif ar1.C() then ar1.D() else ar1.E() end ar1.F()\n\
                    for i = 1, 2 do ar1.G() end while x do ar1.H() end repeat ar1.I() until ar1.J()\n\
                    local f = function() if x then ar1.K() end return ar1.L() end ar1.M()";
        let branches: Vec<(String, usize)> =
            found(text).into_iter().map(|(name, _, branch, _)| (name, branch)).collect();
        let within: Vec<&str> =
            branches.iter().filter(|(_, branch)| *branch > 0).map(|(name, _)| name.as_str()).collect();
        assert_eq!((branches.len(), within), (13, vec!["B", "D", "E", "K"]));
        let code = code_of(text);
        let held: Vec<&str> =
            calls(text, &code).iter().filter(|call| call.is_in_function).map(|call| call.name).collect();
        assert_eq!(held, ["K", "L"]);
    }
}
