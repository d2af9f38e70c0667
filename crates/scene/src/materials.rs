//! `[materials]`, files of them, and `[road]`: names of materials, and what they stand for.

use crate::document::entries::{layers, materials};
use crate::document::errors::{Rule, SceneErrors};
use crate::document::faults::Faults;
use crate::document::keys::fidelity::{MATERIALS, TRANSMISSION};
use crate::document::keys::materials::{
    BACKING, BACKSCATTER, COHERENT, GAMMA, Ground, LAYERS, MIRROR, Mirror, PERMITTIVITY, RMS_HEIGHT, ROAD,
    ROAD_SUBSTANCE, SUBSTANCE, THICKNESS,
};
use crate::document::keys::scene::{MATERIAL_FILE, OF_MATERIALS};
use crate::document::section::Section;
use crate::document::text::{at_no_place, read_text};
use crate::models::library::Models;
use crate::wording::likeness::nearest;
use artifact::material::{Layer, Material, MaterialMap, Road, Thickness, Transmission};
use artifact::permittivity::{SUBSTANCES, substance};
use artifact::radar::{Polarization, Radar};
use artifact::scene::Backscatter;
use artifact::settings::EchoMode;
use artifact::units::power_from_db;
use num_complex::Complex64;
use std::path::Path;

/// The materials in a file of the form of a scene's `[materials]`; whether waves pass sheets is not for it to
/// say.
///
/// # Errors
/// Every broken rule with line and column; `is_system` tells a file that is missing or unreadable.
pub fn read_materials(path: &Path) -> Result<MaterialMap, SceneErrors> {
    let text = read_text(path).map_err(|rule| at_no_place(path, rule))?;
    let faults = Faults::new(path, &text);
    let document = faults.document();
    let root = Section::root(&document, &MATERIAL_FILE, &faults);
    root.require(OF_MATERIALS.name);
    let by_name = by_name(&root);
    drop(root);
    faults.into_errors().map(|()| MaterialMap { by_name, transmission: Transmission::Ignored })
}

/// Reads a scene's materials, from a table of its own or a file, and whether waves pass through them.
pub(crate) fn read_scene_materials(
    root: &Section<'_>,
    fidelity: &Section<'_>,
    models: &mut Models,
) -> MaterialMap {
    let transmission = fidelity.or_default(&TRANSMISSION);
    let by_name = match fidelity.read(&MATERIALS) {
        Some(_) if root.has(OF_MATERIALS.name) => {
            let key = MATERIALS.name;
            fidelity.note(key, Rule::Contradiction { key, other: "[materials]" });
            vec![]
        }
        Some(written) => from_file(fidelity, &models.file_beside(written)),
        None => by_name(root),
    };
    MaterialMap { by_name, transmission }
}

fn from_file(fidelity: &Section<'_>, path: &Path) -> Vec<(String, Material)> {
    read_materials(path).map(|map| map.by_name).unwrap_or_else(|errors| {
        fidelity.note(MATERIALS.name, Rule::Materials(errors));
        vec![]
    })
}

fn by_name(root: &Section<'_>) -> Vec<(String, Material)> {
    materials(root)
        .iter()
        .filter_map(|(name, section)| Some(((*name).to_owned(), read_material(section)?)))
        .collect()
}

/// The road as a mirror and what it sends back of itself; `None` where the scene has none of it.
pub(crate) fn read_road(
    root: &Section<'_>,
    radar: &Radar,
    echo: EchoMode,
) -> (Option<Road>, Option<Backscatter>) {
    let section = root.section(&ROAD);
    if !section.exists() {
        return (None, None);
    }
    (read_mirror(&section), read_backscatter(&section, radar, echo))
}

fn read_mirror(section: &Section<'_>) -> Option<Road> {
    if section.or_default(&MIRROR) == Mirror::Off {
        let of_mirrors = [SUBSTANCE.name, PERMITTIVITY.name, RMS_HEIGHT.name];
        for key in of_mirrors.into_iter().filter(|key| section.has(key)) {
            section.note(key, Rule::Misplaced { key, owner: "a road that is no mirror" });
        }
        return None;
    }
    let named = section.has(SUBSTANCE.name) || section.has(PERMITTIVITY.name);
    let of_asphalt = || substance(ROAD_SUBSTANCE.absent.0).and_then(|asphalt| asphalt.permittivity);
    let permittivity = if named { read_permittivity(section)? } else { of_asphalt() };
    let material =
        permittivity.map_or(Material::Conductor, |permittivity| Material::HalfSpace { permittivity });
    Some(Road { material, rms_height_m: 1e-3 * section.or_default(&RMS_HEIGHT) })
}

