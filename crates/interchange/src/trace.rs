//! Files of consecutive messages: OSI's `.osi`, and MCAP.

mod container;
mod fault;
mod osi_file;
mod mcap_records;
mod mcap_messages;
mod mcap_file;
mod messages;
mod writer;

pub use container::Container;
pub use fault::{TraceError, TraceRule};
pub(crate) use mcap_file::{ChannelDefinition, McapFile};
pub(crate) use messages::Messages;
pub(crate) use writer::{MessageKind, TraceWriter};
