//! Changes between two results: bodies lost and gained, and differences of the values of those in both.

use crate::study::pages::sensitivity::run_results::{BodyEstimate, EstimatesByBody};

/// Changes between two results.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Changes {
    /// Number of bodies in the first result, frame by frame.
    pub(super) there: usize,
    /// Number of them that the second lacks.
    pub(super) lost: usize,
    /// Number of bodies only in the second.
    pub(super) gained: usize,
    pub(super) range_m: Vec<f64>,
    pub(super) velocity_mps: Vec<f64>,
    pub(super) azimuth_deg: Vec<f64>,
    /// Change of the probability of the true class.
    pub(super) probability: Vec<f64>,
    /// Number of bodies in both with another lane, and of all in both.
    pub(super) lanes: (usize, usize),
    /// Number of bodies in both with another class, and of those with a class in both.
    pub(super) classes: (usize, usize),
}

impl Changes {
    pub(super) fn between(first: &EstimatesByBody, second: &EstimatesByBody) -> Self {
        let mut changes = Self { there: first.len(), ..Self::default() };
        changes.gained = second.keys().filter(|key| !first.contains_key(*key)).count();
        for (key, before) in first {
            match second.get(key) {
                Some(after) => changes.add(before, after),
                None => changes.lost += 1,
            }
        }
        changes
    }

    fn add(&mut self, before: &BodyEstimate, after: &BodyEstimate) {
        self.range_m.push(after.range_m - before.range_m);
        self.velocity_mps.push(after.velocity_mps - before.velocity_mps);
        self.azimuth_deg.push(angle_difference_deg(before.azimuth_deg, after.azimuth_deg));
        self.lanes = add_to_ratio(self.lanes, usize::from(before.lane != after.lane));
        if before.class.is_some() && after.class.is_some() {
            self.classes = add_to_ratio(self.classes, usize::from(before.class != after.class));
        }
        self.probability.extend(before.probability.zip(after.probability).map(|(a, b)| b - a));
    }

    /// Changes of both together.
    pub(super) fn and(self, more: Self) -> Self {
        let both = |a: (usize, usize), b: (usize, usize)| (a.0 + b.0, a.1 + b.1);
        Self {
            there: self.there + more.there,
            lost: self.lost + more.lost,
            gained: self.gained + more.gained,
            range_m: [self.range_m, more.range_m].concat(),
            velocity_mps: [self.velocity_mps, more.velocity_mps].concat(),
            azimuth_deg: [self.azimuth_deg, more.azimuth_deg].concat(),
            probability: [self.probability, more.probability].concat(),
            lanes: both(self.lanes, more.lanes),
            classes: both(self.classes, more.classes),
        }
    }
}

fn add_to_ratio((found, of): (usize, usize), more: usize) -> (usize, usize) {
    (found + more, of + 1)
}

/// Angle from one azimuth to another, by the shorter way.
fn angle_difference_deg(before: f64, after: f64) -> f64 {
    (after - before + 180.0).rem_euclid(360.0) - 180.0
}

/// Root mean square; `None` without values.
pub(super) fn rms(values: &[f64]) -> Option<f64> {
    let squares: f64 = values.iter().map(|x| x * x).sum();
    (!values.is_empty()).then(|| (squares / values.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::settings::Class;
    use wayside::outcome::summary::Predicted;

    const CAR: BodyEstimate = BodyEstimate {
        range_m: 40.0,
        velocity_mps: -10.0,
        azimuth_deg: 179.5,
        lane: Some(2),
        class: Some(Predicted::Class(Class::Car)),
        probability: Some(0.9),
    };

    fn told(bodies: &[(&str, BodyEstimate)]) -> EstimatesByBody {
        bodies.iter().map(|(id, said)| ((0, 0, (*id).to_owned()), *said)).collect()
    }

    #[test]
    fn bodies_in_one_answer_alone_are_lost_or_gained_and_those_in_both_compared() {
        let first = told(&[("a", CAR), ("b", CAR)]);
        let other = BodyEstimate {
            range_m: 40.5,
            azimuth_deg: -179.5,
            lane: None,
            class: Some(Predicted::Unknown),
            probability: Some(0.6),
            ..CAR
        };
        let changes = Changes::between(&first, &told(&[("b", other), ("c", CAR)]));
        assert_eq!((changes.there, changes.lost, changes.gained), (2, 1, 1));
        assert_eq!((changes.lanes, changes.classes), ((1, 1), (1, 1)));
        assert_eq!((&changes.range_m[..], &changes.azimuth_deg[..]), (&[0.5][..], &[1.0][..]));
        assert!((changes.probability[0] + 0.3).abs() < 1e-12);
        let both = Changes::between(&first, &first).and(changes);
        assert_eq!((both.there, both.lanes, both.range_m.len()), (4, (1, 3), 3));
    }

    #[test]
    fn the_root_of_the_mean_square_of_nothing_is_none() {
        assert_eq!((rms(&[3.0, -4.0, 0.0, 0.0]), rms(&[])), (Some(2.5), None));
    }
}
