//! `[materials]`, files of materials, and `[road]`: names of materials, and their properties.

mod material_files;

use crate::document::diagnostics::Diagnostics;
use crate::document::entries::{layers, materials};
use crate::document::errors::{Rule, SceneErrors};
use crate::document::keys::MATERIAL_FILE_TABLES;
use crate::document::keys::fidelity::{MATERIALS, TRANSMISSION};
use crate::document::keys::materials::{
    BACKING, BACKSCATTER, COHERENT, GAMMA, Ground, LAYERS, MIRROR, Mirror, OPENMATERIAL, PERMITTIVITY,
    RMS_HEIGHT, ROAD, ROAD_SUBSTANCE, SUBSTANCE, THICKNESS,
};
use crate::document::keys::scene::{MATERIAL_FILE, MATERIALS_KEY};
use crate::document::section::Section;
use crate::document::text::{read_text, without_position};
use crate::materials::material_files::MaterialFiles;
use crate::models::library::Models;
use crate::openmaterial::MaterialProperties;
use crate::wording::allowed_range::AllowedRange;
use crate::wording::similarity::nearest;
use artifact::material::{Layer, Material, MaterialMap, Road, Thickness, Transmission};
use artifact::permittivity::{SUBSTANCES, Substance, substance};
use artifact::radar::Radar;
use artifact::scene::Backscatter;
use artifact::settings::EchoMode;
use artifact::units::power_from_db;
use num_complex::Complex64;
use std::path::Path;

/// Reads the materials in a file of the form of a scene's `[materials]`, those of OpenMATERIAL 3D at the
/// given frequency; the file does not specify whether waves pass sheets.
///
/// # Errors
/// Every broken rule with line and column; `is_system` indicates a missing or unreadable file.
pub fn read_materials(path: &Path, frequency_hz: f64) -> Result<MaterialMap, SceneErrors> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let by_name = of_file(path, &MaterialFiles::new(folder, frequency_hz))?;
    Ok(MaterialMap { by_name, transmission: Transmission::Ignored })
}

fn of_file(path: &Path, files: &MaterialFiles) -> Result<Vec<(String, Material)>, SceneErrors> {
    let text = read_text(path).map_err(|rule| without_position(path, rule))?;
    let diagnostics = Diagnostics::of_tables(path, &text, MATERIAL_FILE_TABLES);
    let document = diagnostics.document();
    let root = Section::root(&document, &MATERIAL_FILE, &diagnostics);
    root.require(MATERIALS_KEY.name);
    let by_name = by_name(&root, files);
    drop(root);
    diagnostics.into_errors().map(|()| by_name)
}

/// Reads a scene's materials, from a table of its own or a file, and whether waves pass through them.
pub(crate) fn read_scene_materials(
    root: &Section<'_>,
    fidelity: &Section<'_>,
    radar: &Radar,
    models: &mut Models,
) -> MaterialMap {
    let transmission = fidelity.or_default(&TRANSMISSION);
    let frequency_hz = radar.waveform.centre_frequency_hz();
    let by_name = match fidelity.read(&MATERIALS) {
        Some(_) if root.has(MATERIALS_KEY.name) => {
            let key = MATERIALS.name;
            fidelity.note(key, Rule::Contradiction { key, other: "[materials]" });
            vec![]
        }
        Some(written) => from_file(fidelity, written, frequency_hz, models),
        None => {
            let files = MaterialFiles::new(&models.folder(), frequency_hz);
            let by_name = by_name(root, &files);
            models.add_inputs(files.into_files());
            by_name
        }
    };
    MaterialMap { by_name, transmission }
}

fn from_file(
    fidelity: &Section<'_>,
    written: &str,
    frequency_hz: f64,
    models: &mut Models,
) -> Vec<(String, Material)> {
    let path = models.add_input(written);
    let files = MaterialFiles::new(path.parent().unwrap_or(Path::new("")), frequency_hz);
    let by_name = of_file(&path, &files);
    models.add_inputs(files.into_files());
    by_name.unwrap_or_else(|errors| {
        fidelity.note(MATERIALS.name, Rule::Materials(errors));
        vec![]
    })
}

fn by_name(root: &Section<'_>, files: &MaterialFiles) -> Vec<(String, Material)> {
    materials(root)
        .iter()
        .filter_map(|(name, section)| Some(((*name).to_owned(), read_material(section, files)?)))
        .collect()
}

/// The road as a reflector and its own backscatter; `None` if the scene has neither.
pub(crate) fn read_road(
    root: &Section<'_>,
    radar: &Radar,
    echo: EchoMode,
    models: &mut Models,
) -> (Option<Road>, Option<Backscatter>) {
    let section = root.section(&ROAD);
    if !section.exists() {
        return (None, None);
    }
    let files = MaterialFiles::new(&models.folder(), radar.waveform.centre_frequency_hz());
    let mirror = read_mirror(&section, &files);
    models.add_inputs(files.into_files());
    (mirror, read_backscatter(&section, radar, echo))
}

