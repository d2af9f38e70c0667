//! Shares of the echo's parts in the whole echo, over the frames looked at.

use crate::chain::expected_work::probed_frames;
use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use artifact::radar::{Multiplexing, Radar};
use artifact::scene::SceneHeader;
use artifact::settings::Noise;
use artifact::units::{BOLTZMANN_J_PER_K, power_from_db};
use bart_rcs::{EchoParts, NoProgress, Tracer};
use num_complex::Complex64;
use scene::PhysicsKeys;

/// Shares of the echo of bodies and point targets as relative amplitudes, each the largest of the frames
/// looked at.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct EchoShares {
    /// Paths within one body, by order from 1.
    pub(crate) within: Vec<f64>,
    /// Paths over several bodies, by order from 1.
    pub(crate) between: Vec<f64>,
    /// Spread between the node rules of double and triple reflections.
    pub(crate) nodes: f64,
    /// Paths by a road of dry asphalt, by order from 1; `None` if these cannot be traced.
    pub(crate) road: Option<Vec<f64>>,
    /// The whole echo with the road.
    pub(crate) whole_with_road: f64,
    /// Diffraction by edges, by order from 1.
    pub(crate) edges: Vec<f64>,
    /// Change by waves that pass sheets.
    pub(crate) sheets: f64,
    /// Whole echo that, concentrated in one cell of the map, would be as strong as the noise.
    pub(crate) noise: f64,
}

/// Looks at up to three frames of a scene; `None` if nothing scatters in them.
///
/// A road that the scene itself omits is not part of the whole.
pub(crate) fn shares(
    header: &SceneHeader,
    said: &PhysicsKeys,
    tracer: &Tracer,
) -> Result<Option<EchoShares>, Failure> {
    let has_no_road = said.road && header.road.is_none();
    let mut all: Option<EchoShares> = None;
    for index in probed_frames(header.frames) {
        let Some(parts) = parts(tracer, header, index)? else { continue };
        let noise = noise(header, index, &parts.amplitude_m);
        let of_frame = EchoShares { noise, ..of_parts(parts) };
        let of_frame = if has_no_road { of_frame } else { of_frame.over_road() };
        all = Some(match all {
            Some(before) => before.larger(of_frame),
            None => of_frame,
        });
    }
    Ok(all)
}

/// Tracer of the scene's meshes, shared by looks and estimates.
pub(crate) fn tracer(header: &SceneHeader, memory: Allowance) -> Result<Tracer, Failure> {
    Ok(Tracer::new(header).map_err(Failure::refused)?.within(memory.limit()))
}

fn parts(tracer: &Tracer, header: &SceneHeader, index: u32) -> Result<Option<EchoParts>, Failure> {
    let (view, frame) = (scene::frame_view(header, index), scene::snapshot(header, index));
    tracer.echo_parts(&view, &frame, &NoProgress).map_err(Failure::refused)
}

fn of_parts(parts: EchoParts) -> EchoShares {
    let EchoParts { within, between, nodes, road, edges, transmission, .. } = parts;
    let whole_with_road = road.as_ref().map_or(1.0, |road| road.whole);
    let road = road.map(|road| road.by_order);
    EchoShares { within, between, nodes, road, whole_with_road, edges, sheets: transmission, noise: 0.0 }
}

/// Relative amplitude of an echo that, concentrated in one cell and with all channels added in phase, is as
/// strong as the noise of the map; 0 without noise. This is on the safe side: a body is spread over more
/// cells, and omitted parts are weaker in each of them.
fn noise(header: &SceneHeader, index: u32, amplitude_m: &[Complex64]) -> f64 {
    let (radar, waveform) = (&header.radar, &header.radar.waveform);
    let channels = radar.virtual_channels() as f64;
    let bodies = scene::bodies_in_view(header, index).len().max(1) as f64;
    let power_ratio = match header.noise {
        Noise::Absent => 0.0,
        Noise::SnrDb(db) => 1.0 / (power_from_db(db) * bodies * channels),
        Noise::Figure { noise_figure_db, temperature_k } => {
            let noise_w =
                BOLTZMANN_J_PER_K * temperature_k * power_from_db(noise_figure_db) * waveform.sample_rate_hz;
            let mean_m2 =
                amplitude_m.iter().map(|s| s.norm_sqr()).sum::<f64>() / amplitude_m.len().max(1) as f64;
            let echo_w = radar::link::link_amplitude(radar).powi(2) * mean_m2;
            let gain = f64::from(waveform.samples) * chirps_of_channel(radar) * channels;
            noise_w / (echo_w * gain).max(f64::MIN_POSITIVE)
        }
    };
    power_ratio.sqrt()
}

