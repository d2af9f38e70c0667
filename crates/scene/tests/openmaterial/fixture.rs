//! A folder with an asset, its model, a mapping, materials and tables.

use crate::glb_file::{GlbFile, floats};
use artifact::material::{Material, MaterialMap};
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use scene::OpenMaterialError;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The frequency at which most tests ask.
pub(crate) const ASKED_HZ: f64 = 77e9;

/// Files beside asset and model that [`Fixture::car`] has, in the order in which they are read.
pub(crate) const MATERIAL_FILES: [&str; 5] =
    ["car.xomm", "m/glass.xomp", "m/paint.xomp", "m/glass_emp.xompt", "m/paint_emp.xompt"];

/// Files in a folder of their own.
pub(crate) struct Fixture {
    folder: TempDir,
}

impl Fixture {
    /// A body of paint and glass with a part of neither: `car.xoma`, `car.glb`, `car.xomm`, and `m/NAME.xomp`
    /// with its table for each of the two, whose permittivities are 6 − 0.2j and 3 − 0.1j at all frequencies.
    pub(crate) fn car() -> Self {
        let fixture = Self::empty();
        fixture.write_bytes("car.glb", &body().bytes());
        fixture.write("car.xoma", &asset(json!({ "materialMappingUri": "car.xomm" })));
        fixture.write("car.xomm", &mapping(&[["glass", "m/glass.xomp"], ["paint", "m/paint.xomp"]]));
        fixture.material("m/glass", &[row(None, [6.0, 0.2])]);
        fixture.material("m/paint", &[row(None, [3.0, 0.1])]);
        fixture
    }

    pub(crate) fn empty() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// Places of some files and of others after them.
    pub(crate) fn paths(&self, names: &[&str], more: &[&str]) -> Vec<PathBuf> {
        names.iter().chain(more).map(|name| self.path(name)).collect()
    }

    /// A material and its table, named without their endings.
    pub(crate) fn material(&self, name: &str, rows: &[Value]) {
        let stem = name.rsplit('/').next().unwrap();
        let properties = json!({ "electromagneticPropertiesUri": format!("{stem}_emp.xompt") });
        self.write(&format!("{name}.xomp"), &with_metadata(json!({ "materialProperties": properties })));
        let table = with_metadata(json!({ "electromagneticProperties": rows }));
        self.write(&format!("{name}_emp.xompt"), &table);
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn write(&self, name: &str, value: &Value) {
        self.write_bytes(name, &serde_json::to_vec_pretty(value).unwrap());
    }

    pub(crate) fn write_bytes(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    pub(crate) fn remove(&self, name: &str) {
        std::fs::remove_file(self.path(name)).unwrap();
    }

    /// A sentence without the folder.
    pub(crate) fn told(&self, error: &impl ToString) -> String {
        error.to_string().replace(&format!("{}/", self.folder().display()), "")
    }

    /// What the asset says of its own materials.
    pub(crate) fn materials(&self, frequency_hz: f64) -> Result<MaterialMap, OpenMaterialError> {
        let file = self.path("car.xoma");
        let mesh = scene::read_mesh(&file, &scene::MeshOptions { unit_scale: None }).unwrap();
        scene::asset_materials(&file, &mesh.materials, &MaterialMap::default(), frequency_hz)
    }

    /// The sentence of a refusal of the asset's materials.
    pub(crate) fn refused(&self) -> String {
        self.told(&self.materials(ASKED_HZ).unwrap_err())
    }

    /// The glass of the car.
    pub(crate) fn glass_at(&self, frequency_hz: f64) -> Result<Material, OpenMaterialError> {
        let map = self.materials(frequency_hz)?;
        Ok(map.by_name.into_iter().find(|(name, _)| name == "glass").unwrap().1)
    }

    /// The permittivity of the car's glass at a frequency, of a table with these rows.
    pub(crate) fn glass(&self, rows: &[Value], frequency_hz: f64) -> Complex64 {
        self.material("m/glass", rows);
        match self.glass_at(frequency_hz).unwrap() {
            Material::HalfSpace { permittivity } => permittivity,
            other => panic!("{other:?}"),
        }
    }

    /// The sentence of the refusal of such a table.
    pub(crate) fn refused_glass(&self, rows: &[Value]) -> String {
        self.material("m/glass", rows);
        self.refused()
    }
}

/// A tetrahedron of paint, with a pane of glass and one without a material before it.
fn body() -> GlbFile {
    let mut file = GlbFile::tetrahedron();
    let pane = |file: &mut GlbFile, x: f32| {
        file.add_accessor(floats(&[[x, 0.0, 4.0], [x + 1.0, 0.0, 4.0], [x, 2.0, 4.5]]), 3, 5126, "VEC3")
    };
    let (glass, bare) = (pane(&mut file, 0.0), pane(&mut file, 3.0));
    let paint = file.json["meshes"][0]["primitives"][0].clone();
    let primitives = json!([
        paint,
        { "attributes": { "POSITION": glass }, "material": 1 },
        { "attributes": { "POSITION": bare } }]);
    file.set("/materials", json!([{ "name": "paint" }, { "name": "glass" }]))
        .set("/meshes/0/primitives", primitives)
}

/// The glTF of the car as text, its buffer in a file of that name.
pub(crate) fn text_model(buffer: &str) -> (Value, Vec<u8>) {
    let file = body().set("/buffers/0/uri", json!(buffer)).without("/scene");
    (file.json, file.binary)
}

/// An asset with these further keys.
pub(crate) fn asset(keys: Value) -> Value {
    with_metadata(keys)
}

/// A mapping of names to files.
pub(crate) fn mapping(entries: &[[&str; 2]]) -> Value {
    let entries: Vec<Value> = entries.iter().map(|[name, file]| json!([name, file, "by hand"])).collect();
    with_metadata(json!({ "materialMapping": entries }))
}

/// The keys beside the metadata that every file has.
pub(crate) fn with_metadata(mut keys: Value) -> Value {
    keys["metadata"] = json!({ "name": "by hand", "openMaterial3dVersion": "1.0.0" });
    keys
}

/// A row of a table: permittivity ε′, ε″ at a frequency, or at all.
pub(crate) fn row(frequency_hz: Option<f64>, permittivity: [f64; 2]) -> Value {
    row_at(frequency_hz, [293.15, 50.0], permittivity)
}

/// A row at a temperature and humidity.
pub(crate) fn row_at(frequency_hz: Option<f64>, conditions: [f64; 2], permittivity: [f64; 2]) -> Value {
    let ([temperature, humidity], [real, loss]) = (conditions, permittivity);
    let wavelength_m = frequency_hz.map(|frequency_hz| SPEED_OF_LIGHT_MPS / frequency_hz);
    json!([wavelength_m, temperature, humidity, 1.0, 0.0, real, loss])
}
