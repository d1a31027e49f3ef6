//! Readers and writers of surface files over `Read` and `Write`.
