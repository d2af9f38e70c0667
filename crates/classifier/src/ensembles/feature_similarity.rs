//! Similarity of two sets of sightings: the area under the ROC curve for distinguishing them by one number.

use crate::ensembles::vehicles::Sighting;
use crate::signatures::features::names;

/// Share of pairs, one of each set, in which the second set's value is greater, ties counted half; folded, so
/// that 0.5 means equal and 1 distinct (Mann & Whitney 1947; Hanley & McNeil 1982). `None` without a pair.
pub fn area_under_roc(first: &[f32], second: &[f32]) -> Option<f64> {
    let mut sorted = first.to_vec();
    sorted.sort_by(f32::total_cmp);
    let below = |value: &f32| {
        let less = sorted.partition_point(|v| v < value);
        let not_more = sorted.partition_point(|v| v <= value);
        0.5 * (less + not_more) as f64
    };
    let pairs = (first.len() * second.len()) as f64;
    let area = second.iter().map(below).sum::<f64>() / pairs;
    (pairs > 0.0).then(|| area.max(1.0 - area))
}

/// Similarity of two sets by a feature, over the sightings of one class; for heights only those by arrays
/// with rows.
pub fn feature_similarity(
    feature: &str,
    class: usize,
    first: &[&Sighting],
    second: &[&Sighting],
) -> Option<f64> {
    let column = names().iter().position(|name| *name == feature)?;
    let needs_rows = feature.contains("height");
    let values = |seen: &[&Sighting]| -> Vec<f32> {
        let kept = seen.iter().filter(|seen| seen.class == class && (seen.has_rows || !needs_rows));
        kept.map(|seen| seen.features[column]).collect()
    };
    area_under_roc(&values(first), &values(second))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_is_that_of_counting_all_pairs() {
        let (first, second) = ([1.0, 4.0, 4.0, 7.0, 2.0], [4.0, 9.0, 0.0]);
        let pairs = first.iter().flat_map(|a| second.iter().map(move |b| (a, b)));
        let counted: f64 = pairs
            .map(|(a, b)| {
                if b > a {
                    1.0
                } else if b == a {
                    0.5
                } else {
                    0.0
                }
            })
            .sum::<f64>()
            / 15.0;
        let area = area_under_roc(&first, &second).unwrap();
        assert!((area - counted.max(1.0 - counted)).abs() < 1e-12, "{area} {counted}");
    }

    #[test]
    fn equal_sets_are_alike_and_parted_ones_apart() {
        let values = [1.0, 2.0, 3.0];
        assert_eq!(area_under_roc(&values, &values), Some(0.5));
        assert_eq!(area_under_roc(&[4.0, 5.0], &values), Some(1.0));
        assert_eq!(area_under_roc(&[], &values), None);
    }
}
