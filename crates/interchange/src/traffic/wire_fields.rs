//! Fields of a message in their order, without unpacking.

use crate::trace::TraceRule;
use prost::DecodeError;
use prost::bytes::Buf;
use prost::encoding::{DecodeContext, WireType, decode_key, decode_varint, skip_field};

/// A field: its number, its wire type and, for a message or a text, its bytes.
pub(crate) struct Field<'a> {
    pub(crate) number: u32,
    pub(crate) wire: WireType,
    pub(crate) content: Option<&'a [u8]>,
}

/// Iterates over the fields of a message; nothing follows an error.
pub(crate) fn fields(message: &[u8]) -> impl Iterator<Item = Result<Field<'_>, TraceRule>> {
    let mut rest = message;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let field = next(&mut rest);
        if field.is_err() {
            rest = &[];
        }
        Some(field)
    })
}

fn next<'a>(rest: &mut &'a [u8]) -> Result<Field<'a>, TraceRule> {
    let (number, wire) = decode_key(rest).map_err(encoding)?;
    if wire != WireType::LengthDelimited {
        skip_field(wire, number, rest, DecodeContext::default()).map_err(encoding)?;
        return Ok(Field { number, wire, content: None });
    }
    let length = decode_varint(rest).map_err(encoding)?;
    let whole: &'a [u8] = rest;
    let content = usize::try_from(length).ok().and_then(|length| whole.get(..length));
    let beyond =
        || TraceRule::Encoding(format!("field {number} has {length} bytes, beyond the message's end"));
    let content = content.ok_or_else(beyond)?;
    rest.advance(content.len());
    Ok(Field { number, wire, content: Some(content) })
}

/// Wraps a decoder's error.
pub(crate) fn encoding(error: DecodeError) -> TraceRule {
    TraceRule::Encoding(error.to_string())
}
