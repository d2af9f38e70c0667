//! Tables under names given by the scene, and tables in lists.

use crate::document::errors::Place;
use crate::document::keys::materials::{LAYER, LAYERS, LAYERS_OF_ONE, MATERIAL};
use crate::document::keys::scene::MATERIALS_KEY;
use crate::document::keys::traffic::{MODEL, MODEL_OF_TYPE, MODELS};
use crate::document::section::{Section, SpannedValue};
use crate::document::values::ReadableKind;
use toml::Spanned;
use toml::de::{DeString, DeTable};

/// Models that vehicles of one type may have.
pub(crate) struct ModelChoice<'d> {
    /// The recording's vType.
    pub(crate) kind: &'d str,
    /// Names of the models, at least one.
    pub(crate) names: Vec<&'d str>,
    /// Further keys that apply to these models.
    pub(crate) section: Section<'d>,
}

/// The tables in a table whose keys are names of materials.
pub(crate) fn materials<'d>(root: &Section<'d>) -> Vec<(&'d str, Section<'d>)> {
    let Some(table) = named(root, MATERIALS_KEY.name, "a table of materials") else { return vec![] };
    let material = |(name, value): (&'d Spanned<DeString<'d>>, &'d SpannedValue<'d>)| {
        let name: &'d str = name.get_ref().as_ref();
        let section = root.subtable(&MATERIAL, Place::Material(name.to_owned()), value);
        if !section.exists() {
            section.wrong_type(
                "material",
                "a table such as { substance = \"glass\", thickness_mm = 5.0 }",
                value,
            );
        }
        section.exists().then_some((name, section))
    };
    table.iter().filter_map(material).collect()
}

/// Reads the `models` of recorded traffic: for each type a name, a list of names, or a table with more.
pub(crate) fn model_choices<'d>(traffic: &Section<'d>) -> Vec<ModelChoice<'d>> {
    let Some(table) = named(traffic, MODELS.name, "a table such as { car = \"car-suv\" }") else {
        return vec![];
    };
    let choice = |(kind, value): (&'d Spanned<DeString<'d>>, &'d SpannedValue<'d>)| {
        model_choice(traffic, kind.get_ref().as_ref(), value)
    };
    table.iter().filter_map(choice).collect()
}

fn model_choice<'d>(
    traffic: &Section<'d>,
    kind: &'d str,
    value: &'d SpannedValue<'d>,
) -> Option<ModelChoice<'d>> {
    let section = traffic.subtable(&MODEL_OF_TYPE, Place::Table(MODEL_OF_TYPE.name), value);
    let names = if section.exists() {
        section.require(MODEL.name);
        section.read(&MODEL)?
    } else {
        MODEL.takes.from(&section, MODEL.name, value)?
    };
    Some(ModelChoice { kind, names, section })
}

/// The tables of a list of layers, with the place of the material.
pub(crate) fn layers<'d>(material: &Section<'d>) -> Option<Vec<Section<'d>>> {
    let layer = |value: &'d SpannedValue<'d>| {
        if value.get_ref().as_table().is_none() {
            material.wrong_type(LAYERS.name, "a list of tables", value);
            return None;
        }
        Some(material.subtable(&LAYER, material.place().clone(), value))
    };
    let layers = material.list(LAYERS.name, material.find(LAYERS.name)?, LAYERS_OF_ONE)?;
    layers.iter().map(layer).collect()
}

/// The table of that name.
fn named<'d>(section: &Section<'d>, name: &'static str, expected: &'static str) -> Option<&'d DeTable<'d>> {
    let value = section.find(name)?;
    let table = value.get_ref().as_table();
    if table.is_none() {
        section.wrong_type(name, expected, value);
    }
    table
}
