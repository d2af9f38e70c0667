//! The JSON Schema of scene files (draft 7), by which editors complete, explain and check them.

use crate::document::keys::TABLES;
use crate::document::keys::key::{Entry, Table};
use crate::document::keys::scene::SCENE;
use serde_json::{Map, Value, json};

/// The schema of scene files. The reader refuses every scene that the schema refuses, and also checks rules
/// between keys, which the schema lacks.
pub fn json_schema() -> Value {
    let below = TABLES.iter().filter(|table| !table.name.is_empty());
    let definitions: Map<String, Value> = below.map(|table| (table.name.to_owned(), object(table))).collect();
    let mut schema = object(&SCENE);
    schema["$schema"] = "http://json-schema.org/draft-07/schema#".into();
    schema["title"] = "Scene of Wayside".into();
    schema["definitions"] = definitions.into();
    schema
}

fn object(table: &Table) -> Value {
    let properties: Map<String, Value> =
        table.keys.iter().map(|key| (key.name().to_owned(), property(*key))).collect();
    let required: Vec<&str> =
        table.keys.iter().filter(|key| key.is_required()).map(|key| key.name()).collect();
    json!({
        "title": table.heading,
        "description": table.about,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

/// Schema of a key. A reference has no siblings, as draft 7 requires: its table describes it.
fn property(key: &dyn Entry) -> Value {
    let mut schema = key.values();
    if schema.get("$ref").is_some() {
        return schema;
    }
    if schema.get("description").is_none() {
        schema["description"] = description(key).into();
    }
    if let Some(default) = key.default() {
        schema["default"] = default;
    }
    schema
}

/// Text of the page's row, without the targets of its links.
fn description(key: &dyn Entry) -> String {
    let [default, allowed, meaning] = key.cells();
    let said = |label: &str, text: &str| match text {
        "" | "–" | "required" => String::new(),
        text => format!("\n\n{label}: {text}"),
    };
    unlinked(&meaning).trim().to_owned() + &said("Allowed", &allowed) + &said("Default", &default)
}

/// Turns `[label](target)` into `label`.
fn unlinked(text: &str) -> String {
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |told, rest| {
        let (before, label) = told.rsplit_once('[').unwrap_or(("", &told));
        let after = rest.split_once(')').map_or(rest, |(_, after)| after);
        format!("{before}{label}{after}")
    })
}
