//! `[[radars]]`: several radars in one scene. Each inherits from `[radar]` and specifies its differences; a
//! scene is read for one of them.

use crate::document::diagnostics::Diagnostics;
use crate::document::errors::{Rule, SceneErrors};
use crate::document::ids::read_ids;
use crate::document::keys::radar::{ID, RADAR, RADARS};
use crate::document::keys::scene::{NAME, RADAR_KEY, RADARS_KEY};
use crate::document::section::Section;
use crate::document::text::{read_text, without_position};
use std::borrow::Cow;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Names of the radars of the scene in `path`, in order; none if there is only `[radar]`.
/// [`read`](crate::read()) reports their faults.
///
/// # Errors
/// The file cannot be read, or is not text.
pub fn radars(path: &Path) -> Result<Vec<String>, SceneErrors> {
    let text = read_text(path).map_err(|rule| without_position(path, rule))?;
    let document = Diagnostics::new(path, &text).document();
    Ok(entries(&document).filter_map(|(_, entry)| id_of(entry)).map(str::to_owned).collect())
}

/// The document for one of its radars: `[radar]` overridden, table by table, by the entry with that `id`;
/// unchanged without such an entry.
pub(crate) fn select_radar<'a, 'd>(document: &'a DeTable<'d>, id: Option<&str>) -> Cow<'a, DeTable<'d>> {
    let Some((value, entry)) = entries(document).find(|(_, entry)| id.is_some() && id_of(entry) == id) else {
        return Cow::Borrowed(document);
    };
    // Keys that no radar has are noted of the entry itself.
    let of_radar = entry.iter().filter(|(key, _)| RADAR.has(key.get_ref()));
    let own: DeTable<'d> = of_radar.map(|(key, value)| (key.clone(), value.clone())).collect();
    let mut merged = document.clone();
    let none_yet = || Spanned::new(value.span(), DeValue::Table(DeTable::new()));
    let radar = merged.entry(Spanned::new(value.span(), RADAR_KEY.name.into())).or_insert_with(none_yet);
    if let DeValue::Table(radar) = radar.get_mut() {
        merge(radar, own);
    }
    Cow::Owned(merged)
}

/// The scene's name, followed by that of the selected radar. Notes radars without a name or with a duplicate
/// one, a selected one that does not exist, and a missing selection among several.
pub(crate) fn read_name(root: &Section<'_>, asked: Option<&str>) -> String {
    root.require(NAME.name);
    let name = root.read(&NAME).unwrap_or_default();
    let sections = root.sections(&RADARS);
    let known: Vec<String> = read_ids(&sections).into_iter().flatten().map(str::to_owned).collect();
    match asked {
        None if !sections.is_empty() => root.note(RADARS_KEY.name, Rule::WhichRadar { known }),
        Some(asked) if !known.iter().any(|id| id == asked) => {
            root.note(RADARS_KEY.name, Rule::UnknownRadar { found: asked.to_owned(), known });
        }
        _ => {}
    }
    asked.map_or_else(|| name.to_owned(), |radar| format!("{name}/{radar}"))
}

fn entries<'a, 'd>(
    document: &'a DeTable<'d>,
) -> impl Iterator<Item = (&'a Spanned<DeValue<'d>>, &'a DeTable<'d>)> {
    let array = document.get(RADARS_KEY.name).and_then(|value| value.get_ref().as_array());
    array.into_iter().flatten().filter_map(|value| Some((value, value.get_ref().as_table()?)))
}

fn id_of<'a>(entry: &'a DeTable<'_>) -> Option<&'a str> {
    entry.get(ID.name)?.get_ref().as_str()
}

/// Merges tables; all other values are replaced.
fn merge<'d>(into: &mut DeTable<'d>, from: DeTable<'d>) {
    for (key, value) in from {
        let known = into.get_mut(&key).map(Spanned::get_mut);
        if let (Some(DeValue::Table(known)), DeValue::Table(own)) = (known, value.get_ref()) {
            merge(known, own.clone());
        } else {
            into.insert(key, value);
        }
    }
}
