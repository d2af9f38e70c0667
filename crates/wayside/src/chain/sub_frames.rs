//! Velocities of a cycle's sub-frames, each told by the next one's other chirp interval.

use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::radar::Multiplexing;
use dsp::velocity_folds::{SubFrame, resolved};

/// Frame records that belong together: the sub-frames of a cycle.
pub(crate) fn in_cycle(header: &CubeHeader) -> usize {
    header.radar.schedule.sub_frames() as usize
}

/// The points of a whole cycle with their velocities resolved. Left as they are where there is one sub-frame,
/// and under time division of chirps at changing intervals: there a velocity's fold would turn the directions
/// too.
pub(crate) fn with_velocities(header: &CubeHeader, points: Vec<PointsFrame>) -> Vec<PointsFrame> {
    let turns_directions =
        header.radar.array.multiplexing == Multiplexing::Tdm && !header.radar.schedule.is_uniform();
    if points.len() < 2 || turns_directions {
        return points;
    }
    let headers: Vec<CubeHeader> = points.iter().map(|points| header.in_frame(points.index)).collect();
    let sub_frame = |i: usize| {
        let (header, points) = (&headers[i], &points[i]);
        SubFrame { header, middle_s: points.time_s + header.radar.frame_middle_s(), points }
    };
    (0..points.len()).map(|i| resolved(&sub_frame(i), &sub_frame((i + 1) % points.len()))).collect()
}
