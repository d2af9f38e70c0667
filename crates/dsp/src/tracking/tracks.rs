//! Tracks: bodies followed over frames by one Kalman filter each, with objects associated by global nearest
//! neighbour.
//!
//! In each frame every track is predicted; objects within the gate are assigned to tracks so that the joint
//! likelihood is maximal ([`radar::assignment`]); a remaining object in the box of a confirmed track is
//! another piece of the same body; any other starts a track, which is confirmed once seen in M of its first N
//! frames. A track without an object coasts on its prediction and is deleted after a while, later if
//! another's object covers its position, sooner if it leaves the radar's range.
//!
//! Velocities that a map measures modulo its span are tracked as several hypotheses
//! ([`crate::tracking::velocity_bank`]) until the range determines which is true; a track states this.

use crate::error::DspError;
use crate::plan::measurable_lanes;
use crate::spectrum::shapes::Shapes;
use crate::tracking::body::Body;
use crate::tracking::kalman::Estimate;
use crate::tracking::measurement::{Measurement, Site, turned};
use crate::tracking::tracker_settings::TrackerSettings;
use crate::tracking::velocity_bank::VelocityBank;
use artifact::cube::CubeHeader;
use artifact::points::{Object, PointsFrame};
use artifact::settings::Lanes;
use artifact::tracks::{Track, TrackState, TracksFrame};
use glam::{DMat2, DVec2};
use ndarray::Array2;
use radar::aperture::horizontal;
use radar::assignment::assignment;
use std::f64::consts::{FRAC_PI_2, PI};

/// Distance from a confirmed track's box within which an object of equal velocity is a piece of it: cars in a
/// queue leave 2 m between them.
const PIECE_MARGIN_M: f64 = 1.0;
/// Maximum velocity difference between pieces of one body.
const PIECE_MPS: f64 = 1.0;
/// Weight of a frame in which another's object covers the position, relative to a frame without any: a body
/// that merges with its neighbour or is shadowed by it reappears.
const COVERED: f64 = 0.2;

/// Tracks the objects of one radar, frame by frame.
#[derive(Debug, Clone)]
pub struct Tracker {
    header: CubeHeader,
    settings: TrackerSettings,
    /// Lanes that bodies can be assigned to.
    lanes: Lanes,
    /// Sites of the cycle's sub-frames.
    sites: Vec<Site>,
    tracks: Vec<ActiveTrack>,
    next_id: u32,
    last_time_s: Option<f64>,
}

/// A track with its filters and history.
#[derive(Debug, Clone)]
struct ActiveTrack {
    id: u32,
    age_frames: u32,
    seen_frames: u32,
    missed_frames: u32,
    unseen_s: f64,
    seen_s: f64,
    is_confirmed: bool,
    bank: VelocityBank,
    body: Body,
    objects: Vec<u32>,
}

impl Tracker {
    /// Tracker of a radar, without tracks.
    pub fn new(header: &CubeHeader, settings: TrackerSettings) -> Result<Self, DspError> {
        Shapes::of(header)?;
        let sub_frames = 0..header.radar.schedule.sub_frames();
        let sites = sub_frames.map(|index| Site::new(&header.radar.in_frame(index))).collect();
        Ok(Self {
            header: header.clone(),
            settings,
            lanes: measurable_lanes(header),
            sites,
            tracks: vec![],
            next_id: 0,
            last_time_s: None,
        })
    }

    /// Processes the next frame's objects; truth that a report has joined to its points is not read.
    ///
    /// Refuses non-finite objects and a frame that is not later than the one before it.
    pub fn step(&mut self, frame: &PointsFrame) -> Result<TracksFrame, DspError> {
        frame.objects.iter().try_for_each(check_object)?;
        let interval_s = self.interval_s(frame.time_s)?;
        let site = &self.sites[frame.index as usize % self.sites.len()];
        let measurements: Vec<Measurement> =
            frame.objects.iter().map(|o| site.measurement(o, &self.settings)).collect();
        self.predict(interval_s);
        let assigned = self.associate(&measurements);
        let mut owner = assigned.clone();
        self.associate_fragments(frame, &measurements, &mut owner);
        self.update(frame, &measurements, &assigned, &owner);
        self.initiate_tracks(frame, &measurements, &mut owner);
        self.update_history(interval_s, frame, &measurements);
        self.merge_duplicates();
        self.delete_stale();
        let tracks = self.tracks.iter().map(|f| self.track(f)).collect();
        Ok(TracksFrame { index: frame.index, time_s: frame.time_s, tracks })
    }

