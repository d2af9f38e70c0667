//! Numbers and scripts of a view, as embedded in its page.

use maud::{Markup, PreEscaped, html};
use pipeline::host::safe_text;
use serde::Serialize;

/// Numbers as JSON that is safe in a page: `</script` and `<!--` would end or open something.
pub(in crate::report) fn json(numbers: &impl Serialize) -> Result<String, serde_json::Error> {
    let json = serde_json::to_string(numbers)?.replace('<', "\\u003c");
    Ok(safe_text::in_json(&json).into_owned())
}

/// Scripts at the beginning of every view, each after those that it uses.
const FIRST: [&str; 7] = [
    include_str!("script/page/numbers.js"),
    include_str!("script/page/matrices.js"),
    include_str!("script/page/camera.js"),
    include_str!("script/page/graphics.js"),
    include_str!("script/page/colours.js"),
    include_str!("script/page/shapes.js"),
    include_str!("script/page/picture.js"),
];

/// Numbers and scripts: those of every view, then its own, each after those that it uses.
pub(in crate::report) fn scripts(json: &str, own: &[&str]) -> Markup {
    html! {
        script type="application/json" id="viewer-data" { (PreEscaped(json)) }
        script { (PreEscaped("\"use strict\";\n{\n")) @for part in FIRST.iter().chain(own) { (PreEscaped(part)) } (PreEscaped("}\n")) }
    }
}

/// Fails a test if a script's lines, functions or length violate the rules for the rest of the source.
#[cfg(test)]
pub(in crate::report) fn reads_as_the_source_does(parts: &[&str]) {
    for part in parts {
        let (name, lines) = (part.lines().next().unwrap_or_default(), part.lines().count());
        assert!(name.starts_with("// ") && lines < 600, "{name}: {lines} lines");
        let long = part.lines().find(|line| line.chars().count() > 110);
        assert_eq!(long, None, "{name}");
        // A function begins and ends at the first column.
        let mut begun = 0;
        for (number, line) in part.lines().enumerate() {
            if line.starts_with("function ") {
                begun = number;
            }
            assert!(line != "}" || number - begun < 70, "{name}, line {number}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scripts_of_every_view_read_as_the_rest_of_the_source_does() {
        reads_as_the_source_does(&FIRST);
    }
}
