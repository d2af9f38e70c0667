//! Evaluation against the ground truth: how well points, objects and tracks of any program agree with a
//! scene.
//!
//! The inputs are a scene's artifacts (poses and, if they were traced, the paths of its echoes) and a radar's
//! detections by any program ([`PointsFrame`](artifact::points::PointsFrame),
//! [`TracksFrame`](artifact::tracks::TracksFrame)). The results are the true origin of each detection, and
//! the missed and false ones. Only reports use them: no processing behind the radar cube does.
//!
//! - [`Truth`]: position and motion of a body, and the place of its echo; [`GroundOutline`]: the ground that
//!   it covers;
//! - [`Pairing`]: the object of each body, within a gate of place and velocity;
//! - [`Origin`]: the cause of a point (a body, the ground, noise), with the bounces and bodies of its path;
//! - [`CellOrigins`]: the strongest echo in each cell of a range-Doppler map;
//! - [`FrameTruth`]: all of these for one frame, from a scene or from a dataset's labels ([`LabelledBox`]);
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
mod truth; // ground truth of each body
mod labelled_box; // bodies of a dataset
mod metrics; // distances between sets of places
mod pairing; // assignment of objects to bodies
mod doppler_response; // response of map rows to a tone
mod beam; // response of a steered array to an echo
mod labels; // origins of points
mod cell_labels; // origins of map cells
mod frame_truth; // ground truth of a frame
mod score; // agreement over a run
#[cfg(test)]
mod test_object; // an object that tests share

pub use cell_labels::{CellOrigins, cell_origins};
pub use frame_truth::FrameTruth;
pub use ground_outline::GroundOutline;
pub use labelled_box::LabelledBox;
pub use labels::{EchoGroup, Origin, origins};
pub use metrics::gospa::{Gospa, gospa};
pub use metrics::identities::Identities;
pub use metrics::ospa::ospa_m;
pub use pairing::{GATE_M, MeasurementLimits, Pairing, VELOCITY_GATE_MPS, ground_position};
pub use score::{Agreement, CUTOFF_M, IdentityMetrics, Metrics, Score, bodies_of_tracks, confirmed_tracks};
pub use truth::{MeanEcho, Truth, truths};
