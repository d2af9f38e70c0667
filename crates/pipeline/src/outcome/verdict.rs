//! Verdict on the requested accuracy: whether it was reached and, if not, the limiting error and a remedy.

use crate::outcome::error_figures::{ErrorFigures, db, decibels};
use crate::outcome::useful_accuracy::UsefulAccuracy;
use crate::planning::choice::AccuracyLimit;
use crate::planning::plan_figures::{PlanFigures, limit_name};
use artifact::accuracy::ModelError;
use artifact::goal::Goal;
use artifact::paths::PathsFrame;
use artifact::settings::Fidelity;
use artifact::units::db_from_amplitude;
use artifact::{Accuracy, ErrorBudget};
use serde::{Deserialize, Serialize};

/// Largest number of frames reported in full; of more, only the worst is.
pub const FRAMES_IN_FULL: usize = 4;

/// Whether the requested accuracy was reached.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AccuracyVerdict {
    /// The largest error allowed, dB relative to the echo.
    pub asked_db: f64,
    /// Part of it that a plan assigns to the computed echo, dB, beside the omitted parts; `None` without a
    /// plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planned_db: Option<f64>,
    /// Result that requires this accuracy; `None` if an accuracy was requested directly.
    #[serde(rename = "for")]
    pub goal: Option<Goal>,
    /// Total error, dB; `None` if it was not estimated, or, with `met`, if it is zero.
    pub reached_db: Option<f64>,
    /// Whether the error is within the request, or with a plan within the part assigned to the computed echo,
    /// if the plan spends no more than was requested. `None` if it was not estimated.
    pub met: Option<bool>,
    /// The name of the largest share of the error.
    pub limited_by: Option<String>,
    /// Useful accuracy, dB: the largest error of the model's method and of the mesh, which no request
    /// reduces; `None` if none was estimated.
    pub of_use_db: Option<f64>,
    /// Advice in sentences: the limiting error and a remedy, if the accuracy was not met, and the useful
    /// accuracy, if a finer one was requested. `None` if neither applies.
    pub advice: Option<String>,
}

/// Requested accuracy of a frame, a table or a scene, with the resulting error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    asked: Accuracy,
    goal: Option<Goal>,
    error: ErrorBudget,
    model: ModelError,
    /// Largest number of nodes of an axis (moments of the frame or places of the array) at which paths were
    /// traced, and the number of all paths; `None` if unknown.
    nodes: Option<(u32, u64)>,
    plan: Option<PlannedAccuracy>,
}

/// Accuracy that a plan was made for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PlannedAccuracy {
    asked_db: f64,
    /// Reason why the plan spends more than was requested; `None` if it does not.
    limit: Option<UsefulLimit>,
}

/// A limit below which a finer accuracy has no use.
#[derive(Debug, Clone, Copy, PartialEq)]
struct UsefulLimit {
    spent_db: f64,
    is_noise: bool,
}

impl PlannedAccuracy {
    fn of(plan: &PlanFigures) -> Self {
        let is_limited = plan.limited_by != limit_name(AccuracyLimit::Requested);
        let is_noise = plan.limited_by == limit_name(AccuracyLimit::Noise);
        let limit = is_limited.then_some(UsefulLimit { spent_db: plan.spent_db, is_noise });
        Self { asked_db: plan.asked_db, limit }
    }

    fn advice(&self) -> Option<String> {
        let UsefulLimit { spent_db, is_noise } = self.limit?;
        let level = decibels(Some(spent_db));
        Some(match is_noise {
            true => format!("The plan spends {level}: what is below that lies in the noise of the map."),
            false => format!(
                "The plan spends {level}: the node rules differ by twice as much, so that nothing finer is of use."
            ),
        })
    }
}

/// Way in which a user requests an accuracy, for the words of advice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestSource {
    /// Keys of a scene.
    Scene,
    /// Options of the command line.
    Options,
}