    /// Position and range cells, common to all sub-frames.
    fn site(&self) -> &Site {
        &self.sites[0]
    }

    fn interval_s(&mut self, time_s: f64) -> Result<f64, DspError> {
        let last_s = self.last_time_s;
        match last_s {
            _ if !time_s.is_finite() => Err(DspError::FrameTime { last_s, found_s: time_s }),
            Some(last) if time_s <= last => Err(DspError::FrameTime { last_s, found_s: time_s }),
            _ => {
                self.last_time_s = Some(time_s);
                Ok(last_s.map_or(0.0, |last| time_s - last))
            }
        }
    }

    fn predict(&mut self, interval_s: f64) {
        for active in &mut self.tracks {
            active.bank.predict(interval_s, self.settings.acceleration_density);
            active.objects.clear();
        }
    }

    /// Finds the track (by index in the list) of each object.
    ///
    /// A pair costs −2 ln of its density, a track without object −2 ln of the density of an unexplained
    /// object in its place: the likelihood ratio of Blackman and Popoli, *Modern Tracking Systems*, 1999,
    /// §6.2.
    fn associate(&self, measurements: &[Measurement]) -> Vec<Option<usize>> {
        let settings = &self.settings;
        let odds = settings.detection_probability
            / (1.0 - settings.detection_probability)
            / settings.new_object_density;
        let costs = Array2::from_shape_fn((self.tracks.len(), measurements.len()), |(track, object)| {
            let fit = self.tracks[track].bank.fit(&measurements[object]);
            if fit.distance2 <= settings.gate_distance2 { fit.neg2_log_likelihood } else { f64::INFINITY }
        });
        let mut owner = vec![None; measurements.len()];
        for (track, object) in assignment(costs.view(), 2.0 * odds.ln()).into_iter().enumerate() {
            if let Some(object) = object {
                owner[object] = Some(track);
            }
        }
        owner
    }

    /// Assigns remaining objects in the box of a confirmed track, moving as it does, to it as pieces.
    fn associate_fragments(
        &self,
        frame: &PointsFrame,
        measurements: &[Measurement],
        owner: &mut [Option<usize>],
    ) {
        let confirmed = || self.tracks.iter().enumerate().filter(|(_, f)| f.is_confirmed);
        for (object, owner) in owner.iter_mut().enumerate().filter(|(_, o)| o.is_none()) {
            let place = on_road(&frame.objects[object]);
            *owner = confirmed()
                .find(|(_, f)| {
                    let moves_along = rate_apart_mps(f, &measurements[object]).abs() <= PIECE_MPS;
                    moves_along
                        && f.body.contains(f.bank.best(), place, self.settings.body_width_m, PIECE_MARGIN_M)
                })
                .map(|(track, _)| track);
        }
    }

    fn update(
        &mut self,
        frame: &PointsFrame,
        measurements: &[Measurement],
        assigned: &[Option<usize>],
        owner: &[Option<usize>],
    ) {
        let (first, pieces): (Vec<usize>, Vec<usize>) =
            (0..owner.len()).partition(|object| assigned[*object].is_some());
        for object in first.into_iter().chain(pieces) {
            let Some(track) = owner[object] else { continue };
            let active = &mut self.tracks[track];
            // Among several objects the filter uses the assigned one; if there is none, the strongest, which
            // comes first.
            if active.objects.is_empty() {
                active.bank.update(&measurements[object]);
            }
            active.objects.push(object as u32);
        }
        let range_cell_m = self.site().range_cell_m();
        for active in self.tracks.iter_mut().filter(|f| !f.objects.is_empty()) {
            active.update_box(frame, range_cell_m);
        }
    }

