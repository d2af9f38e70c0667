//! A table of Apache Parquet, written as a stream of rows: one group of rows is in memory, so that the
//! table's size is limited only by the disk.

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result as Written};
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};
use std::io::Write;
use std::sync::Arc;

/// Type of a column; each value may be absent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Text in UTF-8.
    Text,
    /// Unsigned count.
    Count,
    /// Number in double precision.
    Real,
    /// True or false.
    Truth,
}

/// A value of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Unknown value.
    Absent,
    /// Value of a column [`Kind::Text`].
    Text(String),
    /// Value of a column [`Kind::Count`].
    Count(u64),
    /// Value of a column [`Kind::Real`].
    Real(f64),
    /// Value of a column [`Kind::Truth`].
    Truth(bool),
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Real(number)
    }
}

impl From<bool> for Value {
    fn from(truth: bool) -> Self {
        Self::Truth(truth)
    }
}

impl<T: Into<Self>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Absent, Into::into)
    }
}

/// Number of rows in a group.
const GROUP_ROWS: usize = 65_536;

/// A table being written.
pub struct Table<W: Write + Send> {
    file: SerializedFileWriter<W>,
    columns: Vec<Vec<Value>>,
}

impl<W: Write + Send> Table<W> {
    /// Begins a table with these columns.
    ///
    /// # Errors
    /// An error of the sink; two columns with the same name.
    pub fn create(sink: W, columns: &[(&str, Kind)]) -> std::io::Result<Self> {
        let is_alike = |at: usize| columns[..at].iter().any(|(name, _)| *name == columns[at].0);
        if let Some(at) = (0..columns.len()).find(|at| is_alike(*at)) {
            return Err(std::io::Error::other(format!("two columns are called {}", columns[at].0)));
        }
        let fields: Written<Vec<TypePtr>> = columns.iter().map(|(name, kind)| field(name, *kind)).collect();
        let schema = Type::group_type_builder("row").with_fields(fields.map_err(fault)?).build();
        let properties = WriterProperties::builder()
            .set_writer_version(WriterVersion::PARQUET_1_0)
            .set_created_by("wayside".to_owned())
            .set_max_row_group_row_count(Some(GROUP_ROWS))
            .build();
        let schema = Arc::new(schema.map_err(fault)?);
        let file = SerializedFileWriter::new(sink, schema, Arc::new(properties)).map_err(fault)?;
        Ok(Self { file, columns: vec![vec![]; columns.len()] })
    }

    /// Appends a row, a value for each column.
    ///
    /// # Errors
    /// An error of the sink; a value of another type than its column, or a wrong number of values.
    pub fn push(&mut self, row: Vec<Value>) -> std::io::Result<()> {
        if row.len() != self.columns.len() {
            let text = format!("a row of {} values in a table of {} columns", row.len(), self.columns.len());
            return Err(std::io::Error::other(text));
        }
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        let is_full = self.columns.first().is_some_and(|column| column.len() == GROUP_ROWS);
        if is_full { self.write_group().map_err(fault) } else { Ok(()) }
    }

    /// Writes the remaining rows and the footer.
    ///
    /// # Errors
    /// An error of the sink.
    pub fn finish(mut self) -> std::io::Result<()> {
        if self.columns.first().is_some_and(|column| !column.is_empty()) {
            self.write_group().map_err(fault)?;
        }
        self.file.close().map(drop).map_err(fault)
    }

    fn write_group(&mut self) -> Written<()> {
        let mut group = self.file.next_row_group()?;
        for column in &mut self.columns {
            let Some(mut writer) = group.next_column()? else { break };
            write_column(&mut writer, std::mem::take(column))?;
            writer.close()?;
        }
        group.close().map(drop)
    }
}

fn field(name: &str, kind: Kind) -> Written<TypePtr> {
    let (physical, logical) = match kind {
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Kind::Count => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Kind::Real => (Physical::DOUBLE, None),
        Kind::Truth => (Physical::BOOLEAN, None),
    };
    let field = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
    field.with_logical_type(logical).build().map(Arc::new)
}