fn read_backscatter(section: &Section<'_>, radar: &Radar, echo: EchoMode) -> Option<Backscatter> {
    let ground = section.or_default(&BACKSCATTER);
    let gamma_db = section.or_default(&GAMMA);
    if ground == Ground::Off {
        if section.has(GAMMA.name) {
            let companion = "backscatter = \"floor\"";
            section.note(GAMMA.name, Rule::Alone { key: GAMMA.name, companion });
        }
        return None;
    }
    let refuse = |other| {
        section.note(BACKSCATTER.name, Rule::Contradiction { key: BACKSCATTER.name, other });
    };
    if echo == EchoMode::RcsTable {
        refuse("echo = \"rcs-table\"");
    }
    if matches!(radar.array.polarization, Polarization::Vh | Polarization::Hv) {
        refuse("a cross polarization");
    }
    if radar.position_m[2] <= 0.0 {
        refuse("a radar that is not above the road");
    }
    Some(Backscatter { gamma: power_from_db(gamma_db) })
}

fn read_material(section: &Section<'_>) -> Option<Material> {
    let layers = if section.has(LAYERS.name) { stacked(section)? } else { single(section)? };
    let backing = section.or_default(&BACKING);
    let thickness = if section.or_default(&COHERENT) { Thickness::Exact } else { Thickness::Averaged };
    match layers {
        Composition::Filled(permittivity) => {
            for key in [BACKING.name, COHERENT.name].into_iter().filter(|key| section.has(key)) {
                section.note(key, Rule::Alone { key, companion: THICKNESS.name });
            }
            Some(
                permittivity.map_or(Material::Conductor, |permittivity| Material::HalfSpace { permittivity }),
            )
        }
        Composition::Layered(layers) => Some(Material::Layers { layers, backing, thickness }),
    }
}

/// Composition of a material before it is known what is behind.
enum Composition {
    /// All the way; `None` is metal.
    Filled(Option<Complex64>),
    Layered(Vec<Layer>),
}

fn stacked(section: &Section<'_>) -> Option<Composition> {
    let alone = [SUBSTANCE.name, PERMITTIVITY.name, THICKNESS.name].into_iter().find(|key| section.has(key));
    if let Some(key) = alone {
        section.note(key, Rule::Contradiction { key, other: LAYERS.name });
        return None;
    }
    let read: Option<Vec<Layer>> = layers(section)?.iter().map(read_layer).collect();
    read.map(Composition::Layered)
}

fn single(section: &Section<'_>) -> Option<Composition> {
    let permittivity = read_permittivity(section)?;
    if !section.has(THICKNESS.name) {
        return Some(Composition::Filled(permittivity));
    }
    let thickness_m = read_thickness_m(section)?;
    match permittivity {
        Some(permittivity) => Some(Composition::Layered(vec![Layer { thickness_m, permittivity }])),
        None => {
            section.note(THICKNESS.name, Rule::Misplaced { key: THICKNESS.name, owner: "metal" });
            None
        }
    }
}

fn read_layer(section: &Section<'_>) -> Option<Layer> {
    section.require(THICKNESS.name);
    let (permittivity, thickness_m) = (read_permittivity(section)?, read_thickness_m(section)?);
    if permittivity.is_none() {
        section.note(
            SUBSTANCE.name,
            Rule::Misplaced { key: SUBSTANCE.name, owner: "a layer of metal: say backing = \"metal\"" },
        );
    }
    Some(Layer { thickness_m, permittivity: permittivity? })
}

fn read_thickness_m(section: &Section<'_>) -> Option<f64> {
    section.read(&THICKNESS).map(|mm| 1e-3 * mm)
}

/// Reads a permittivity from the table of substances or as a number: `Some(None)` is metal, `None` wrong and
/// noted.
#[expect(
    clippy::option_option,
    reason = "the outer says whether something readable is there, the inner whether it is metal"
)]
fn read_permittivity(section: &Section<'_>) -> Option<Option<Complex64>> {
    let (key, other) = (PERMITTIVITY.name, SUBSTANCE.name);
    match (section.has(other), section.has(key)) {
        (true, true) => {
            section.note(key, Rule::Contradiction { key, other });
            None
        }
        (false, true) => {
            let [real, loss] = section.read(&PERMITTIVITY)?;
            let [allowed, _] = PERMITTIVITY.takes.each;
            if !allowed.holds(real) {
                section.note(key, Rule::OutOfRange { key, found: real, allowed });
                return None;
            }
            Some(Some(Complex64::new(real, -loss)))
        }
        (true, false) => {
            let found = section.read(&SUBSTANCE)?;
            let known = substance(found);
            if known.is_none() {
                let nearest = nearest(found, &SUBSTANCES.map(|s| s.name));
                section.note(SUBSTANCE.name, Rule::UnknownSubstance { found: found.to_owned(), nearest });
            }
            known.map(|known| known.permittivity)
        }
        (false, false) => {
            section.require(SUBSTANCE.name);
            None
        }
    }
}