    fn initiate_tracks(
        &mut self,
        frame: &PointsFrame,
        measurements: &[Measurement],
        owner: &mut [Option<usize>],
    ) {
        for object in (0..measurements.len()).filter(|o| owner[*o].is_none()) {
            let bank = VelocityBank::new(&measurements[object], &self.settings);
            let body = Body::new(self.first_heading_rad(bank.best()));
            let mut active = ActiveTrack {
                id: self.next_id,
                age_frames: 0,
                seen_frames: 0,
                missed_frames: 0,
                unseen_s: 0.0,
                seen_s: 0.0,
                is_confirmed: false,
                bank,
                body,
                objects: vec![object as u32],
            };
            active.update_box(frame, self.site().range_cell_m());
            self.next_id += 1;
            self.tracks.push(active);
        }
    }

    /// Heading of a new body along the road, towards the radar unless it moves away.
    fn first_heading_rad(&self, state: &Estimate) -> f64 {
        let away_rad = FRAC_PI_2 - self.header.dsp.road.azimuth_rad;
        let away_mps = DVec2::from_angle(away_rad).dot(DVec2::new(state.mean.z, state.mean.w));
        turned(if away_mps > 0.0 { away_rad } else { away_rad - PI })
    }

    fn update_history(&mut self, interval_s: f64, frame: &PointsFrame, measurements: &[Measurement]) {
        let covers = |f: &ActiveTrack| {
            (0..measurements.len()).any(|o| self.covers(&frame.objects[o], &measurements[o], f))
        };
        let covered: Vec<bool> = self.tracks.iter().map(|f| f.objects.is_empty() && covers(f)).collect();
        for (active, is_covered) in self.tracks.iter_mut().zip(covered) {
            active.age_frames += 1;
            if active.objects.is_empty() {
                active.missed_frames += 1;
                active.unseen_s += interval_s * if is_covered { COVERED } else { 1.0 };
            } else {
                (active.missed_frames, active.unseen_s) = (0, 0.0);
                active.seen_frames += 1;
                active.seen_s += interval_s;
                active.is_confirmed |= active.seen_frames >= self.settings.confirmed_by;
            }
        }
    }

    /// Whether an object covers the range and velocity predicted for a track's own, in its direction: points
    /// that close across form one object in clustering.
    fn covers(&self, object: &Object, measurement: &Measurement, active: &ActiveTrack) -> bool {
        let range_m = self.range_m(active, measurement.up_m);
        let across_m = measurement.azimuth_residual_rad(active.bank.best()).sin().abs() * range_m;
        if across_m > self.header.dsp.cluster_cross_m {
            return false;
        }
        let [near, far] = object.range_extent_m;
        let reach = near - self.site().range_cell_m()..=far + self.site().range_cell_m();
        reach.contains(&range_m) && rate_apart_mps(active, measurement).abs() <= PIECE_MPS
    }

    fn range_m(&self, active: &ActiveTrack, up_m: f64) -> f64 {
        let mean = active.bank.best().mean;
        (DVec2::new(mean.x, mean.y) - self.site().place_m()).length().hypot(up_m)
    }

    /// Merges a younger track in the box of an older confirmed one, at its velocity, into the older: both are
    /// the same body.
    fn merge_duplicates(&mut self) {
        let mut kept: Vec<ActiveTrack> = Vec::new();
        for younger in std::mem::take(&mut self.tracks) {
            let state = younger.bank.best();
            let place = DVec2::new(state.mean.x, state.mean.y);
            let older = kept.iter_mut().filter(|f| f.is_confirmed).find(|f| {
                f.body.contains(f.bank.best(), place, self.settings.body_width_m, PIECE_MARGIN_M)
                    && moves_like(state, f.bank.best())
            });
            match older {
                Some(older) => {
                    // A track that coasted goes on as the one that saw their body.
                    if older.objects.is_empty() && !younger.objects.is_empty() {
                        (older.missed_frames, older.unseen_s) = (0, 0.0);
                        (older.bank, older.body) = (younger.bank, younger.body);
                    }
                    older.objects.extend(younger.objects);
                }
                None => kept.push(younger),
            }
        }
        self.tracks = kept;
    }

