//! Truth beside estimates: how well anybody's points, objects and tracks agree with a scene.
//!
//! In go what a scene's artifacts hold (poses, and where they were traced the paths of its echoes) and what a
//! radar made of them ([`PointsFrame`](artifact::points::PointsFrame),
//! [`TracksFrame`](artifact::tracks::TracksFrame)), by whatever program; out come whose each detection is and
//! what is missed and false. Only reports come here: nothing behind the radar cube reads it.
//!
//! - [`Truth`]: where a body stands, how it moves, where its echo comes from; [`GroundOutline`] the ground
//!   that it covers;
//! - [`Pairing`]: which object is whose, within a gate of place and velocity;
//! - [`Origin`]: what made a point: a body, the ground, noise; over how many bounces and bodies;
//! - [`CellOrigins`]: whose echo fills each cell of a range-Doppler map most;
//! - [`FrameTruth`]: all of it for one frame;
//! - [`Score`] over a run: GOSPA, OSPA, lanes, identities of tracks ([`Metrics`]).
//!
//! ```
//! use artifact::points::PointsFrame;
//! use artifact::scene::{SceneFrame, SceneHeader};
//! use artifact::tracks::TracksFrame;
//! use evaluation::{FrameTruth, Metrics, Score};
//!
//! /// How well points agree with a scene without recorded traffic.
//! fn agreement(scene: &SceneHeader, frames: &[(SceneFrame, PointsFrame, TracksFrame)]) -> Metrics {
//!     let mut score = Score::default();
//!     for (poses, points, tracks) in frames {
//!         let truth = FrameTruth::of(scene, poses, None, &points.objects);
//!         score.add(&truth, &points.objects, tracks);
//!     }
//!     score.metrics()
//! }
//! ```

mod ground_outline; // the ground that a body covers
mod truth; // what is true of each body
mod metrics; // distances of sets of places
mod pairing; // whose an object is
mod doppler_response; // what rows have of a tone
mod labels; // what made a point
mod cell_labels; // what made a cell of the map
mod frame_truth; // all that is true of a frame
mod score; // over a run

pub use cell_labels::{CellOrigins, cell_origins};
pub use frame_truth::FrameTruth;
pub use ground_outline::GroundOutline;
pub use labels::{Group, Origin, origins};
pub use metrics::gospa::{Gospa, gospa};
pub use metrics::identities::Identities;
pub use metrics::ospa::ospa_m;
pub use pairing::{GATE_M, Pairing, Reach, VELOCITY_GATE_MPS, place};
pub use score::{Agreement, CUTOFF_M, IdentityMetrics, Metrics, Score, believed, bodies_of_tracks};
pub use truth::{MeanEcho, Truth, truths};
