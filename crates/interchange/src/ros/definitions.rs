//! Definitions of the messages in the form of `ros2msg` in MCAP: names and types of fields, those of nested
//! messages after a line of equals signs.

/// Name and definition of `sensor_msgs/msg/PointCloud2`.
pub(crate) const POINT_CLOUD: [&str; 2] = [
    "sensor_msgs/msg/PointCloud2",
    "std_msgs/Header header
uint32 height
uint32 width
PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
================================================================================
MSG: sensor_msgs/PointField
string name
uint32 offset
uint8 datatype
uint32 count
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
",
];

/// Name and definition of `radar_msgs/msg/RadarScan`.
pub(crate) const RADAR_SCAN: [&str; 2] = [
    "radar_msgs/msg/RadarScan",
    "std_msgs/Header header
radar_msgs/RadarReturn[] returns
================================================================================
MSG: radar_msgs/RadarReturn
float32 range
float32 azimuth
float32 elevation
float32 doppler_velocity
float32 amplitude
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
",
];

/// Name and definition of `radar_msgs/msg/RadarTracks`.
pub(crate) const RADAR_TRACKS: [&str; 2] = [
    "radar_msgs/msg/RadarTracks",
    "std_msgs/Header header
radar_msgs/RadarTrack[] tracks
================================================================================
MSG: radar_msgs/RadarTrack
unique_identifier_msgs/UUID uuid
geometry_msgs/Point position
geometry_msgs/Vector3 velocity
geometry_msgs/Vector3 acceleration
geometry_msgs/Vector3 size
uint16 classification
float32[6] position_covariance
float32[6] velocity_covariance
float32[6] acceleration_covariance
float32[6] size_covariance
================================================================================
MSG: unique_identifier_msgs/UUID
uint8[16] uuid
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
",
];