impl AccuracyVerdict {
    /// Level by which verdicts are compared, dB: infinite if the error is zero or not finite; `None` if it
    /// was not estimated.
    pub fn level_db(&self) -> Option<f64> {
        let endless = |met| if met { f64::NEG_INFINITY } else { f64::INFINITY };
        self.reached_db.or(self.met.map(endless))
    }

    /// Text of the reached error.
    pub fn reached_in_words(&self) -> String {
        match self.level_db() {
            Some(f64::NEG_INFINITY) => "none".into(),
            Some(f64::INFINITY) => "beyond all numbers".into(),
            level => decibels(level),
        }
    }
}

impl Verdict {
    /// Compares a frame's numerical errors with the requested accuracy; errors of the model are zero.
    pub fn of(asked: Accuracy, error: &ErrorBudget) -> Self {
        Self { asked, goal: None, error: *error, model: ModelError::default(), nodes: None, plan: None }
    }

    /// Makes the verdict of a frame; its paths, if known, give the number of nodes.
    pub fn of_paths(asked: &Fidelity, error: &ErrorBudget, paths: Option<&PathsFrame>) -> Self {
        let nodes = |paths: &PathsFrame| {
            paths
                .trace
                .fineness
                .as_ref()
                .map(|fineness| (fineness.moments.max(fineness.places), paths.paths.len() as u64))
        };
        let nodes = paths.and_then(nodes);
        Self { goal: asked.goal, nodes, ..Self::of(asked.accuracy, error) }
    }

    /// Adds the errors of the model, and with them the useful accuracy.
    pub fn with_model_error(self, model: &ModelError) -> Self {
        Self { model: *model, ..self }
    }

    /// Adds the plan of the physics: the accuracy in the settings is then the part that the plan assigns to
    /// the computed echo.
    pub fn with_plan(self, plan: Option<&PlanFigures>) -> Self {
        Self { plan: plan.map(PlannedAccuracy::of), ..self }
    }

    /// Whether the error is within the settings' accuracy, and a plan, if any, spends no more than was
    /// requested; `None` if it was not estimated.
    fn is_met(&self) -> Option<bool> {
        let is_within = self.plan.is_none_or(|plan| plan.limit.is_none());
        self.is_within_settings().map(|is_within_settings| is_within_settings && is_within)
    }

    /// Whether the error is within the accuracy of the settings; `None` if it was not estimated.
    fn is_within_settings(&self) -> Option<bool> {
        // An accuracy converted to decibels and back may differ by rounding.
        self.error.total().map(|total| total <= self.asked.amplitude() * (1.0 + 1e-9))
    }