/// Chirps in which a transmitter sends to a channel, all of them added in phase: with codes (BPM) all slots
/// of all blocks, each decoded.
fn chirps_of_channel(radar: &Radar) -> f64 {
    let slots = if radar.array.multiplexing == Multiplexing::Bpm { radar.slots() } else { 1 };
    f64::from(radar.waveform.chirps) * slots as f64
}

impl EchoShares {
    /// The larger of each share.
    fn larger(self, other: Self) -> Self {
        let each = |a: Vec<f64>, b: Vec<f64>| a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect();
        let either = |a: Option<Vec<f64>>, b: Option<Vec<f64>>| match (a, b) {
            (Some(a), Some(b)) => Some(each(a, b)),
            (a, b) => a.or(b),
        };
        Self {
            within: each(self.within, other.within),
            between: each(self.between, other.between),
            nodes: self.nodes.max(other.nodes),
            road: either(self.road, other.road),
            whole_with_road: self.whole_with_road.min(other.whole_with_road),
            edges: each(self.edges, other.edges),
            sheets: self.sheets.max(other.sheets),
            noise: self.noise.min(other.noise),
        }
    }

    /// The shares relative to the whole echo with the road. Node rules and sheets change paths by the road as
    /// much as direct ones.
    pub(crate) fn over_road(&self) -> Self {
        let whole = self.whole_with_road.max(f64::MIN_POSITIVE);
        let of = |share: &f64| share / whole;
        Self {
            within: self.within.iter().map(of).collect(),
            between: self.between.iter().map(of).collect(),
            nodes: self.nodes,
            road: self.road.as_ref().map(|road| road.iter().map(of).collect()),
            whole_with_road: 1.0,
            edges: self.edges.iter().map(of).collect(),
            sheets: self.sheets,
            noise: of(&self.noise),
        }
    }

    /// Share of the paths of this order by the road; 0 if they cannot be traced.
    pub(crate) fn by_road(&self, order: u8) -> f64 {
        of_order(self.road.as_deref().unwrap_or_default(), order)
    }

    /// Share of the paths of this order to edges; 0 beyond the orders looked at.
    pub(crate) fn by_edges(&self, order: u8) -> f64 {
        of_order(&self.edges, order)
    }
}

fn of_order(shares: &[f64], order: u8) -> f64 {
    usize::from(order).checked_sub(1).and_then(|at| shares.get(at)).copied().unwrap_or(0.0)
}

/// Amplitude of shares whose powers add up.
pub(crate) fn together(shares: &[f64]) -> f64 {
    shares.iter().map(|share| share.powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 2 m × 1 m × 1 m without a bottom.
    const BOX: &str = "v -1 -0.5 0\nv 1 -0.5 0\nv 1 0.5 0\nv -1 0.5 0\nv -1 -0.5 1\nv 1 -0.5 1\nv 1 0.5 1\n\
                       v -1 0.5 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    /// The box before a radar that sends little, and a point that scatters as much as a truck's corner.
    const BOX_AND_POINT: &str = "name = \"shares\"\n[radar.array]\npreset = \"1x4\"\n[radar.waveform]\n\
        samples = 64\nchirps = 16\n[radar.link]\ntransmit_power_dbm = -20.0\n[noise]\n\
        noise_figure_db = 12.0\n[[target]]\nkind = \"mesh\"\nid = \"box\"\nmodel = \"box.obj\"\n\
        position_m = [2.0, 14.0, 0.0]\n[[target]]\nkind = \"point\"\nid = \"point\"\nrcs_m2 = 1000.0\n\
        position_m = [-2.0, 13.0, 1.0]\n";

    /// Shares in a scene of this text.
    fn shares_in(text: &str) -> EchoShares {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        std::fs::write(folder.path().join("box.obj"), BOX).unwrap();
        std::fs::write(&file, text).unwrap();
        let header = scene::read(&file, &scene::ReadOptions::whole()).unwrap();
        let said = scene::physics_keys(&file, &[]).unwrap();
        let tracer = tracer(&header, Allowance::of(None)).unwrap();
        shares(&header, &said, &tracer).unwrap().unwrap()
    }

    #[test]
    fn shares_and_noise_are_those_in_the_echo_of_bodies_and_point_targets() {
        let (bodies, _) = BOX_AND_POINT.split_once("[[target]]\nkind = \"point\"").unwrap();
        let [alone, beside] = [bodies, BOX_AND_POINT].map(shares_in);
        assert!(alone.noise > 0.1, "a weak body: {alone:?}");
        assert!(beside.noise < 0.1, "a strong point: {beside:?}");
        let falls = |of: fn(&EchoShares) -> f64| of(&beside) / of(&alone);
        let by = falls(|of| of.within[0]);
        assert!(by < 0.1 && (falls(|of| of.by_edges(1)) / by - 1.0).abs() < 1e-9, "{by}: {beside:?}");
    }
}
