//! Vehicle classes from range-Doppler crops by a convolutional network
