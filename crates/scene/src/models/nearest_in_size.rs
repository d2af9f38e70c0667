//! The project's own vehicle nearest in size to another program's, given by type and size.

use artifact::settings::Class;
use bodies::vehicles;

/// Vehicle of one of the classes with the nearest mean length, width and height, by the root of the sum of
/// squares; the first of equally near ones.
pub(crate) fn nearest_in_size(classes: &[Class], size_m: [f64; 3]) -> Option<&'static str> {
    let of_classes = |name: &&str| vehicles::class_of(name).is_some_and(|class| classes.contains(&class));
    let apart = |name: &&str| {
        let ranges = vehicles::ranges_m(name)?;
        let squares =
            ranges.iter().zip(size_m).map(|([least, most], told)| (0.5 * (least + most) - told).powi(2));
        Some(squares.sum::<f64>())
    };
    let known = vehicles::names().into_iter().filter(of_classes);
    let known = known.filter_map(|name| Some((name, apart(&name)?)));
    known.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_of_the_size_of_one_of_the_projects_is_that_one() {
        assert_eq!(
            nearest_in_size(&[Class::Bus], [12.0, 2.55, 3.1]).and_then(vehicles::class_of),
            Some(Class::Bus)
        );
        let long = nearest_in_size(&[Class::Truck], [16.5, 2.55, 4.0]).unwrap();
        let [length, ..] = vehicles::ranges_m(long).unwrap();
        assert!(length[1] > 12.0, "{long}");
        assert_eq!(nearest_in_size(&[], [1.0; 3]), None);
    }
}
