//! Python bindings of bryla.
