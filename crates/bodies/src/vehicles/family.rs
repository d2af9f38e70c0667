//! Families: rows of readable tables, and the values drawn from them by a seed.
//!
//! A class has one table (`crates/bodies/vehicles/CLASS.toml`); a section of it is one family, `[default]`
//! the common part. A number is a fixed value, `[low, high]` a uniform draw with its middle as the nominal
//! value, a list of words a choice with the first as the nominal word. Under a key for the presence of
//! something, a number is its probability.
//!
//! `car-kei+pickup` is a cross: a kei car whose numbers are half way to those of a pick-up ([`crosses`]).

mod crosses; // half way between two families

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};
use artifact::settings::Class;
use std::borrow::Cow;
use std::sync::LazyLock;
use toml::{Table, Value};

/// One family of a class.
#[derive(Debug, Clone)]
pub(crate) struct Family {
    pub(crate) name: String,
    pub(crate) class: Class,
    values: Table,
}

/// All families, class by class in the order of their names.
static FAMILIES: LazyLock<Vec<Family>> = LazyLock::new(|| {
    let tables = [
        (Class::Car, include_str!("../../vehicles/car.toml")),
        (Class::Bus, include_str!("../../vehicles/bus.toml")),
        (Class::Truck, include_str!("../../vehicles/truck.toml")),
        (Class::Motorcycle, include_str!("../../vehicles/motorcycle.toml")),
    ];
    tables.into_iter().flat_map(|(class, text)| families(class, text)).collect()
});

/// Families of a table; an invalid table has no families, which a test would detect.
fn families(class: Class, text: &str) -> Vec<Family> {
    let table: Table = text.parse().unwrap_or_default();
    let section = |name: &str| table.get(name).and_then(Value::as_table);
    let family = |name: &String| {
        let mut values = section("default").cloned().unwrap_or_default();
        values.extend(section(name)?.clone());
        Some(Family { name: format!("{}-{name}", class.name()), class, values })
    };
    table.keys().filter(|name| *name != "default").filter_map(family).collect()
}

/// All families.
pub(crate) fn all() -> &'static [Family] {
    &FAMILIES
}

/// The family with that name, or the cross of two families of one build.
pub(crate) fn find(name: &str) -> Option<Cow<'static, Family>> {
    if let Some(family) = written(name) {
        return Some(Cow::Borrowed(family));
    }
    let [first, second] = of_cross(name)?;
    let values = crosses::half_way(&first.values, &second.values)?;
    Some(Cow::Owned(Family { name: name.to_owned(), class: first.class, values }))
}

fn written(name: &str) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.name == name)
}

/// The two families in the name of a cross, whether they are of one build or not.
pub(crate) fn of_cross(name: &str) -> Option<[&'static Family; 2]> {
    let (first, second) = name.split_once(crosses::SIGN)?;
    let first = written(first)?;
    let second = written(&format!("{}-{second}", first.class.name())).filter(|s| s.name != first.name)?;
    Some([first, second])
}

/// Names of all crosses of a class: each family with each other one of its build, in order.
pub(crate) fn crosses_of(class: Class) -> Vec<String> {
    let of_class: Vec<&Family> = FAMILIES.iter().filter(|family| family.class == class).collect();
    let named = |[first, second]: [&&Family; 2]| {
        let second = second.name.split_once('-').map(|(_, second)| second)?;
        let name = format!("{}{}{second}", first.name, crosses::SIGN);
        find(&name).map(|_| name)
    };
    let pairs = of_class.iter().flat_map(|first| of_class.iter().map(move |second| [first, second]));
    pairs.filter_map(named).collect()
}

impl Family {
    /// Values that a seed draws for the family.
    pub(crate) fn parameters(&self, seed: u64) -> Parameters<'_> {
        Parameters {
            sampler: ParameterSampler { model: &self.name, seed },
            table: &self.values,
            scope: String::new(),
        }
    }

    /// Overall dimensions for all seeds; the lower limit for a two-wheeler without rider is `bare_height_m`.
    pub(crate) fn size_range(&self) -> SizeRange {
        let range = |key: &str| self.values.get(key).map(bounds);
        let height = range("height_m").unwrap_or([f64::NAN; 2]);
        let low = range("bare_height_m").map_or(height[0], |bare| bare[0]);
        let [length, width] = ["length_m", "width_m"].map(|key| range(key).unwrap_or([f64::NAN; 2]));
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let nominal_m = [middle(length), middle(width), middle(height)];
        SizeRange { nominal_m, range_m: [length, width, [low, height[1]]] }
    }
}

