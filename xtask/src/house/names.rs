//! Names that a file uses: paths of `use` declarations, with trees expanded, and paths within code.

/// A path and its name in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Import {
    pub(crate) path: Vec<String>,
    pub(crate) name: String,
    /// Whether it is a `pub use`, so that others may find the name here.
    pub(crate) is_public: bool,
}

/// Every `use` of a text, one entry per name.
pub(crate) fn imports(text: &str) -> Vec<Import> {
    let mut all = Vec::new();
    for (is_public, tree) in declarations(text) {
        let mut names = Vec::new();
        expand_tree(&[], &tree.replace(" as ", "~").replace(char::is_whitespace, ""), &mut names);
        all.extend(names.into_iter().map(|(path, name)| Import { path, name, is_public }));
    }
    all
}

/// Paths of at least two names outside of `use` declarations.
pub(crate) fn paths(text: &str) -> Vec<Vec<String>> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let code: String =
        split_at_uses(text).into_iter().filter(|(is_use, _)| !is_use).map(|(_, part)| part).collect();
    let words = code.split(|c| !is_name(c)).filter(|word| word.contains("::"));
    let path = |word: &str| -> Vec<String> {
        word.trim_matches(':').split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect()
    };
    words.map(path).filter(|path| path.len() > 1).collect()
}

/// Trees of `use` declarations, and whether they are public.
fn declarations(text: &str) -> Vec<(bool, String)> {
    let mut found = Vec::new();
    let mut before = "";
    let parts = split_at_uses(text);
    for (is_use, part) in &parts {
        if *is_use {
            let line = before.rsplit(['\n', ';', '}', '{']).next().unwrap_or_default().trim();
            found.push((line.starts_with("pub"), part.trim_end_matches(';').to_owned()));
        }
        before = part;
    }
    found
}

/// The text split into the parts between `use` and its semicolon, and the rest.
fn split_at_uses(text: &str) -> Vec<(bool, &str)> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(at) = use_at(rest) {
        let (before, after) = rest.split_at(at);
        let end = after.find(';').map_or(after.len(), |end| end + 1);
        parts.extend([(false, before), (true, &after[..end])]);
        rest = &after[end..];
    }
    parts.push((false, rest));
    parts
}

/// Byte at which the tree of the next declaration begins.
fn use_at(text: &str) -> Option<usize> {
    let is_word = |at: &usize| !text[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
    text.match_indices("use ").map(|(at, _)| at).find(is_word).map(|at| at + "use ".len())
}

/// Leaves of a tree below `above`.
fn expand_tree(above: &[String], tree: &str, leaves: &mut Vec<(Vec<String>, String)>) {
    let Some((head, inside)) = tree.split_once('{') else {
        leaves.extend(expand_leaf(above, tree));
        return;
    };
    let above: Vec<String> =
        above.iter().cloned().chain(head.split("::").filter(|n| !n.is_empty()).map(str::to_owned)).collect();
    let inside = inside.strip_suffix('}').unwrap_or(inside);
    let (mut depth, mut start) = (0_i32, 0);
    for (at, sign) in inside.char_indices().chain([(inside.len(), ',')]) {
        match sign {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = &inside[start.min(at)..at];
                if !part.is_empty() {
                    expand_tree(&above, part, leaves);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

fn expand_leaf(above: &[String], text: &str) -> Option<(Vec<String>, String)> {
    let (path, alias) = text.split_once('~').map_or((text, None), |(path, alias)| (path, Some(alias)));
    let mut names: Vec<String> = above.to_vec();
    names.extend(path.split("::").filter(|name| !name.is_empty()).map(str::to_owned));
    if names.len() > 1 && names.last().is_some_and(|name| name == "self") {
        names.pop();
    }
    let name = alias.map(str::to_owned).or_else(|| names.last().cloned())?;
    Some((names, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_are_opened_to_their_leaves() {
        let text = "use crate::a::{self, b::{C, D as E}};\npub use f::*;\nfn g() { h::i(); use_of(j::k) }\n";
        let all = imports(text);
        let told: Vec<String> =
            all.iter().map(|i| format!("{}={}{}", i.name, i.path.join("::"), i.is_public)).collect();
        assert_eq!(told, ["a=crate::afalse", "C=crate::a::b::Cfalse", "E=crate::a::b::Dfalse", "*=f::*true"]);
        assert_eq!(paths(text), [vec!["h", "i"], vec!["j", "k"]]);
    }
}
