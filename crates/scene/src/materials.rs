//! `[materials]`, files of them, and `[road]`: names of materials, and what they stand for.

use crate::document::errors::{Place, Rule, SceneErrors};
use crate::document::faults::Faults;
use crate::document::keys;
use crate::document::section::Section;
use crate::document::text::{at_no_place, read_text};
use crate::models::library::Models;
use crate::wording::allowed::Allowed;
use crate::wording::likeness::nearest;
use artifact::material::{Backing, Layer, Material, MaterialMap, Road, Thickness, Transmission};
use artifact::permittivity::{SUBSTANCES, substance};
use artifact::radar::{Polarization, Radar};
use artifact::scene::Backscatter;
use artifact::settings::EchoMode;
use artifact::units::power_from_db;
use num_complex::Complex64;
use std::path::Path;
use toml::de::DeTable;

/// The materials in a file of the form of a scene's `[materials]`; whether waves pass sheets is not for it to
/// say.
///
/// # Errors
/// Every broken rule with line and column; `is_system` tells a file that is missing or unreadable.
pub fn read_materials(path: &Path) -> Result<MaterialMap, SceneErrors> {
    let text = read_text(path).map_err(|rule| at_no_place(path, rule))?;
    let faults = Faults::new(path, &text);
    let (document, syntax) = DeTable::parse_recoverable(&text);
    for error in &syntax {
        let byte = error.span().map_or(text.len(), |span| span.start);
        faults.note(byte, Place::Scene, Rule::Syntax { message: error.message().to_owned() });
    }
    let root = Section::root(document.get_ref(), &keys::MATERIAL_FILE, &faults);
    root.require("materials");
    let by_name = by_name(&root);
    drop(root);
    faults.into_errors().map(|()| MaterialMap { by_name, transmission: Transmission::Ignored })
}

/// What a scene says of materials: a table of its own or a file, and whether waves pass.
pub(crate) fn read_scene_materials(root: &Section<'_>, models: &mut Models) -> MaterialMap {
    let fidelity = root.section(&keys::FIDELITY);
    let words = [("off", Transmission::Ignored), ("on", Transmission::Followed)];
    let transmission = fidelity.word("transmission", &words).unwrap_or_default();
    let by_name = match fidelity.text("materials") {
        Some(_) if root.has("materials") => {
            fidelity.note("materials", Rule::Contradiction { key: "materials", other: "[materials]" });
            vec![]
        }
        Some(written) => from_file(&fidelity, &models.file_beside(written)),
        None => by_name(root),
    };
    MaterialMap { by_name, transmission }
}

fn from_file(fidelity: &Section<'_>, path: &Path) -> Vec<(String, Material)> {
    read_materials(path).map(|map| map.by_name).unwrap_or_else(|errors| {
        fidelity.note("materials", Rule::Materials(errors));
        vec![]
    })
}

fn by_name(root: &Section<'_>) -> Vec<(String, Material)> {
    let materials = root.materials();
    materials
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
    let section = root.section(&keys::ROAD);
    if !section.exists() {
        return (None, None);
    }
    (read_mirror(&section), read_backscatter(&section, radar, echo))
}

fn read_mirror(section: &Section<'_>) -> Option<Road> {
    if section.word("mirror", &[("on", true), ("off", false)]) == Some(false) {
        for key in ["substance", "permittivity", "rms_height_mm"].into_iter().filter(|key| section.has(key)) {
            section.note(key, Rule::Misplaced { key, owner: "a road that is no mirror" });
        }
        return None;
    }
    const ASPHALT: &str = "asphalt";
    let named = section.has("substance") || section.has("permittivity");
    let of_asphalt = || substance(ASPHALT).and_then(|asphalt| asphalt.permittivity);
    let permittivity = if named { read_permittivity(section)? } else { of_asphalt() };
    let material =
        permittivity.map_or(Material::Conductor, |permittivity| Material::HalfSpace { permittivity });
    // 0.5 mm costs 0.1 to 0.9 dB at the grazing angles of 60 to 25 m (docs/physics.md §5).
    let rms_height_mm = section.number("rms_height_mm", Allowed::Between(0.0, 100.0)).unwrap_or(0.5);
    Some(Road { material, rms_height_m: 1e-3 * rms_height_mm })
}