    /// Name of the largest share of the error; `None` if no share is above zero.
    fn limited_by(&self) -> Option<&'static str> {
        let known = self.error.shares().into_iter().filter_map(|(name, error)| Some((name, error?)));
        known.filter(|(_, error)| *error > 0.0).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(name, _)| name)
    }

    /// Makes the verdict of `summary.json`.
    pub fn for_summary(&self, source: RequestSource) -> AccuracyVerdict {
        AccuracyVerdict {
            asked_db: self.plan.map_or(self.asked.db(), |plan| plan.asked_db),
            planned_db: self.plan.map(|_| self.asked.db()),
            goal: self.goal,
            reached_db: db(self.error.total()),
            met: self.is_met(),
            limited_by: self.limited_by().map(str::to_owned),
            of_use_db: db(self.useful_accuracy().map(|error| error.amplitude)),
            advice: self.advice(source),
        }
    }

    /// Makes the verdict as lines of text.
    pub fn lines(&self, source: RequestSource) -> Vec<String> {
        lines(&self.for_summary(source), &ErrorFigures::of(&self.error))
    }

    fn useful_accuracy(&self) -> Option<UsefulAccuracy> {
        UsefulAccuracy::of(self.asked, &self.error, &self.model)
    }

    /// Advice on the limiting error and on the useful accuracy; `None` if there is none.
    fn advice(&self, source: RequestSource) -> Option<String> {
        let useful = self.plan.map_or_else(|| self.advice_on_use(source), |plan| plan.advice());
        let sentences: Vec<String> = [self.advice_on_limit(source), useful].into_iter().flatten().collect();
        (!sentences.is_empty()).then(|| sentences.join(" "))
    }

    /// Advice if the request is finer than the error of the model, which no integral reduces.
    fn advice_on_use(&self, source: RequestSource) -> Option<String> {
        let useful = self.useful_accuracy().filter(|error| error.amplitude > self.asked.amplitude())?;
        let level = decibels(db(Some(useful.amplitude)));
        let key = match source {
            RequestSource::Scene => "accuracy_db",
            RequestSource::Options => "--accuracy-db",
        };
        Some(format!(
            "The model's largest named error is {level} ({}): {key} below that buys nothing.",
            useful.name
        ))
    }

    /// Advice on the limiting error and its remedy; `None` if the accuracy was reached or nothing is known.
    fn advice_on_limit(&self, source: RequestSource) -> Option<String> {
        let limited_by = self.limited_by().filter(|_| self.is_within_settings() == Some(false))?;
        let (what, help) = match (limited_by, self.nodes) {
            ("freezing", Some((nodes, paths))) => freezing_cause_and_remedy(nodes, paths),
            _ => cause_and_remedy(limited_by, source),
        };
        let help = help.replace("{finer}", &format!("{:.0}", self.finer_db()));
        Some(format!("Limited by {limited_by}: {what}. What would help: {help}."))
    }

    /// Accuracy to request instead, dB: finer than the request by the excess of the error, to a whole dB.
    fn finer_db(&self) -> f64 {
        let reached_db = self.error.total().map_or(self.asked.db(), db_from_amplitude);
        (2.0 * self.asked.db() - reached_db).floor()
    }
}

/// Lines on whether the accuracy was reached: for every frame, or for many frames the worst and their number.
pub fn of_frames(frames: &[(u32, Verdict)]) -> Vec<String> {
    let frame = |(number, verdict): &(u32, Verdict)| {
        let mut lines = verdict.lines(RequestSource::Scene);
        lines[0] = format!("frame {number}: {}", lines[0]);
        lines
    };
    if frames.len() <= FRAMES_IN_FULL {
        return frames.iter().flat_map(frame).collect();
    }
    let missed = frames.iter().filter(|(_, verdict)| verdict.is_met() == Some(false)).count();
    let head =
        format!("accuracy reached in {} of {} frames; the worst:", frames.len() - missed, frames.len());
    let error = |verdict: &Verdict| verdict.error.total().unwrap_or(0.0);
    let worst = frames.iter().max_by(|a, b| error(&a.1).total_cmp(&error(&b.1)));
    std::iter::once(head).chain(worst.into_iter().flat_map(frame)).collect()
}

/// Lines about an accuracy: the request, the result and the shares that make up most of the error; if it was
/// not reached, also the limiting error and a remedy.
pub fn lines(accuracy: &AccuracyVerdict, error_db: &ErrorFigures) -> Vec<String> {
    let asked = asked_in_words(accuracy);
    if accuracy.level_db().is_none() {
        return vec![format!("numerical error not estimated ({asked})")];
    }
    let verdict = if accuracy.met == Some(true) { "reached" } else { "NOT REACHED" };
    let shares: Vec<String> =
        shares_that_matter(error_db).iter().map(|(name, db)| format!("{name} {}", decibels(*db))).collect();
    let shares = if shares.is_empty() { String::new() } else { format!(" ({})", shares.join(", ")) };
    let head = format!("numerical error {}, {asked}: {verdict}{shares}", accuracy.reached_in_words());
    std::iter::once(head).chain(accuracy.advice.clone()).collect()
}

