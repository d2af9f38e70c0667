//! Objects that are nobody's, and what made them.

use crate::report::tables::{rounded, scrolled, whole};
use maud::{Markup, html};
use serde_json::Value;

/// A row per false object, and per object that the radar tells to be at rest; nothing where the summary does
/// not tell.
pub(super) fn section(frame: &Value) -> Markup {
    let Some(objects) = frame["false_objects"].as_array() else { return html! {} };
    let standing = frame["stationary_objects"].as_array().map_or(&[][..], Vec::as_slice);
    html! {
        h3 { "False objects" }
        @match (&objects[..], standing) {
            ([], []) => p { "None: every object is a body's." },
            ([], _) => p { "None: every object that moves is a body's." },
            _ => (table("False objects", objects)),
        }
        @if !standing.is_empty() {
            h3 { "Objects at rest that are no body's" }
            p { "The radar tells them to be at rest, and they claim no vehicle: they are not counted as false." }
            (table("Objects at rest", standing))
        }
    }
}

fn table(name: &str, objects: &[Value]) -> Markup {
    let table = html! { table {
        thead { tr {
            th { "object" } th.words { "what made it" } th { "range, m" } th { "velocity, m/s" } th { "x, m" } th { "y, m" }
            th { "SNR, dB" } th { "multipath ghost share" }
        } }
        tbody { @for object in objects { (row(object)) } }
    } };
    scrolled(name, table)
}

fn row(object: &Value) -> Markup {
    html! { tr {
        td { "#" (whole(&object["object"])) }
        td.words { (cause(object)) }
        td { (rounded(&object["range_m"], 2)) } td { (rounded(&object["radial_velocity_mps"], 3)) }
        td { (rounded(&object["x_m"], 2)) } td { (rounded(&object["y_m"], 2)) } td { (rounded(&object["snr_db"], 1)) }
        td { (rounded(&object["ghost_share"], 2)) }
    } }
}

/// The cause in words, with the bodies and bounces that it names.
fn cause(object: &Value) -> String {
    let bodies: Vec<&str> =
        object["bodies"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let (bodies, bounces) = (bodies.join(", "), object["bounces"].as_u64());
    match (object["cause"].as_str().unwrap_or("unknown"), bodies.as_str()) {
        ("ghost", _) => match bounces {
            Some(n) => format!("multipath ghost: {bodies}, {n} bounces"),
            None => format!("multipath ghost: {bodies}"),
        },
        ("clutter", "") => "clutter: the road's own backscatter".into(),
        ("clutter", _) => format!("clutter: {bodies}"),
        ("split", _) => format!("a further part of {bodies}, which has its object"),
        ("misplaced", _) => format!("echo of {bodies}, seen too far from it"),
        ("noise", _) => "noise".into(),
        _ => "not known".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_false_object_says_what_made_it() {
        let ghost = json!({ "object": 3, "cause": "ghost", "bodies": ["bus-1", "truck-1"], "bounces": 2, "ghost_share": null });
        let text = section(&json!({ "false_objects": [ghost] })).into_string();
        for said in ["#3", "multipath ghost: bus-1, truck-1, 2 bounces", "<td>–</td>"] {
            assert!(text.contains(said), "{said}: {text}");
        }
        assert!(section(&json!({ "false_objects": [] })).into_string().contains("None"));
        let rail = json!({ "object": 5, "cause": "clutter", "bodies": ["rail"], "bounces": 1 });
        let text = section(&json!({ "false_objects": [], "stationary_objects": [rail] })).into_string();
        assert!(
            text.contains("every object that moves is a body's") && text.contains("clutter: rail"),
            "{text}"
        );
        assert!(section(&json!({})).into_string().is_empty());
    }
}