fn read_mirror(section: &Section<'_>, files: &MaterialFiles) -> Option<Road> {
    if section.or_default(&MIRROR) == Mirror::Off {
        let of_mirrors = [SUBSTANCE.name, PERMITTIVITY.name, OPENMATERIAL.name, RMS_HEIGHT.name];
        for key in of_mirrors.into_iter().filter(|key| section.has(key)) {
            section.note(key, Rule::Misplaced { key, owner: "a road that is no mirror" });
        }
        return None;
    }
    let named = SOURCES.iter().any(|key| section.has(key));
    let of_asphalt = || substance(ROAD_SUBSTANCE.absent.0).and_then(|asphalt| asphalt.permittivity);
    let smooth = |permittivity| MaterialProperties { permittivity, rms_height_m: None };
    let known = if named { read_substance(section, files)? } else { smooth(of_asphalt()) };
    let told_m = known.rms_height_m.filter(|_| !section.has(RMS_HEIGHT.name));
    let rms_height_m = match told_m {
        Some(told_m) => checked_height_m(section, files, told_m)?,
        None => 1e-3 * section.or_default(&RMS_HEIGHT),
    };
    Some(Road { material: known.filled(), rms_height_m })
}

/// The height from a file, if `rms_height_mm` may have that value.
fn checked_height_m(section: &Section<'_>, files: &MaterialFiles, told_m: f64) -> Option<f64> {
    let AllowedRange::Between(least_mm, most_mm) = RMS_HEIGHT.takes.0 else { return Some(told_m) };
    let allowed = AllowedRange::Between(1e-3 * least_mm, 1e-3 * most_mm);
    if !allowed.holds(told_m) {
        let error = files.too_rough(section.read(&OPENMATERIAL)?, told_m, allowed);
        section.note(OPENMATERIAL.name, Rule::OpenMaterial(Box::new(error)));
    }
    allowed.holds(told_m).then_some(told_m)
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
    if radar.array.polarization.is_crossed() {
        refuse("a cross polarization");
    }
    if radar.position_m[2] <= 0.0 {
        refuse("a radar that is not above the road");
    }
    Some(Backscatter { gamma: power_from_db(gamma_db) })
}

fn read_material(section: &Section<'_>, files: &MaterialFiles) -> Option<Material> {
    let layers = if section.has(LAYERS.name) { stacked(section, files)? } else { single(section, files)? };
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

/// Composition of a material before its backing is known.
enum Composition {
    /// Solid throughout; `None` is metal.
    Filled(Option<Complex64>),
    Layered(Vec<Layer>),
}

fn stacked(section: &Section<'_>, files: &MaterialFiles) -> Option<Composition> {
    let of_one = SOURCES.into_iter().chain([THICKNESS.name]);
    if let Some(key) = of_one.into_iter().find(|key| section.has(key)) {
        section.note(key, Rule::Contradiction { key, other: LAYERS.name });
        return None;
    }
    let read: Option<Vec<Layer>> = layers(section)?.iter().map(|layer| read_layer(layer, files)).collect();
    read.map(Composition::Layered)
}

fn single(section: &Section<'_>, files: &MaterialFiles) -> Option<Composition> {
    let permittivity = read_substance(section, files)?.permittivity;
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

fn read_layer(section: &Section<'_>, files: &MaterialFiles) -> Option<Layer> {
    section.require(THICKNESS.name);
    let permittivity = read_substance(section, files)?.permittivity;
    let thickness_m = read_thickness_m(section)?;
    if permittivity.is_none() {
        let key = if section.has(OPENMATERIAL.name) { OPENMATERIAL.name } else { SUBSTANCE.name };
        section.note(key, Rule::Misplaced { key, owner: "a layer of metal: say backing = \"metal\"" });
    }
    Some(Layer { thickness_m, permittivity: permittivity? })
}

fn read_thickness_m(section: &Section<'_>) -> Option<f64> {
    section.read(&THICKNESS).map(|mm| 1e-3 * mm)
}

/// Keys that specify the composition.
const SOURCES: [&str; 3] = [SUBSTANCE.name, PERMITTIVITY.name, OPENMATERIAL.name];

/// Reads a composition: from the table of substances, a number, or a file. Notes a fault and returns `None`
/// if it is wrong.
fn read_substance(section: &Section<'_>, files: &MaterialFiles) -> Option<MaterialProperties> {
    let smooth = |permittivity| MaterialProperties { permittivity, rms_height_m: None };
    let said: Vec<&'static str> = SOURCES.into_iter().filter(|key| section.has(key)).collect();
    match said[..] {
        [] => {
            section.require(SUBSTANCE.name);
            None
        }
        [key] if key == PERMITTIVITY.name => read_permittivity(section).map(|told| smooth(Some(told))),
        [key] if key == OPENMATERIAL.name => {
            let at_fault = |error| section.note(key, Rule::OpenMaterial(Box::new(error)));
            files.material(section.read(&OPENMATERIAL)?).map_err(at_fault).ok()
        }
        [_] => of_table(section).map(|known| smooth(known.permittivity)),
        [other, key, ..] => {
            section.note(key, Rule::Contradiction { key, other });
            None
        }
    }
}

fn read_permittivity(section: &Section<'_>) -> Option<Complex64> {
    let key = PERMITTIVITY.name;
    let [real, loss] = section.read(&PERMITTIVITY)?;
    let [allowed, _] = PERMITTIVITY.takes.each;
    if !allowed.holds(real) {
        section.note(key, Rule::OutOfRange { key, found: real, allowed });
        return None;
    }
    Some(Complex64::new(real, -loss))
}

fn of_table(section: &Section<'_>) -> Option<&'static Substance> {
    let found = section.read(&SUBSTANCE)?;
    let known = substance(found);
    if known.is_none() {
        let nearest = nearest(found, &SUBSTANCES.map(|s| s.name));
        section.note(SUBSTANCE.name, Rule::UnknownSubstance { found: found.to_owned(), nearest });
    }
    known
}
