//! Rules between and within the steps of a recording: time increases, and no vehicle occurs twice.

/// State after the steps so far.
#[derive(Default)]
pub(crate) struct StepOrder {
    last_time_s: Option<f64>,
}

/// A rule of the order that a step breaks.
pub(crate) enum Disorder {
    /// Time does not come after that of the step before.
    TimeNotGrowing { before_s: f64 },
    /// A vehicle occurs twice, the second time at this line or in this message.
    Twice { id: String, line: u64 },
}

impl StepOrder {
    /// Checks and adds a step by its time and the ids of its vehicles with their lines.
    pub(crate) fn check<'a>(
        &mut self,
        time_s: f64,
        vehicles: impl Iterator<Item = (&'a str, u64)>,
    ) -> Result<(), Disorder> {
        if let Some(before_s) = self.last_time_s.filter(|before| time_s <= *before) {
            return Err(Disorder::TimeNotGrowing { before_s });
        }
        let mut ids: Vec<(&str, u64)> = vehicles.collect();
        ids.sort_unstable();
        if let Some(pair) = ids.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(Disorder::Twice { id: pair[1].0.to_owned(), line: pair[1].1 });
        }
        self.last_time_s = Some(time_s);
        Ok(())
    }
}
