//! The server and the pages, with data made here, also in a browser. Without Chromium the tests that need it say `skipped`, and with `CI`
//! set they fail.

mod block_page;
mod browser;
mod frame_page;
mod refusals;
mod sample;
mod why_page;
