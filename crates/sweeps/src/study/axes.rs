//! Axes of a study's file: `[[vary]]` and `[[condition]]`.

use crate::study::axis::{Axis, AxisChoice, Source};
use crate::study::fields::{Fields, Value, number};
use crate::study::study_text::Position;
use pipeline::host::failure::Failure;

/// Keys of an axis in the file.
pub(crate) const KEYS: [&str; 6] = ["key", "keys", "values", "labels", "draw", "name"];
/// Largest number of values of one axis.
const VALUES_LIMIT: usize = 10_000;

/// Reads one axis.
pub(crate) fn read(fields: &Fields<'_>) -> Result<Axis, Failure> {
    let keys = keys(fields)?;
    let name = match fields.text("name")? {
        Some(name) => name.to_owned(),
        None => keys.join(", "),
    };
    let source = match (fields.list("values")?, fields.table("draw", &["uniform", "whole"])?) {
        (Some(values), None) => listed(fields, &keys, &values)?,
        (None, Some(draw)) => drawn(&draw)?,
        _ => return Err(fields.refused_whole("one of `values` and `draw` has to be given")),
    };
    if fields.value("labels").is_some() && !matches!(source, Source::Listed(_)) {
        return Err(fields.refused_whole("`labels` are of listed `values`"));
    }
    Ok(Axis { places: places(fields), name, keys, source })
}

/// Places of the listed values, or of the draw.
fn places(fields: &Fields<'_>) -> Vec<Position> {
    let listed = fields.value("values").and_then(|values| values.get_ref().as_array());
    let all = listed.into_iter().flatten().chain(fields.value("draw"));
    all.map(|value| fields.page.position(value.span().start)).collect()
}

/// Reads one key from `key`, or several that change together from `keys`.
fn keys(fields: &Fields<'_>) -> Result<Vec<String>, Failure> {
    match (fields.text("key")?, fields.list("keys")?) {
        (Some(key), None) => Ok(vec![key.to_owned()]),
        (None, Some(keys)) if !keys.is_empty() => texts(fields, "keys", &keys),
        _ => Err(fields.refused_whole("one of `key` and `keys` has to be given")),
    }
}

fn texts(fields: &Fields<'_>, key: &str, values: &[&Value<'_>]) -> Result<Vec<String>, Failure> {
    let text = |value: &&Value<'_>| {
        let refused = || fields.refused(value.span().start, &format!("`{key}` has to be a list of texts"));
        value.get_ref().as_str().map(str::to_owned).ok_or_else(refused)
    };
    values.iter().map(text).collect()
}

fn listed(fields: &Fields<'_>, keys: &[String], values: &[&Value<'_>]) -> Result<Source, Failure> {
    if !(1..=VALUES_LIMIT).contains(&values.len()) {
        let rule = format!("`values` has to be a list of 1 to {VALUES_LIMIT} values, has {}", values.len());
        return Err(fields.refused_whole(&rule));
    }
    let is_alone = fields.value("key").is_some();
    let each = |value: &&Value<'_>| match is_alone {
        true => Ok(vec![fields.written(value)]),
        false => group(fields, keys, value),
    };
    let groups = values.iter().map(each).collect::<Result<Vec<_>, _>>()?;
    let labels = labels(fields, &groups)?;
    let pick = |(label, values): (String, Vec<String>)| AxisChoice { label, values };
    Ok(Source::Listed(labels.into_iter().zip(groups).map(pick).collect()))
}

/// Values of keys that change together: a list with one for each key.
fn group(fields: &Fields<'_>, keys: &[String], value: &Value<'_>) -> Result<Vec<String>, Failure> {
    let all = value.get_ref().as_array().filter(|all| all.len() == keys.len());
    let rule =
        || format!("each of `values` has to be a list of {} values, one for each of `keys`", keys.len());
    let all = all.ok_or_else(|| fields.refused(value.span().start, &rule()))?;
    Ok(all.iter().map(|value| fields.written(value)).collect())
}

/// The file's `labels`, or the values as written.
fn labels(fields: &Fields<'_>, groups: &[Vec<String>]) -> Result<Vec<String>, Failure> {
    let Some(labels) = fields.list("labels")? else {
        let text = |values: &Vec<String>| values.join(" ").replace('"', "");
        return Ok(groups.iter().map(text).collect());
    };
    if labels.len() != groups.len() {
        let rule =
            format!("`labels` has to have one for each of {} `values`, has {}", groups.len(), labels.len());
        return Err(fields.refused_whole(&rule));
    }
    let texts = texts(fields, "labels", &labels)?;
    let twice = (1..texts.len()).find(|number| texts[..*number].contains(&texts[*number]));
    let refused = |number: usize| {
        let rule = format!("`labels` has `{}` twice: the two could not be told apart", texts[number]);
        fields.refused(labels[number].span().start, &rule)
    };
    twice.map_or(Ok(()), |number| Err(refused(number)))?;
    Ok(texts)
}

fn drawn(draw: &Fields<'_>) -> Result<Source, Failure> {
    let wanted = "`draw` has to be one of { uniform = [least, greatest] } and { whole = [least, greatest] }, \
                  with the least below the greatest";
    let refused = || draw.refused_whole(wanted);
    match (draw.list("uniform")?, draw.list("whole")?) {
        (Some(ends), None) => Ok(Source::Uniform(ends_of(&ends).ok_or_else(refused)?)),
        (None, Some(ends)) => {
            let [low, high] = ends_of(&ends).ok_or_else(refused)?;
            let is_whole = |end: f64| end.fract() == 0.0 && end.abs() < 1e15;
            let is_right = is_whole(low) && is_whole(high);
            is_right.then_some(Source::Whole([low as i64, high as i64])).ok_or_else(refused)
        }
        _ => Err(refused()),
    }
}

fn ends_of(ends: &[&Value<'_>]) -> Option<[f64; 2]> {
    let [low, high] = ends else { return None };
    let ends = [number(low.get_ref())?, number(high.get_ref())?];
    (ends[0] < ends[1]).then_some(ends)
}