    fn delete_stale(&mut self) {
        let radar = &self.header.radar;
        let ahead = DVec2::from(horizontal(radar.boresight_az_rad));
        let (settings, place_m, far_m) = (self.settings, self.site().place_m(), radar.waveform.range_max_m());
        self.tracks.retain(|f| {
            let mean = f.bank.best().mean;
            let away_m = DVec2::new(mean.x, mean.y) - place_m;
            // No array sees behind itself.
            let is_in_view = away_m.length() <= far_m && away_m.dot(ahead) > 0.0;
            let [least_s, most_s] = settings.coast_s;
            let coast_s = (settings.coast_share * f.seen_s).clamp(least_s, most_s);
            let lives =
                if f.is_confirmed { f.unseen_s < coast_s } else { f.age_frames < settings.confirmed_within };
            mean.is_finite() && lives && (is_in_view || f.missed_frames == 0)
        });
    }

    fn track(&self, active: &ActiveTrack) -> Track {
        let state = active.bank.best();
        let footprint = active.body.footprint(state, self.settings.body_width_m, self.site().place_m());
        let [x_m, y_m] = footprint.centre_m;
        Track {
            id: active.id,
            state: match (active.is_confirmed, active.objects.is_empty()) {
                (false, _) => TrackState::Tentative,
                (true, false) => TrackState::Confirmed,
                (true, true) => TrackState::Coasting,
            },
            age_frames: active.age_frames,
            missed_frames: active.missed_frames,
            position_m: [state.mean.x, state.mean.y],
            velocity_mps: [state.mean.z, state.mean.w],
            covariance: active.bank.covariance().transpose().to_cols_array_2d(),
            velocity_resolved: active.bank.is_resolved(),
            lane: self.lanes.at([x_m, y_m, 0.0]),
            footprint,
            objects: active.objects.clone(),
        }
    }
}

impl ActiveTrack {
    /// Updates heading and extent of the box from the points of the track's objects.
    fn update_box(&mut self, frame: &PointsFrame, cell_m: f64) {
        let state = *self.bank.best();
        self.body.update_heading(&state);
        let own = frame.points.iter().filter(|p| p.object.is_some_and(|o| self.objects.contains(&o)));
        self.body.update_extent(&state, own.map(|p| DVec2::new(p.position_m[0], p.position_m[1])), cell_m);
    }
}

/// Whether two velocities agree within [`PIECE_MPS`] or within their uncertainty: two degrees of freedom, 99
/// of 100.
fn moves_like(a: &Estimate, b: &Estimate) -> bool {
    let apart = DVec2::new(a.mean.z - b.mean.z, a.mean.w - b.mean.w);
    let both = a.covariance + b.covariance;
    let covariance =
        DMat2::from_cols(DVec2::new(both.z_axis.z, both.z_axis.w), DVec2::new(both.w_axis.z, both.w_axis.w));
    apart.length() <= PIECE_MPS || apart.dot(covariance.inverse() * apart) <= 9.2
}

/// Measured minus predicted radial velocity, on the velocity circle.
fn rate_apart_mps(active: &ActiveTrack, measurement: &Measurement) -> f64 {
    measurement.rate_residual_mps(active.bank.best())
}

fn on_road(object: &Object) -> DVec2 {
    DVec2::new(object.position_m[0], object.position_m[1])
}

fn check_object(object: &Object) -> Result<(), DspError> {
    for (quantity, is_finite) in [
        ("range", object.range_m.is_finite() && object.range_extent_m.iter().all(|x| x.is_finite())),
        (
            "velocity",
            object.radial_velocity_mps.is_finite()
                && object.velocity_extent_mps.iter().all(|x| x.is_finite()),
        ),
        ("azimuth", object.azimuth_rad.is_finite()),
        ("position", object.position_m.iter().all(|x| x.is_finite())),
        ("snr", object.snr_db.is_finite()),
    ] {
        if !is_finite {
            return Err(DspError::ObjectNotFinite { quantity });
        }
    }
    Ok(())
}