/// Writes a column of the file's type: a value of another type is refused.
fn write_column(writer: &mut SerializedColumnWriter<'_>, values: Vec<Value>) -> Written<()> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(*value != Value::Absent)).collect();
    let present = values.into_iter().filter(|value| *value != Value::Absent);
    match writer.untyped() {
        parquet::column::writer::ColumnWriter::ByteArrayColumnWriter(_) => {
            write::<ByteArrayType>(writer, present, &levels, |value| match value {
                Value::Text(text) => Some(ByteArray::from(text.into_bytes())),
                _ => None,
            })
        }
        parquet::column::writer::ColumnWriter::Int64ColumnWriter(_) => {
            write::<Int64Type>(writer, present, &levels, |value| match value {
                Value::Count(count) => Some(count.cast_signed()), // the bits of the unsigned type
                _ => None,
            })
        }
        parquet::column::writer::ColumnWriter::BoolColumnWriter(_) => {
            write::<BoolType>(writer, present, &levels, |value| match value {
                Value::Truth(truth) => Some(truth),
                _ => None,
            })
        }
        _ => write::<DoubleType>(writer, present, &levels, |value| match value {
            Value::Real(number) => Some(number),
            _ => None,
        }),
    }
}

fn write<T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    present: impl Iterator<Item = Value>,
    levels: &[i16],
    of: fn(Value) -> Option<T::T>,
) -> Written<()> {
    let values: Option<Vec<T::T>> = present.map(of).collect();
    let values = values.ok_or_else(|| ParquetError::General("a value is not of its column's type".into()))?;
    writer.typed::<T>().write_batch(&values, Some(levels), None).map(drop)
}

fn fault(error: ParquetError) -> std::io::Error {
    match error {
        ParquetError::External(error) => std::io::Error::other(error),
        other => std::io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    const COLUMNS: [(&str, Kind); 4] =
        [("id", Kind::Text), ("frame", Kind::Count), ("range_m", Kind::Real), ("stationary", Kind::Truth)];

    fn row(number: u64) -> Vec<Value> {
        let is_third = number.is_multiple_of(3);
        let real = (!is_third).then_some(0.5 * number as f64);
        vec![format!("a{number}").as_str().into(), (u64::MAX - number).into(), real.into(), is_third.into()]
    }

    /// The library's own reader reads it; pandas and pyarrow do in `docs/training-sets/check.py`.
    #[test]
    fn rows_of_several_groups_come_back_as_they_went() {
        let mut bytes = vec![];
        let mut table = Table::create(&mut bytes, &COLUMNS).unwrap();
        let rows = GROUP_ROWS as u64 + 10;
        (0..rows).for_each(|number| table.push(row(number)).unwrap());
        table.finish().unwrap();
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
        assert_eq!(
            (reader.metadata().num_row_groups(), reader.metadata().file_metadata().num_rows()),
            (2, 65_546)
        );
        for (number, found) in (0..).zip(reader.get_row_iter(None).unwrap()) {
            let found = found.unwrap();
            assert_eq!(found.get_string(0).unwrap(), &format!("a{number}"));
            assert_eq!(found.get_ulong(1).unwrap(), u64::MAX - number);
            assert_eq!(
                found.get_double(2).ok(),
                match row(number)[2] {
                    Value::Real(x) => Some(x),
                    _ => None,
                }
            );
            assert_eq!(found.get_bool(3).unwrap(), number.is_multiple_of(3));
        }
    }

    #[test]
    fn rows_that_do_not_fit_are_refused_and_the_same_rows_are_the_same_bytes() {
        let write = |rows: u64| {
            let mut bytes = vec![];
            let mut table = Table::create(&mut bytes, &COLUMNS).unwrap();
            (0..rows).for_each(|number| table.push(row(number)).unwrap());
            table.finish().unwrap();
            bytes
        };
        assert_eq!(write(5), write(5));
        assert!(write(0).starts_with(b"PAR1"));
        let mut table = Table::create(vec![], &COLUMNS).unwrap();
        assert!(table.push(vec![]).is_err());
        table.push(vec![1.0.into(), 1.into(), 1.0.into(), true.into()]).unwrap();
        assert!(table.finish().is_err_and(|error| error.to_string().contains("type")));
        assert!(Table::create(vec![], &[]).unwrap().finish().is_ok());
        assert!(Table::create(vec![], &[COLUMNS[0], COLUMNS[0]]).is_err());
    }
}
