//! Check of the site's navigation: it contains every page of the project once, and nothing else.

use crate::ci::findings::{fail_on, pages, read};
use crate::project::project_root;
use std::collections::BTreeSet;
use wayside::host::failure::Failure;

/// Settings of the site, with its navigation.
const SETTINGS: &str = "docs/site/zensical.toml";

pub(in crate::ci) fn check() -> Result<(), Failure> {
    let root = project_root();
    let names = pages(&root).into_iter().filter_map(|page| Some(page.strip_prefix(&root).ok()?.to_owned()));
    let there = names.map(|name| name.display().to_string()).collect();
    let listed = listed(&read(&root.join(SETTINGS))?);
    let gone = listed.iter().filter(|page| !root.join(page).is_file());
    let gone: Vec<String> = gone.map(|page| format!("{SETTINGS}: {page} is not there")).collect();
    fail_on([missing_pages(&listed, &there), gone].concat())
}

/// Pages of the navigation, in order.
fn listed(settings: &str) -> Vec<String> {
    let words = settings.split('"').skip(1).step_by(2);
    words.filter(|word| word.ends_with(".md")).map(str::to_owned).collect()
}

/// A sentence for each page that is missing or duplicated in the navigation.
fn missing_pages(listed: &[String], there: &BTreeSet<String>) -> Vec<String> {
    let times = |page: &String| listed.iter().filter(|other| *other == page).count();
    let wrong = there.iter().filter(|page| times(page) != 1);
    wrong.map(|page| format!("{SETTINGS}: {page} is listed {} times, not once", times(page))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_that_the_navigation_lacks_or_has_twice_is_told() {
        let settings = "nav = [\n  { \"A\" = \"docs/a.md\" },\n  { \"B\" = \"docs/b.md\" }, { \"A\" = \"docs/a.md\" },\n]\n";
        let there = BTreeSet::from(["docs/a.md", "docs/b.md", "docs/c.md"].map(str::to_owned));
        let told = [
            "docs/site/zensical.toml: docs/a.md is listed 2 times, not once",
            "docs/site/zensical.toml: docs/c.md is listed 0 times, not once",
        ];
        assert_eq!(missing_pages(&listed(settings), &there), told);
    }
}
