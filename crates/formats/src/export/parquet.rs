//! A table of Apache Parquet: one row per point of a run, or one row per sample of a dataset with truth and
//! features.

use artifact::Reader;
use artifact::dataset::{Dataset, Sample};
use artifact::points::{Point, Points, PointsFrame, PointsHeader};
use artifact::settings::Class;
use interchange::parquet_table::{Kind, Table, Value};
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::io::Error;
use std::path::{Path, PathBuf};

/// Columns of points, as in their csv.
const OF_POINTS: [(&str, Kind); 22] = [
    ("frame", Kind::Count),
    ("time_s", Kind::Real),
    ("range_m", Kind::Real),
    ("radial_velocity_mps", Kind::Real),
    ("az_deg", Kind::Real),
    ("el_deg", Kind::Real),
    ("x_m", Kind::Real),
    ("y_m", Kind::Real),
    ("z_m", Kind::Real),
    ("snr_db", Kind::Real),
    ("object", Kind::Count),
    ("target", Kind::Text),
    ("true_target", Kind::Text),
    ("true_class", Kind::Text),
    ("true_order", Kind::Count),
    ("true_share", Kind::Real),
    ("two_ways_a_az_deg", Kind::Real),
    ("two_ways_b_az_deg", Kind::Real),
    ("true_bodies", Kind::Count),
    ("ghost_share", Kind::Real),
    ("stationary", Kind::Truth),
    ("height", Kind::Text),
];

/// Writes the points of a run, one row each.
pub fn points(reader: Reader<Points>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        let mut table = Table::create(stream, &OF_POINTS)?;
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            frame.points.iter().try_for_each(|point| table.push(of_point(&header, &frame, point)))?;
        }
        table.finish()
    })
}

fn of_point(header: &PointsHeader, frame: &PointsFrame, p: &Point) -> Vec<Value> {
    let name = |target: u32| header.targets.get(target as usize).map(String::as_str);
    let class = |target: u32| header.classes.get(target as usize).copied().flatten().map(Class::name);
    let object = p.object.and_then(|object| frame.objects.get(object as usize));
    let [x, y, z] = p.position_m;
    vec![
        u64::from(frame.index).into(),
        frame.time_s.into(),
        p.range_m.into(),
        p.radial_velocity_mps.into(),
        p.azimuth_rad.to_degrees().into(),
        p.elevation_rad.to_degrees().into(),
        x.into(),
        y.into(),
        z.into(),
        p.snr_db.into(),
        p.object.map(u64::from).into(),
        p.target.and_then(name).into(),
        p.label.and_then(|label| name(label.target)).into(),
        p.label.and_then(|label| class(label.target)).into(),
        p.label.map(|label| u64::from(label.order)).into(),
        p.label.map(|label| label.share).into(),
        p.two_ways_rad.map(|[a, _]| a.to_degrees()).into(),
        p.two_ways_rad.map(|[_, b]| b.to_degrees()).into(),
        p.label.map(|label| u64::from(label.bodies)).into(),
        object.and_then(|object| object.ghost_share).into(),
        p.stationary.into(),
        p.height.name().into(),
    ]
}

/// Columns of samples, before those of their features.
const OF_SAMPLES: [(&str, Kind); 12] = [
    ("id", Kind::Text),
    ("class", Kind::Text),
    ("model", Kind::Text),
    ("variant", Kind::Count),
    ("scene", Kind::Count),
    ("target", Kind::Count),
    ("frame", Kind::Count),
    ("split", Kind::Text),
    ("true_range_m", Kind::Real),
    ("true_radial_velocity_mps", Kind::Real),
    ("true_lane", Kind::Count),
    ("seed", Kind::Count),
];

/// Writes the samples of a shard, or of all shards of a folder, one row each.
pub fn samples(asked: &Path, out: &Path) -> Result<(), Failure> {
    let shards = shards(asked)?;
    let names = feature_names();
    let columns: Vec<(&str, Kind)> =
        OF_SAMPLES.into_iter().chain(names.iter().map(|name| (name.as_str(), Kind::Real))).collect();
    files::write_with(out, |stream| {
        let mut table = Table::create(stream, &columns)?;
        for shard in &shards {
            for sample in Reader::<Dataset>::open(shard).map_err(Error::other)? {
                table.push(of_sample(&sample.map_err(Error::other)?))?;
            }
        }
        table.finish()
    })
}

/// The shards of a folder, at least one; a plain file is the only shard.
fn shards(asked: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !asked.is_dir() {
        artifact::inputs::register_path(asked);
        return Ok(vec![asked.to_owned()]);
    }
    Ok(DatasetFolder::open(asked)?.shards)
}

fn of_sample(sample: &Sample) -> Vec<Value> {
    let split = format!("{:?}", sample.split).to_lowercase();
    let mut row: Vec<Value> = vec![
        sample.id.as_str().into(),
        sample.class.map(Class::name).into(),
        sample.model.as_str().into(),
        sample.variant.into(),
        sample.scene.into(),
        u64::from(sample.target).into(),
        u64::from(sample.frame).into(),
        split.as_str().into(),
        sample.range_m.into(),
        sample.radial_velocity_mps.into(),
        sample.lane.map(u64::from).into(),
        sample.seed.into(),
    ];
    row.extend(features(sample).into_iter().map(Value::from));
    row
}

#[cfg(feature = "classifier")]
fn feature_names() -> Vec<String> {
    crate::export::features::column_names()
}

#[cfg(feature = "classifier")]
fn features(sample: &Sample) -> Vec<f64> {
    classifier::features(&sample.signature).iter().map(|(_, value)| *value).collect()
}

#[cfg(not(feature = "classifier"))]
fn feature_names() -> Vec<String> {
    vec![]
}

#[cfg(not(feature = "classifier"))]
fn features(_sample: &Sample) -> Vec<f64> {
    vec![]
}