fn read_backscatter(section: &Section<'_>, radar: &Radar, echo: EchoMode) -> Option<Backscatter> {
    let is_floor = section.word("backscatter", &[("off", false), ("floor", true)]).unwrap_or(false);
    let gamma_db = section.number("backscatter_gamma_db", Allowed::Between(-100.0, 30.0));
    if !is_floor {
        if section.has("backscatter_gamma_db") {
            let companion = "backscatter = \"floor\"";
            section.note("backscatter_gamma_db", Rule::Alone { key: "backscatter_gamma_db", companion });
        }
        return None;
    }
    let refuse = |other| section.note("backscatter", Rule::Contradiction { key: "backscatter", other });
    if echo == EchoMode::RcsTable {
        refuse("echo = \"rcs-table\"");
    }
    if matches!(radar.array.polarization, Polarization::Vh | Polarization::Hv) {
        refuse("a cross polarization");
    }
    if radar.position_m[2] <= 0.0 {
        refuse("a radar that is not above the road");
    }
    // What is usual for flat ground (docs/scenes.md).
    Some(Backscatter { gamma: power_from_db(gamma_db.unwrap_or(-20.0)) })
}

fn read_material(section: &Section<'_>) -> Option<Material> {
    let layers = if section.has("layers") { stacked(section)? } else { single(section)? };
    let backing =
        section.word("backing", &[("air", Backing::Air), ("metal", Backing::Metal)]).unwrap_or(Backing::Air);
    let coherent = section.truth("coherent").unwrap_or(true);
    let thickness = if coherent { Thickness::Exact } else { Thickness::Averaged };
    match layers {
        Body::Filled(permittivity) => {
            for key in ["backing", "coherent"].into_iter().filter(|key| section.has(key)) {
                section.note(key, Rule::Alone { key, companion: "thickness_mm" });
            }
            Some(
                permittivity.map_or(Material::Conductor, |permittivity| Material::HalfSpace { permittivity }),
            )
        }
        Body::Layered(layers) => Some(Material::Layers { layers, backing, thickness }),
    }
}

/// What a material consists of before it is known what is behind.
enum Body {
    /// All the way; `None` is metal.
    Filled(Option<Complex64>),
    Layered(Vec<Layer>),
}

fn stacked(section: &Section<'_>) -> Option<Body> {
    let alone = ["substance", "permittivity", "thickness_mm"].into_iter().find(|key| section.has(key));
    if let Some(key) = alone {
        section.note(key, Rule::Contradiction { key, other: "layers" });
        return None;
    }
    let layers: Option<Vec<Layer>> = section.layers()?.iter().map(read_layer).collect();
    layers.map(Body::Layered)
}

fn single(section: &Section<'_>) -> Option<Body> {
    let permittivity = read_permittivity(section)?;
    if !section.has("thickness_mm") {
        return Some(Body::Filled(permittivity));
    }
    let thickness_m = read_thickness_m(section)?;
    match permittivity {
        Some(permittivity) => Some(Body::Layered(vec![Layer { thickness_m, permittivity }])),
        None => {
            section.note("thickness_mm", Rule::Misplaced { key: "thickness_mm", owner: "metal" });
            None
        }
    }
}

fn read_layer(section: &Section<'_>) -> Option<Layer> {
    section.require("thickness_mm");
    let (permittivity, thickness_m) = (read_permittivity(section)?, read_thickness_m(section)?);
    if permittivity.is_none() {
        section.note(
            "substance",
            Rule::Misplaced { key: "substance", owner: "a layer of metal: say backing = \"metal\"" },
        );
    }
    Some(Layer { thickness_m, permittivity: permittivity? })
}

fn read_thickness_m(section: &Section<'_>) -> Option<f64> {
    section.number("thickness_mm", Allowed::Above(0.0, 1e3)).map(|mm| 1e-3 * mm)
}

/// By the table or by number: `Some(None)` is metal, `None` wrong and noted.
#[expect(
    clippy::option_option,
    reason = "the outer says whether something readable is there, the inner whether it is metal"
)]
fn read_permittivity(section: &Section<'_>) -> Option<Option<Complex64>> {
    match (section.has("substance"), section.has("permittivity")) {
        (true, true) => {
            section.note("permittivity", Rule::Contradiction { key: "permittivity", other: "substance" });
            None
        }
        (false, true) => {
            let [real, loss] = section.vector("permittivity", Allowed::Between(0.0, 1e6))?;
            // Below 1 there is plasma, which no vehicle wears.
            if real < 1.0 {
                let allowed = Allowed::Between(1.0, 1e6);
                section.note("permittivity", Rule::OutOfRange { key: "permittivity", found: real, allowed });
                return None;
            }
            Some(Some(Complex64::new(real, -loss)))
        }
        (true, false) => {
            let found = section.text("substance")?;
            let known = substance(found);
            if known.is_none() {
                let nearest = nearest(found, &SUBSTANCES.map(|s| s.name));
                section.note("substance", Rule::UnknownSubstance { found: found.to_owned(), nearest });
            }
            known.map(|known| known.permittivity)
        }
        (false, false) => {
            section.require("substance");
            None
        }
    }
}