/// Parameters of one vehicle: a table and the seed for its draws.
#[derive(Debug, Clone)]
pub(crate) struct Parameters<'a> {
    sampler: ParameterSampler<'a>,
    table: &'a Table,
    /// Path of this table in the family's, so that equal keys of two parts are drawn independently.
    scope: String,
}

impl<'a> Parameters<'a> {
    /// Nominal length, width and height, and the drawn ones.
    pub(crate) fn sizes_m(&self) -> [[f64; 3]; 2] {
        let bare = self.table.contains_key("bare_height_m") && !self.has("rider");
        let keys = ["length_m", "width_m", if bare { "bare_height_m" } else { "height_m" }];
        [keys.map(|key| self.middle(key)), keys.map(|key| self.number(key))]
    }

    fn middle(&self, key: &str) -> f64 {
        self.table.get(key).map_or(f64::NAN, |value| 0.5 * (bounds(value)[0] + bounds(value)[1]))
    }

    /// A number; NaN if the table has none, which all tests of meshes reject.
    pub(crate) fn number(&self, key: &str) -> f64 {
        self.table.get(key).map_or(f64::NAN, |value| self.value(key, value))
    }

    /// A number, or a default if the table has none.
    pub(crate) fn number_or(&self, key: &str, otherwise: f64) -> f64 {
        if self.table.contains_key(key) { self.number(key) } else { otherwise }
    }

    /// Several numbers, each drawn independently.
    pub(crate) fn numbers<const N: usize>(&self, key: &str) -> [f64; N] {
        let written = self.list(key);
        std::array::from_fn(|k| {
            written.get(k).map_or(f64::NAN, |value| self.value(&format!("{key} {k}"), value))
        })
    }

    /// A list of rows of numbers, each drawn independently.
    pub(crate) fn rows<const N: usize>(&self, key: &str) -> Vec<[f64; N]> {
        let number = |row: &Value, k: usize, n: usize| {
            let written = row.as_array().and_then(|row| row.get(n));
            written.map_or(f64::NAN, |value| self.value(&format!("{key} {k} {n}"), value))
        };
        self.list(key).iter().enumerate().map(|(k, row)| std::array::from_fn(|n| number(row, k, n))).collect()
    }

    /// Whether an optional part is present.
    pub(crate) fn has(&self, key: &str) -> bool {
        match self.table.get(key) {
            Some(Value::Boolean(there)) => *there,
            Some(chance) => self.fraction(key) < bounds(chance)[0],
            None => false,
        }
    }

    /// A word: the given one, or one of a list; empty if there is none.
    pub(crate) fn word(&self, key: &str) -> &'a str {
        match self.table.get(key) {
            Some(Value::String(word)) => word,
            Some(Value::Array(words)) if !words.is_empty() => {
                let last = words.len() - 1;
                let drawn =
                    if self.sampler.seed == 0 { 0.0 } else { self.fraction(key) * words.len() as f64 };
                words[(drawn as usize).min(last)].as_str().unwrap_or_default()
            }
            _ => "",
        }
    }

    /// The tables in a list, with the same seed.
    pub(crate) fn tables(&self, key: &str) -> Vec<Parameters<'a>> {
        let inner = |(k, value): (usize, &'a Value)| {
            let table = value.as_table()?;
            Some(Parameters { sampler: self.sampler, table, scope: format!("{}{key} {k}/", self.scope) })
        };
        self.list(key).iter().enumerate().filter_map(inner).collect()
    }

    /// Whether the table has the key.
    pub(crate) fn has_key(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    fn list(&self, key: &str) -> &'a [Value] {
        self.table.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    /// Draw from 0 to 1: just under a half for seed 0, so that likely parts are nominal.
    fn fraction(&self, key: &str) -> f64 {
        self.sampler.value(&format!("{}{key}", self.scope), 0.499, 0.0..=1.0)
    }

    fn value(&self, key: &str, written: &Value) -> f64 {
        let [low, high] = bounds(written);
        self.sampler.value(&format!("{}{key}", self.scope), 0.5 * (low + high), low..=high)
    }
}

/// Both bounds of a value: a number twice, or the given two.
fn bounds(value: &Value) -> [f64; 2] {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    match value {
        Value::Array(pair) if pair.len() == 2 => [0, 1].map(|k| number(&pair[k]).unwrap_or(f64::NAN)),
        one => [number(one).unwrap_or(f64::NAN); 2],
    }
}
