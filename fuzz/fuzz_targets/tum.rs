#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| centrode_fuzz::run("tum", bytes));
