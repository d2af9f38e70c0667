//! Tables in JSON, lists of rows: read row by row, since a dataset's have gibibytes.

use artifact::bounded::{self, ReadFault};
use pipeline::host::failure::Failure;
use serde::de::{DeserializeOwned, SeqAccess, Visitor};
use serde_json::error::Category;
use std::fmt;
use std::io::{BufReader, Read};
use std::marker::PhantomData;
use std::path::Path;

/// Largest table, bytes.
const LIMIT_BYTES: u64 = 2 << 30;

/// Hands each row of a table on, with its number from 0; fields that `Row` does not have are passed over.
///
/// # Errors
/// The file cannot be read, is too long, or is no list of such rows.
pub(super) fn each_row<Row: DeserializeOwned>(
    file: &Path,
    act: impl FnMut(Row, usize),
) -> Result<(), Failure> {
    let unread = |fault: ReadFault| Failure::unread(file, &fault);
    let handle = bounded::open(file).map_err(|error| unread(error.into()))?;
    let length = handle.metadata().map_err(|error| unread(error.into()))?.len();
    if length > LIMIT_BYTES {
        return Err(unread(ReadFault::TooLong { limit: LIMIT_BYTES }));
    }
    let mut table = serde_json::Deserializer::from_reader(BufReader::new(handle.take(LIMIT_BYTES)));
    let visitor = EachRow { act, row: PhantomData::<Row> };
    let read = serde::Deserializer::deserialize_seq(&mut table, visitor).and_then(|()| table.end());
    read.map_err(|error| match error.classify() {
        Category::Io => Failure::system(file, "be read", error),
        _ => Failure::Refused(format!("{}: {error}", file.display())),
    })
}

struct EachRow<Act, Row> {
    act: Act,
    row: PhantomData<Row>,
}

impl<'d, Act: FnMut(Row, usize), Row: DeserializeOwned> Visitor<'d> for EachRow<Act, Row> {
    type Value = ();

    fn expecting(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str("a list of rows")
    }

    fn visit_seq<Rows: SeqAccess<'d>>(mut self, mut rows: Rows) -> Result<(), Rows::Error> {
        let mut number = 0;
        while let Some(row) = rows.next_element()? {
            (self.act)(row, number);
            number += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(serde::Deserialize)]
    struct Row {
        size: [f64; 3],
    }

    fn lengths(text: &str) -> Result<Vec<(usize, f64)>, String> {
        let folder = tempfile::tempdir().unwrap();
        let (file, mut found) = (folder.path().join("t.json"), vec![]);
        std::fs::write(&file, text).unwrap();
        let read = each_row(&file, |row: Row, number| found.push((number, row.size[1])));
        read.map(|()| found).map_err(|failure| failure.to_string())
    }

    #[test]
    fn rows_are_handed_on_one_by_one_and_what_is_no_row_is_refused_by_file_and_line() {
        let table = "[{\"size\": [1, 2, 3], \"more\": {}},\n{\"size\": [4, 5.5, 6]}]\n";
        assert_eq!(lengths(table).unwrap(), [(0, 2.0), (1, 5.5)]);
        assert_eq!(lengths("[]").unwrap(), []);
        for (text, why) in [
            ("{}", "a list of rows"),
            ("[{\"size\": [1, 2, 3]},\n{\"size\": [1, 2]}]", "line 2"),
            ("[{\"size\": [1, 2, 1e999]}]", "out of range"),
            ("[{\"sizes\": [1, 2, 3]}]", "missing field `size`"),
            ("[{\"size\": [1, 2, 3]}", "EOF"),
            ("[] []", "trailing"),
        ] {
            let refused = lengths(text).unwrap_err();
            assert!(refused.contains("t.json: ") && refused.contains(why), "{text}: {refused}");
        }
    }
}
