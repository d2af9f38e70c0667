//! Probabilities of classes.

use artifact::settings::Class;
use serde::{Deserialize, Serialize};

/// Probability of each class, from 0 to 1; `None` if nothing was classified.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Probabilities {
    /// Probability of a car.
    pub car: Option<f64>,
    /// Probability of a bus.
    pub bus: Option<f64>,
    /// Probability of a truck.
    pub truck: Option<f64>,
    /// Probability of a motorcycle.
    pub motorcycle: Option<f64>,
}

impl Probabilities {
    /// Makes probabilities from a classifier's values in the order of [`Class::ALL`].
    pub fn of(values: Option<&[f32; 4]>) -> Self {
        let [car, bus, truck, motorcycle] = [0, 1, 2, 3].map(|i| values.map(|values| f64::from(values[i])));
        Self { car, bus, truck, motorcycle }
    }

    /// Probability of one class; `None` if nothing was classified.
    pub fn of_class(&self, class: Class) -> Option<f64> {
        match class {
            Class::Car => self.car,
            Class::Bus => self.bus,
            Class::Truck => self.truck,
            Class::Motorcycle => self.motorcycle,
        }
    }

    /// The likeliest class; among equally likely ones the last by name.
    pub fn likeliest(&self) -> Option<(Class, f64)> {
        let known = Class::ALL.into_iter().filter_map(|class| Some((class, self.of_class(class)?)));
        known.max_by(|a, b| a.1.total_cmp(&b.1).then(a.0.name().cmp(b.0.name())))
    }
}
