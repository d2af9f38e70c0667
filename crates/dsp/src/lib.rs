//! From radar cubes to range-Doppler maps, detections, point clouds and crops
