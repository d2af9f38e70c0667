//! Paths as `osi3.RadarSensorView.Reflection`: strength relative to the transmitted power, time of flight,
//! Doppler shift of the carrier and direction of arrival, at the frame's middle as seen from the array's
//! centre.

use crate::measured::sensor_axes::SensorAxes;
use crate::osi::common::Identifier;
use crate::osi::sensor_view::{RadarSensorView, RadarSensorViewConfiguration, Reflection};
use crate::sensor::mounting::mounting;
use artifact::Radar;
use artifact::paths::{Path, PathsFrame};
use artifact::units::{SPEED_OF_LIGHT_MPS, db_from_amplitude};
use radar::link::link_amplitude;
use radar::path_kinematics::{Leg, legs, mean_share};

/// Reflections of a frame by the sensor with that number, in the order of its paths.
pub(crate) fn radar_view(
    sensor: u64,
    radar: &Radar,
    centre_frequency_hz: f64,
    frame: &PathsFrame,
) -> RadarSensorView {
    let configuration = RadarSensorViewConfiguration {
        sensor_id: Identifier::of(sensor),
        mounting_position: Some(mounting(radar)),
        emitter_frequency: Some(centre_frequency_hz),
    };
    let axes = SensorAxes::of(radar);
    let reflection = |path: &Path| reflection(radar, &axes, centre_frequency_hz, path);
    RadarSensorView {
        view_configuration: Some(configuration),
        reflection: frame.paths.iter().map(reflection).collect(),
    }
}

fn reflection(radar: &Radar, axes: &SensorAxes, frequency_hz: f64, path: &Path) -> Reflection {
    let [there, back] = legs(radar, path);
    let gain = |leg: &Leg| radar.array.pattern.amplitude(axes.cosines(leg.direction));
    let (receive, transmit) = radar.array.polarization.indices();
    // √(received over transmitted power): the link without the transmit power, the path's own amplitude, both
    // legs.
    let amplitude = link_amplitude(radar) / radar.link.transmit_power_w.sqrt()
        * path.amplitude_m[receive][transmit].norm()
        * (mean_share(radar, path) * gain(&there) * gain(&back)).abs()
        / (there.length_m * back.length_m);
    let [azimuth, elevation] = axes.angles(back.direction);
    Reflection {
        signal_strength: Some(db_from_amplitude(amplitude)),
        time_of_flight: Some((there.length_m + back.length_m) / SPEED_OF_LIGHT_MPS),
        doppler_shift: Some(-(there.rate_mps + back.rate_mps) * frequency_hz / SPEED_OF_LIGHT_MPS),
        source_horizontal_angle: Some(azimuth),
        source_vertical_angle: Some(elevation),
    }
}
