//! `manifest.toml` of a folder of vehicles: the name and the class of each; the file may say more.

use crate::dataset::recipe::error::RecipeError;
use crate::dataset::recipe::keys::{
    LISTED, LISTED_CLASS, LISTED_NAME, MANIFEST, MANIFEST_TABLES, VEHICLE_KEY,
};
use artifact::bounded;
use artifact::settings::Class;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use scene::document::diagnostics::Diagnostics;
use scene::document::section::Section;
use std::path::Path;

/// A manifest of a thousand vehicles, with all that is told of each.
const LIMIT_BYTES: u64 = 16 << 20;

/// A vehicle that a manifest lists.
#[derive(Debug, PartialEq)]
pub(super) struct ManifestVehicle {
    /// Name of its `.glb` without the ending.
    pub(super) name: String,
    pub(super) class: Class,
}

/// Reads the vehicles of a manifest; every rule that it breaks is told, not only the first.
pub(super) fn read(file: &Path) -> Result<Vec<ManifestVehicle>, Failure> {
    let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    of_text(file, &text)
}

fn of_text(file: &Path, text: &str) -> Result<Vec<ManifestVehicle>, Failure> {
    let faults = Diagnostics::allowing_unknown_keys(file, text, MANIFEST_TABLES);
    let document = faults.document();
    let root = Section::root(&document, &MANIFEST, &faults);
    root.require(VEHICLE_KEY.name);
    let vehicles = root.sections(&LISTED).iter().filter_map(vehicle).collect();
    drop(root);
    faults.into_errors().map_err(loading::scene_failure)?;
    Ok(vehicles)
}

fn vehicle(listed: &Section<'_>) -> Option<ManifestVehicle> {
    listed.require(LISTED_NAME.name);
    listed.require(LISTED_CLASS.name);
    let (name, class) = (listed.read(&LISTED_NAME), listed.read(&LISTED_CLASS));
    if let Some(other) = name.filter(|name| !is_of_a_file(name)) {
        listed.note(LISTED_NAME.name, RecipeError::NameOfNoFile { name: other.to_owned() }.into());
    }
    Some(ManifestVehicle { name: name?.to_owned(), class: class? })
}

/// Whether it is the name of a file alone, which leads nowhere else.
fn is_of_a_file(name: &str) -> bool {
    Path::new(name).file_name().is_some_and(|own| own == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_may_say_more_of_its_vehicles_than_is_read() {
        let text = "made_by = \"us\"\n[[vehicle]]\nname = \"a\"\nclass = \"car\"\nclasses = 4\n\
                    length_m = 4.2\n[[vehicle.part]]\nname = 3\n";
        let found = of_text(Path::new("m.toml"), text).unwrap();
        assert_eq!(found, [ManifestVehicle { name: "a".into(), class: Class::Car }]);
    }

    #[test]
    fn every_rule_that_a_manifest_breaks_is_told_at_its_place_with_the_nearest_key() {
        let text = "[[vehicle]]\nname = \"a\"\nclas = \"car\"\nlicence = \"MIT\"\n[[vehicle]]\n\
                    name = \"../x\"\nclass = \"lorry\"\n[[vehicle]]\nname = 3\nclass = \"bus\"\n";
        let refused = of_text(Path::new("m.toml"), text).unwrap_err();
        assert!(matches!(refused, Failure::Refused(_)), "{refused}");
        let told = refused.to_string();
        let broken = [
            "m.toml:1:1: [vehicle]: key `class` is missing",
            "m.toml:3:1: [vehicle]: unknown key `clas`; the nearest is `class`",
            "m.toml:6:8: [vehicle]: `name` must be that of a .glb in this folder",
            "m.toml:7:9: [vehicle]: `class` cannot be `lorry`; it can be `car`",
            "m.toml:9:8: [vehicle]: `name` must be a text in quotes, is a whole number",
        ];
        assert_eq!(told.lines().count(), broken.len(), "{told}");
        for (line, said) in told.lines().zip(broken) {
            assert!(line.starts_with(said), "{line}\nnot: {said}");
        }
    }

    #[test]
    fn a_manifest_without_vehicles_names_the_key_that_is_meant() {
        let refused = |text: &str| of_text(Path::new("m.toml"), text).unwrap_err().to_string();
        let told = refused("[[vehicles]]\nname = \"a\"\nclass = \"car\"\n");
        assert!(told.contains("m.toml:1:1: key `vehicle` is missing"), "{told}");
        assert!(told.contains("unknown key `vehicles`; the nearest is `vehicle`"), "{told}");
        assert!(refused("[[vehicle]\n").contains("m.toml:1:"), "its text is no TOML");
    }
}
