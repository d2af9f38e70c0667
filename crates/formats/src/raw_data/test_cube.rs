//! A cube that tests of several formats share.

use artifact::cube::{Cube, CubeFrame, CubeHeader, SampleUnit};
use artifact::settings::Noise;
use artifact::{ErrorBudget, Provenance, Writer};
use num_complex::Complex32;
use radar::{aperture, paper};
use std::path::{Path, PathBuf};

/// Header of a radar of one transmitter and two receivers, with samples in this unit.
pub(crate) fn header(unit: SampleUnit) -> CubeHeader {
    let elements = [aperture::row(1, 1.0), aperture::row(2, 1.0)];
    let radar = paper::radar([0.0; 3], paper::waveform(8, 2), elements);
    CubeHeader { radar, noise: Noise::Absent, dsp: paper::processing(), unit }
}

/// The same with a chirp twice as steep.
pub(crate) fn steeper(header: &CubeHeader) -> CubeHeader {
    let mut other = header.clone();
    other.radar.waveform.slope_hz_per_s *= 2.0;
    other
}

/// Writes `x.cube` into the folder: one frame of whole numbers.
pub(crate) fn write(folder: &Path, header: &CubeHeader) -> PathBuf {
    let file = folder.join("x.cube");
    let count = header.shape().iter().product::<usize>();
    let samples = (0..count).map(|i| Complex32::new(i as f32, -3.0)).collect();
    let mut writer = Writer::<Cube>::create(&file, &Provenance::default(), header).unwrap();
    writer.write(&CubeFrame { index: 0, time_s: 0.0, samples, error: ErrorBudget::default() }).unwrap();
    writer.finish().unwrap();
    file
}

/// Units of samples, each of which whole numbers may have.
pub(crate) const UNITS: [SampleUnit; 3] =
    [SampleUnit::RootWatts, SampleUnit::Steps, SampleUnit::FullScale(2048.0)];
