//! Crosses of two families: built like the first, in proportions half way to the second.
//!
//! A hundred families are few shapes for training; each two of a class yield a third that is in no table.

use toml::{Table, Value};

/// Separator in the names of a cross, after the class: `car-kei+pickup`.
pub(crate) const SIGN: char = '+';

/// Key of a family's solids, in the metres of its own drawing: they are not crossed.
const SOLIDS: &str = "part";
/// Depths of optional parts (`flaps`): they come with the probability, from whichever family has it.
const OF_CHANCES: [&str; 1] = ["flap_depth_m"];
/// Largest relative difference in length, width and height between a family with solids and those that it is
/// crossed with, so that its solids stay in place.
const NEAR: f64 = 0.25;

/// Values of the first family, with each common number half way to the second's. Words, and lists of
/// different lengths, are the first's. `None` for families of different builds, or if the solids would be
/// outside the body.
pub(crate) fn half_way(first: &Table, second: &Table) -> Option<Table> {
    (build(first) == build(second) && keeps_solids(first, second)).then(|| crossed(first, second))
}

fn keeps_solids(first: &Table, second: &Table) -> bool {
    let middle = |values: &Table, key: &str| values.get(key).map_or(f64::NAN, middle);
    let is_near = |key: &str| (middle(second, key) / middle(first, key) - 1.0).abs() <= NEAR;
    !first.contains_key(SOLIDS) || ["length_m", "width_m", "height_m"].into_iter().all(is_near)
}

fn middle(span: &Value) -> f64 {
    match span {
        Value::Array(bounds) => bounds.iter().filter_map(number_of).sum::<f64>() / bounds.len() as f64,
        number => number_of(number).unwrap_or(f64::NAN),
    }
}

/// Keys that define the build: a front or rear up to the roof, one body or cab and load, a semitrailer, its
/// load; a two-wheeler with a frame and an engine in it, or a scooter.
const BUILD: [&str; 7] =
    ["front_upright", "rear_upright", "unibody", "semitrailer", "carries", "frame", "engine"];

fn build(values: &Table) -> [Option<&Value>; 7] {
    BUILD.map(|key| values.get(key).filter(|value| **value != Value::Boolean(false)))
}

fn crossed(first: &Table, second: &Table) -> Table {
    let other = |key: &str| second.get(key).filter(|_| key != SOLIDS);
    let one = |(key, value): (&String, &Value)| {
        (key.clone(), other(key).map_or_else(|| value.clone(), |other| between(value, other)))
    };
    let brought = OF_CHANCES.into_iter().filter(|key| !first.contains_key(*key));
    let brought = brought.filter_map(|key| Some((key.to_owned(), second.get(key)?.clone())));
    first.iter().map(one).chain(brought).collect()
}

fn between(first: &Value, second: &Value) -> Value {
    match (first, second) {
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            Value::Array(a.iter().zip(b).map(|(a, b)| between(a, b)).collect())
        }
        // A number is a span of zero width.
        (Value::Array(span), number) if span.len() == 2 && number_of(number).is_some() => {
            Value::Array(span.iter().map(|bound| between(bound, number)).collect())
        }
        (number, Value::Array(span)) if span.len() == 2 && number_of(number).is_some() => {
            Value::Array(span.iter().map(|bound| between(number, bound)).collect())
        }
        _ => mean(first, second).map_or_else(|| first.clone(), Value::Float),
    }
}

fn mean(first: &Value, second: &Value) -> Option<f64> {
    Some(0.5 * (number_of(first)? + number_of(second)?))
}

fn number_of(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_spans_lie_half_way_and_all_else_is_the_firsts() {
        let first =
            "a = 1\nb = [1, 3]\nc = [[1, 2], 4]\nword = \"cast\"\nlist = [1, 2, 3]\nown = 7\nthere = true";
        let second =
            "a = [2, 4]\nb = 5.0\nc = [[3, 4], [4, 8]]\nword = \"steel\"\nlist = [1, 2]\nthere = 0.5";
        let half = "a = [1.5, 2.5]\nb = [3.0, 4.0]\nc = [[2.0, 3.0], [4.0, 6.0]]\nword = \"cast\"\nlist = [1, 2, 3]\n\
                    own = 7\nthere = true";
        let table = |text: &str| text.parse::<Table>().unwrap();
        assert_eq!(crossed(&table(first), &table(second)), table(half));
    }

    #[test]
    fn what_only_the_second_may_have_brings_its_depth() {
        let table = |text: &str| text.parse::<Table>().unwrap();
        let first = table("flaps = 0");
        let second = table("flaps = 0.4\nflap_depth_m = [0.005, 0.03]\npane_pitch_m = 1");
        assert_eq!(crossed(&first, &second), table("flaps = 0.2\nflap_depth_m = [0.005, 0.03]"));
    }
}
