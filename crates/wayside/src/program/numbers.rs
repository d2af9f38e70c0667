//! Numbers of options. Beside the option and the value, which the command line names, a refusal says which
//! numbers are asked, and gives an example.

use crate::stepwise::bounds::{from_to, outside};
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Numbers that an option takes, with an example of a value.
pub(crate) struct Numbers {
    pub(crate) allowed: RangeInclusive<f64>,
    pub(crate) example: &'static str,
}

impl Numbers {
    /// Reads a value that is one number.
    pub(crate) fn value(&self, text: &str) -> Result<f64, String> {
        self.part(text).map_err(|refusal| self.with_example(&refusal))
    }

    /// Reads a number that is a part of a value; a refusal is without the example, which is a whole value.
    pub(crate) fn part(&self, text: &str) -> Result<f64, String> {
        let number: f64 = text
            .parse()
            .map_err(|_| format!("`{text}` is not a number; it must be one {}", from_to(&self.allowed)))?;
        if self.allowed.contains(&number) { Ok(number) } else { Err(outside(&self.allowed, text)) }
    }

    /// A refusal with the example.
    pub(crate) fn with_example(&self, refusal: &str) -> String {
        with_example(refusal, self.example)
    }
}

/// Parser of a whole number within a range.
pub(crate) fn whole<T>(
    allowed: RangeInclusive<T>,
    example: T,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
where
    T: Clone + Display + FromStr + PartialOrd + Send + Sync + 'static,
{
    move |text: &str| {
        let number = text.parse::<T>().ok().filter(|number| allowed.contains(number));
        number.ok_or_else(|| {
            let range = format!("from {} to {}", allowed.start(), allowed.end());
            let refusal = if is_whole(text) {
                format!("it must be {range}, is {text}")
            } else {
                format!("`{text}` is not a whole number; it must be one {range}")
            };
            with_example(&refusal, &example)
        })
    }
}

/// Whether a text is a whole number, of any length.
fn is_whole(text: &str) -> bool {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

pub(crate) fn with_example(refusal: &str, example: impl Display) -> String {
    format!("{refusal}; for example {example}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_refused_with_the_range_and_an_example() {
        let numbers = Numbers { allowed: -200.0..=0.0, example: "-20" };
        assert_eq!(numbers.value("-20"), Ok(-20.0));
        for (text, told) in [
            ("foo", "`foo` is not a number; it must be one from -200 to 0; for example -20"),
            ("3", "it must be from -200 to 0, is 3; for example -20"),
            ("nan", "it must be from -200 to 0, is nan; for example -20"),
        ] {
            assert_eq!(numbers.value(text), Err(told.to_owned()));
        }
    }

    #[test]
    fn a_whole_number_is_refused_with_the_range_and_an_example() {
        let threads = whole(1..=1024_u16, 4);
        assert_eq!(threads("8"), Ok(8));
        for text in ["two", "1.5", "", "-", "4x"] {
            let told =
                format!("`{text}` is not a whole number; it must be one from 1 to 1024; for example 4");
            assert_eq!(threads(text), Err(told));
        }
        for text in ["0", "1025", "-1", "99999999999999999999999"] {
            let told = format!("it must be from 1 to 1024, is {text}; for example 4");
            assert_eq!(threads(text), Err(told));
        }
    }
}
