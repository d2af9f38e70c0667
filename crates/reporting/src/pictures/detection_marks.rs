//! Marks of detections, and their meanings; echoes at rest have their own marks if the radar marks them.

use artifact::points::{Object, Point};
use plotting::marks::Mark;

/// Mark of a detected point.
pub(super) fn of_point(point: &Point) -> Mark {
    if point.stationary == Some(true) { Mark::SmallRing } else { Mark::Dot }
}

/// Owner of an object, as far as truth is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Owner {
    /// The object belongs to a body.
    Body,
    Nobody,
    /// Truth is unknown.
    Unknown,
}

/// Mark of an object.
pub(super) fn of_object(object: &Object, owner: Owner) -> Mark {
    match (owner, object.stationary) {
        (Owner::Nobody | Owner::Unknown, Some(true)) => Mark::SquareOutline,
        (Owner::Nobody, _) => Mark::DashedRing,
        (Owner::Body | Owner::Unknown, _) => Mark::Ring,
    }
}

/// Meaning of a point's mark other than the usual one.
pub(super) const POINT_AT_REST: &str = "point at rest";

/// Meaning of an object's mark.
pub(super) fn words(mark: Mark, owner: Owner) -> &'static str {
    match (mark, owner) {
        (Mark::SquareOutline, Owner::Nobody) => "object at rest that is no body's",
        (Mark::SquareOutline, _) => "object at rest",
        (Mark::DashedRing, _) => "false object, # as in the table",
        _ => "object",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::points::Height;

    #[test]
    fn objects_at_rest_look_otherwise_unless_they_are_a_bodys() {
        let object = |stationary| Object { stationary, ..OBJECT };
        let mark = |stationary, owner| of_object(&object(stationary), owner);
        assert_eq!(mark(Some(true), Owner::Nobody), Mark::SquareOutline);
        assert_eq!(mark(Some(true), Owner::Unknown), Mark::SquareOutline);
        assert_eq!(mark(Some(true), Owner::Body), Mark::Ring);
        assert_eq!([mark(Some(false), Owner::Nobody), mark(None, Owner::Nobody)], [Mark::DashedRing; 2]);
        assert_eq!(mark(None, Owner::Unknown), Mark::Ring);
    }

    const OBJECT: Object = Object {
        range_m: 40.0,
        radial_velocity_mps: 0.0,
        velocity_resolved: false,
        azimuth_rad: 0.0,
        position_m: [0.0, 40.0, 0.75],
        lane: None,
        snr_db: 20.0,
        points: 1,
        range_extent_m: [40.0; 2],
        velocity_extent_mps: [0.0; 2],
        ghost_share: None,
        stationary: None,
        height: Height::Assumed,
    };
}
