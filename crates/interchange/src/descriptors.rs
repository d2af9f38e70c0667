//! Descriptors of messages for readers of a file: a `google.protobuf.FileDescriptorSet` of the fields written
//! here. A reader that knows only Protocol Buffers decodes the messages by it. Enumerations are described as
//! integers, as on the wire.

use prost::Message;

/// Kind of a field.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Double,
    Fixed32,
    Int32,
    Uint32,
    Int64,
    Uint64,
    Text,
    Bytes,
    /// A message by its name, after a point with its package if that is another one.
    One(&'static str),
    Many(&'static str),
}

use Kind::{Many, One};

/// Message with its fields' names, numbers and kinds. A name with a point is a message nested in another one,
/// which comes before it.
pub(crate) type MessageRow = (&'static str, &'static [(&'static str, i32, Kind)]);

/// A file of definitions.
pub(crate) struct Definitions {
    pub(crate) name: &'static str,
    pub(crate) package: &'static str,
    pub(crate) imports: &'static [&'static str],
    pub(crate) syntax: &'static str,
    pub(crate) messages: Vec<MessageRow>,
}

/// Descriptor of the messages in these files, imported ones first.
pub(crate) fn described(files: &[Definitions]) -> Vec<u8> {
    DescriptorSet { file: files.iter().map(file).collect() }.encode_to_vec()
}

fn file(of: &Definitions) -> FileDescriptor {
    let mut file = FileDescriptor {
        name: of.name.into(),
        package: of.package.into(),
        dependency: of.imports.iter().map(|name| (*name).to_owned()).collect(),
        message_type: vec![],
        syntax: of.syntax.into(),
    };
    for (name, fields) in &of.messages {
        let (outer, inner) =
            name.split_once('.').map_or((None, *name), |(outer, inner)| (Some(outer), inner));
        let field =
            fields.iter().map(|(name, number, kind)| field(of.package, name, *number, *kind)).collect();
        let message = MessageDescriptor { name: inner.into(), field, nested_type: vec![] };
        let within = outer.and_then(|outer| file.message_type.iter_mut().find(|m| m.name == outer));
        match within {
            Some(outer) => outer.nested_type.push(message),
            None => file.message_type.push(message),
        }
    }
    file
}

fn field(package: &str, name: &str, number: i32, kind: Kind) -> FieldDescriptor {
    let full = |message: &str| {
        if message.starts_with('.') { message.to_owned() } else { format!(".{package}.{message}") }
    };
    // Numbers of google.protobuf.FieldDescriptorProto.Type.
    let (of, message) = match kind {
        Kind::Double => (1, None),
        Kind::Int64 => (3, None),
        Kind::Uint64 => (4, None),
        Kind::Int32 => (5, None),
        Kind::Fixed32 => (7, None),
        Kind::Text => (9, None),
        One(message) | Many(message) => (11, Some(full(message))),
        Kind::Bytes => (12, None),
        Kind::Uint32 => (13, None),
    };
    let label = if matches!(kind, Many(_)) { 3 } else { 1 };
    FieldDescriptor { name: name.into(), number, label, kind: of, type_name: message }
}

/// `google.protobuf.FileDescriptorSet`.
#[derive(Clone, PartialEq, Message)]
struct DescriptorSet {
    #[prost(message, repeated, tag = "1")]
    file: Vec<FileDescriptor>,
}

/// `google.protobuf.FileDescriptorProto`.
#[derive(Clone, PartialEq, Message)]
struct FileDescriptor {
    #[prost(string, required, tag = "1")]
    name: String,
    #[prost(string, required, tag = "2")]
    package: String,
    #[prost(string, repeated, tag = "3")]
    dependency: Vec<String>,
    #[prost(message, repeated, tag = "4")]
    message_type: Vec<MessageDescriptor>,
    #[prost(string, required, tag = "12")]
    syntax: String,
}

/// `google.protobuf.DescriptorProto`.
#[derive(Clone, PartialEq, Message)]
struct MessageDescriptor {
    #[prost(string, required, tag = "1")]
    name: String,
    #[prost(message, repeated, tag = "2")]
    field: Vec<FieldDescriptor>,
    #[prost(message, repeated, tag = "3")]
    nested_type: Vec<MessageDescriptor>,
}

/// `google.protobuf.FieldDescriptorProto`.
#[derive(Clone, PartialEq, Message)]
struct FieldDescriptor {
    #[prost(string, required, tag = "1")]
    name: String,
    #[prost(int32, required, tag = "3")]
    number: i32,
    #[prost(int32, required, tag = "4")]
    label: i32,
    #[prost(int32, required, tag = "5")]
    kind: i32,
    #[prost(string, optional, tag = "6")]
    type_name: Option<String>,
}
