//! Check that the scene accepts a study's changes, made for every design before the first is computed.

use crate::study::axis::{Axis, AxisChoice};
use crate::study::designs::changes;
use crate::study::document::Study;
use crate::study::situations::Situation;
use artifact::envelope::fingerprint;
use artifact::scene::SceneHeader;
use artifact::settings::Fidelity;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use scene::{Change, MeshLoading, ReadOptions, Rule, SceneErrors};
use std::collections::BTreeMap;

/// Reads the scene of every design in the first situation and of the first design in all situations of the
/// first repeat, models unopened. A refusal names the study, the refused value with its place, and the
/// scene's own error.
pub(crate) fn check(
    study: &Study,
    designs: &[Vec<AxisChoice>],
    situations: &[Situation],
) -> Result<(), Failure> {
    try_scene(study, &[], MeshLoading::NamesOnly)
        .map_err(|errors| loading::scene_failure(errors).named_in(&study.page.file))?;
    let (Some(first), Some(situation)) = (designs.first(), situations.first()) else { return Ok(()) };
    designs.iter().try_for_each(|design| check_one(study, design, situation))?;
    situations.iter().try_for_each(|situation| check_one(study, first, situation))?;
    // A drawn sample may draw a listed value twice.
    if study.sample.is_some() { Ok(()) } else { differ(study, designs, situation) }
}

/// Refuses two designs with equal scenes: a value that is listed twice, or a key that the radar does not use.
/// Models are opened only for designs that are equal otherwise.
fn differ(study: &Study, designs: &[Vec<AxisChoice>], situation: &Situation) -> Result<(), Failure> {
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    let mut with_models: BTreeMap<String, usize> = BTreeMap::new();
    for (number, design) in designs.iter().enumerate() {
        let scene = |design: &[AxisChoice], meshes| scene_of(study, design, situation, meshes);
        let first = *known.entry(scene(design, MeshLoading::NamesOnly)?).or_insert(number);
        if first == number {
            continue;
        }
        with_models.entry(scene(&designs[first], MeshLoading::Whole)?).or_insert(first);
        if let Some(first) = with_models.insert(scene(design, MeshLoading::Whole)?, number) {
            return Err(alike(study, designs, [first, number]));
        }
    }
    Ok(())
}

/// Hash of a design's scene in every run of a study.
fn scene_of(
    study: &Study,
    design: &[AxisChoice],
    situation: &Situation,
    meshes: MeshLoading,
) -> Result<String, Failure> {
    let chosen = study.vary.iter().zip(design).chain(study.conditions.iter().zip(&situation.picks));
    let header = try_scene(study, &changes(chosen), meshes).map_err(loading::scene_failure)?;
    let fidelity = Fidelity { measured_every: 1, ..header.fidelity };
    Ok(fingerprint(&SceneHeader { fidelity, ..header }))
}

fn alike(study: &Study, designs: &[Vec<AxisChoice>], [first, second]: [usize; 2]) -> Failure {
    let [a, b] = [first, second].map(|number| &designs[number]);
    let other =
        |((axis, a), b): ((&Axis, &AxisChoice), &AxisChoice)| if a == b { None } else { axis.place_of(b) };
    let twice = |axis: &Axis| {
        let picks = axis.listed().unwrap_or_default();
        let number = (1..picks.len()).find(|number| picks[..*number].contains(&picks[*number]))?;
        axis.places.get(number).copied()
    };
    let place = study.vary.iter().zip(a).zip(b).find_map(other);
    let place = place.or_else(|| study.vary.iter().find_map(twice));
    let place = place.map_or_else(String::new, |place| format!(":{place}"));
    let values = |design: &[AxisChoice]| values(&study.vary.iter().zip(design).collect::<Vec<_>>());
    Failure::Refused(format!(
        "{}{place}: designs {first} and {second} are one scene: with {} it is what it is with {}",
        study.page.file.display(),
        values(b),
        values(a),
    ))
}

/// Reads the scene of a design in a situation; a refusal is like that of [`check`].
pub(crate) fn check_one(study: &Study, design: &[AxisChoice], situation: &Situation) -> Result<(), Failure> {
    let all = || study.vary.iter().zip(design).chain(study.conditions.iter().zip(&situation.picks));
    let refusal = |changes: &[Change]| {
        let errors = try_scene(study, changes, MeshLoading::NamesOnly).err()?;
        Some(unknown_list(study, changes).unwrap_or(errors))
    };
    let Some(errors) = refusal(&changes(all())) else { return Ok(()) };
    let alone = |chosen: &(_, _)| Some((*chosen, refusal(&changes(std::iter::once(*chosen)))?));
    Err(match all().find_map(|chosen| alone(&chosen)) {
        Some((chosen, errors)) => refused(study, &[chosen], &errors),
        None => refused(study, &all().collect::<Vec<_>>(), &errors),
    })
}

fn try_scene(study: &Study, changes: &[Change], meshes: MeshLoading) -> Result<SceneHeader, SceneErrors> {
    let options = ReadOptions { model: None, radar: study.radar.clone(), meshes };
    scene::read_changed(&study.scene, changes, &options)
}

/// The scene's errors about an unknown key before the number of an entry, which the scene takes for that of a
/// list that it omits: when a list under that key is requested, it reports the key with the most similar
/// spelling.
fn unknown_list(study: &Study, changes: &[Change]) -> Option<SceneErrors> {
    let is_number = |name: &str| !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_digit());
    let list_of = |change: &Change| {
        let names: Vec<&str> = change.key.split('.').collect();
        let count = names.iter().position(|name| is_number(name)).filter(|count| *count > 0)?;
        Some(Change { key: names[..count].join("."), value: "[]".to_owned() })
    };
    let is_unknown =
        |errors: &SceneErrors| errors.0.iter().any(|error| matches!(error.rule, Rule::UnknownKey { .. }));
    let refusal = |change| try_scene(study, &[change], MeshLoading::NamesOnly).err();
    changes.iter().filter_map(list_of).filter_map(refusal).find(is_unknown)
}

fn refused(study: &Study, chosen: &[(&Axis, &AxisChoice)], errors: &SceneErrors) -> Failure {
    let place = chosen.first().and_then(|(axis, pick)| axis.place_of(pick));
    let place = place.map_or_else(String::new, |place| format!(":{place}"));
    let values = values(chosen);
    let text = format!("{}{place}: with {values} the scene says:\n{errors}", study.page.file.display());
    if errors.is_system() { Failure::System(text) } else { Failure::Refused(text) }
}

/// Text of keys with their values.
fn values(chosen: &[(&Axis, &AxisChoice)]) -> String {
    let value = |(axis, pick): &(&Axis, &AxisChoice)| {
        let pairs = axis.keys.iter().zip(&pick.values);
        pairs.map(|(key, value)| format!("{key} = {value}")).collect::<Vec<_>>().join(", ")
    };
    chosen.iter().map(value).collect::<Vec<_>>().join(", ")
}
