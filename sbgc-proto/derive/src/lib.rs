//! The derive macro of `sbgc-proto`.
