//! Whether the scene takes what a study changes: asked of every design before the first is computed.

use crate::study::axis::{Axis, Pick};
use crate::study::designs::changes;
use crate::study::document::Study;
use crate::study::situations::Situation;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use scene::{Change, Meshes, ReadOptions, SceneErrors};

/// Reads the scene of every design in the first situation and of the first design in all situations of the
/// first repeat, models unopened. A refusal names the study, the value that is refused with its place, and
/// the scene's own sentence.
pub(crate) fn check(study: &Study, designs: &[Vec<Pick>], situations: &[Situation]) -> Result<(), Failure> {
    try_scene(study, &[]).map_err(|errors| loading::of_scene(errors).named_in(&study.page.file))?;
    let (Some(first), Some(situation)) = (designs.first(), situations.first()) else { return Ok(()) };
    designs.iter().try_for_each(|design| check_one(study, design, situation))?;
    situations.iter().try_for_each(|situation| check_one(study, first, situation))
}

fn check_one(study: &Study, design: &[Pick], situation: &Situation) -> Result<(), Failure> {
    let all = || study.vary.iter().zip(design).chain(study.conditions.iter().zip(&situation.picks));
    let Err(errors) = try_scene(study, &changes(all())) else { return Ok(()) };
    let alone =
        |chosen: &(_, _)| Some((*chosen, try_scene(study, &changes(std::iter::once(*chosen))).err()?));
    Err(match all().find_map(|chosen| alone(&chosen)) {
        Some((chosen, errors)) => refused(study, &[chosen], &errors),
        None => refused(study, &all().collect::<Vec<_>>(), &errors),
    })
}

fn try_scene(study: &Study, changes: &[Change]) -> Result<(), SceneErrors> {
    let options = ReadOptions { model: None, radar: study.radar.clone(), meshes: Meshes::NamesOnly };
    scene::read_changed(&study.scene, changes, &options).map(drop)
}

fn refused(study: &Study, chosen: &[(&Axis, &Pick)], errors: &SceneErrors) -> Failure {
    let place = chosen.first().and_then(|(axis, pick)| axis.place_of(pick));
    let place = place.map_or_else(String::new, |place| format!(":{place}"));
    let value = |(axis, pick): &(&Axis, &Pick)| {
        let pairs = axis.keys.iter().zip(&pick.values);
        pairs.map(|(key, value)| format!("{key} = {value}")).collect::<Vec<_>>().join(", ")
    };
    let values = chosen.iter().map(value).collect::<Vec<_>>().join(", ");
    let text = format!("{}{place}: with {values} the scene says:\n{errors}", study.page.file.display());
    if errors.is_system() { Failure::System(text) } else { Failure::Refused(text) }
}