/// The requested accuracy, and the result that requires it.
pub fn asked_in_words(accuracy: &AccuracyVerdict) -> String {
    let goal = accuracy.goal.map_or(String::new(), |goal| format!(" for \"{}\"", goal.name()));
    let asked = format!("{} asked{goal}", decibels(accuracy.asked_db));
    accuracy.planned_db.map_or(asked.clone(), |db| format!("{} planned for {asked}", decibels(db)))
}

/// Shares within 10 dB of the largest, largest first: each of the others changes the total by less than half
/// a decibel.
fn shares_that_matter(error_db: &ErrorFigures) -> Vec<(&'static str, f64)> {
    let estimated = error_db.shares().into_iter().filter_map(|(name, db)| Some((name, db?)));
    let mut shares: Vec<(&str, f64)> = estimated.collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    let largest = shares.first().map_or(0.0, |(_, db)| *db);
    shares.retain(|(_, db)| *db >= largest - 10.0);
    shares
}

/// Explains a share of the error and its remedy; `{finer}` is replaced by a value in dB.
fn cause_and_remedy(share: &str, source: RequestSource) -> (&'static str, &'static str) {
    let is_scene = source == RequestSource::Scene;
    match share {
        "tessellation" => (
            "facets in place of the curved skin err by what coarser ones differ, for normals far apart do \
             not tell the skin between them",
            "a mesh with more triangles, or surface = \"flat\" where the facets are what is meant",
        ),
        "integration" if is_scene => (
            "parts of a body cancel, and what is left of their sum is known to less",
            "accuracy_db = {finer} in [fidelity]",
        ),
        "integration" => (
            "parts of the body cancel, and what is left of their sum is known to less",
            "--accuracy-db {finer}",
        ),
        "dropped" if is_scene => (
            "beams and mirrors too small were given up",
            "accuracy_db = {finer} in [fidelity], or fewer bounces",
        ),
        "dropped" => {
            ("beams and mirrors too small were given up", "--accuracy-db {finer}, or fewer --bounces")
        }
        "freezing" => (
            "bodies move and shadows shift within the frame, and paths follow them only so far",
            "a shorter frame (fewer chirps, shorter intervals), or fewer bounces where bodies reflect each other",
        ),
        "detail" => ("fewer paths stand for all that were traced", "detail = \"paths\" in [fidelity]"),
        "synthesis" => (
            "echoes are summed from tables or by transforms",
            "echo = \"paths\" and a finer accuracy_db in [fidelity]",
        ),
        _ => ("of unknown cause", "a finer accuracy"),
    }
}

/// Explains freezing in a frame whose paths were traced at several nodes, moments of the frame or places of
/// the array: those of the middle are kept where more did not help, or would have been too many paths.
fn freezing_cause_and_remedy(nodes: u32, paths: u64) -> (&'static str, &'static str) {
    if bart_rcs::paths_are_at_limit(nodes, paths) {
        (
            "more moments of the frame, or places of the array, would be more paths than are held: bodies are near, or little is left of an echo whose parts cancel (a flat side off its specular)",
            "a shorter frame (fewer chirps, shorter intervals), a smaller array, or a looser accuracy, which larger cells meet",
        )
    } else if nodes >= bart_rcs::MOMENTS_MAX {
        (
            "ways change faster over the frame or the array than the moments and places follow at which they are traced",
            "a shorter frame (fewer chirps, shorter intervals), slower bodies, or a smaller array",
        )
    } else {
        (
            "more moments of the frame or places of the array did not help, so what is left changes over both together, over the sweep, or with the distance from transmitter to receiver",
            "a smaller array, a shorter frame or a narrower sweep",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(integration: f64, freezing: f64) -> Verdict {
        let error = ErrorBudget {
            integration: Some(integration),
            freezing: Some(freezing),
            ..ErrorBudget::default()
        };
        Verdict::of(Accuracy::from_db(-20.0), &error)
    }

    #[test]
    fn an_accuracy_that_was_not_reached_is_told_with_its_cause_and_what_helps() {
        let missed = of(0.02, 0.24);
        let told = missed.for_summary(RequestSource::Scene);
        assert_eq!((told.met, told.limited_by.as_deref()), (Some(false), Some("freezing")));
        // √(0.02² + 0.24²) = 0.2408: −12.4 dB.
        assert!((told.reached_db.unwrap() + 12.366).abs() < 1e-3, "{told:?}");
        let advice = told.advice.unwrap();
        assert!(advice.contains("freezing") && advice.contains("shorter frame"), "{advice}");
        let lines = missed.lines(RequestSource::Scene);
        assert!(
            lines[0].contains("−12.4 dB") && lines[0].contains("−20.0 dB asked: NOT REACHED"),
            "{lines:?}"
        );
        assert!(!lines[0].contains("integration"), "0.02 changes 0.24 by 0.03 dB: {lines:?}");
    }

    #[test]
    fn an_accuracy_that_was_reached_needs_no_advice_and_one_not_estimated_no_verdict() {
        let met = of(0.05, 0.06).for_summary(RequestSource::Scene);
        assert_eq!((met.met, met.advice, met.limited_by.as_deref()), (Some(true), None, Some("freezing")));
        let unknown =
            Verdict::of(Accuracy::from_db(-20.0), &ErrorBudget::default()).for_summary(RequestSource::Scene);
        assert_eq!((unknown.met, unknown.limited_by, unknown.reached_db), (None, None, None));
        assert!((unknown.asked_db + 20.0).abs() < 1e-12);
    }

    #[test]
    fn a_planned_scene_is_measured_by_its_plan_s_part_and_has_reached_what_the_plan_promises() {
        let plan = |spent_db: f64, limited_by: &str| PlanFigures {
            limited_by: limited_by.into(),
            ..PlanFigures { asked_db: -30.0, spent_db, ..PlanFigures::default() }
        };
        let told = |spent_db, limited_by| of(0.05, 0.06).with_plan(Some(&plan(spent_db, limited_by)));
        let kept = told(-30.0, "asked").for_summary(RequestSource::Scene);
        assert_eq!((kept.asked_db, kept.met, kept.advice), (-30.0, Some(true), None));
        assert!((kept.planned_db.unwrap() + 20.0).abs() < 1e-12);
        let limited = told(-17.8, "nodes");
        assert_eq!(limited.for_summary(RequestSource::Scene).met, Some(false));
        let lines = limited.lines(RequestSource::Scene).join("\n");
        assert!(lines.contains("−20.0 dB planned for −30.0 dB asked: NOT REACHED"), "{lines}");
        assert!(lines.contains("node rules") && lines.contains("spends −17.8 dB"), "{lines}");
        assert!(told(-5.0, "noise").lines(RequestSource::Scene)[1].contains("noise of the map"));
    }

    #[test]
    fn no_error_at_all_is_told_as_none_and_reached() {
        let exact = Verdict::of(
            Accuracy::from_db(-20.0),
            &ErrorBudget { integration: Some(0.0), dropped: Some(0.0), ..ErrorBudget::default() },
        );
        let told = exact.for_summary(RequestSource::Scene);
        assert_eq!((told.met, told.reached_db, told.level_db()), (Some(true), None, Some(f64::NEG_INFINITY)));
        assert_eq!(exact.lines(RequestSource::Scene), ["numerical error none, −20.0 dB asked: reached"]);
    }

    #[test]
    fn every_share_of_a_budget_has_a_cause_and_a_help_of_its_own() {
        for (share, _) in ErrorBudget::default().shares() {
            for source in [RequestSource::Scene, RequestSource::Options] {
                assert_ne!(cause_and_remedy(share, source).0, "of unknown cause", "{share}");
            }
        }
    }

    #[test]
    fn what_to_ask_for_instead_is_finer_by_what_is_missing() {
        // 0.2 is −13.98 dB, 6.02 dB above what was asked.
        let advice = of(0.2, 0.001).advice(RequestSource::Options).unwrap();
        assert!(advice.ends_with("--accuracy-db -27."), "{advice}");
    }

    #[test]
    fn an_accuracy_that_the_model_does_not_have_is_told_as_of_no_use() {
        let model = |nodes| ModelError { nodes: Some(nodes), ..ModelError::default() };
        // −20 dB asked; 0.3 is −10.46 dB.
        let beyond = of(0.02, 0.03).with_model_error(&model(0.3)).for_summary(RequestSource::Scene);
        assert!((beyond.of_use_db.unwrap() + 10.458).abs() < 1e-3, "{beyond:?}");
        let sentence = "The model's largest named error is −10.5 dB (nodes): accuracy_db below that buys \
                        nothing.";
        assert_eq!((beyond.met, beyond.advice.as_deref()), (Some(true), Some(sentence)));
        let missed =
            of(0.2, 0.001).with_model_error(&model(0.3)).for_summary(RequestSource::Options).advice.unwrap();
        let (limit, of_use) = missed.split_once(". The").unwrap();
        assert!(limit.starts_with("Limited by integration") && of_use.contains("--accuracy-db"), "{missed}");
        let enough = of(0.02, 0.03).with_model_error(&model(0.09)).for_summary(RequestSource::Scene);
        assert_eq!(enough.advice, None, "the model is better than asked");
        assert!((enough.of_use_db.unwrap() + 20.915).abs() < 1e-3, "{enough:?}");
        assert_eq!(
            of(0.02, 0.03).for_summary(RequestSource::Scene).of_use_db,
            None,
            "nothing is known of the model"
        );
    }

    #[test]
    fn what_the_accuracy_is_asked_for_is_told_with_it() {
        let for_class = Verdict { goal: Some(Goal::Class), ..of(0.02, 0.03) };
        let told = for_class.for_summary(RequestSource::Scene);
        let lines = lines(&told, &ErrorFigures::of(&for_class.error));
        assert!(lines[0].contains("−20.0 dB asked for \"class\": reached"), "{lines:?}");
        let json = serde_json::to_value(&told).unwrap();
        assert_eq!(json["for"], "class");
        assert_eq!(serde_json::from_value::<AccuracyVerdict>(json).unwrap(), told);
    }

    /// More nodes are no help where all that there are were used, and none where fewer were found to do as
    /// well.
    #[test]
    fn what_helps_against_freezing_depends_on_the_nodes_at_which_the_frame_was_traced() {
        let of_paths = |nodes, paths| {
            let nodes = Some((nodes, paths));
            Verdict { nodes, ..of(0.02, 0.24) }.advice(RequestSource::Scene).unwrap()
        };
        let advice = |nodes| of_paths(nodes, 1000);
        let most = bart_rcs::MOMENTS_MAX;
        let unknown = of(0.02, 0.24).advice(RequestSource::Scene).unwrap();
        assert!(unknown.contains("shorter frame"), "nothing is known of nodes: {unknown}");
        assert!(advice(1).contains("smaller array"), "more were no help: {}", advice(1));
        assert!(advice(most).contains("slower bodies"), "{}", advice(most));
        let full = of_paths(1, 400_000);
        assert!(full.contains("more paths than are held"), "nine times as many would be too many: {full}");
        let fewer = advice(most / 2 + 1);
        assert!(fewer.contains("over both together") && !fewer.contains("slower bodies"), "{fewer}");
        let other =
            Verdict { nodes: Some((most, 1000)), ..of(0.24, 0.02) }.advice(RequestSource::Scene).unwrap();
        assert!(
            other.contains("integration") && !other.contains("slower bodies"),
            "freezing is not what limits: {other}"
        );
    }
}
