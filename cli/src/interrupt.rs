//! Ctrl-C: unfinished files are removed, the error is told, the process ends with 130.
//!
//! The commands keep nothing between start and end that is worth saving, so the handler ends the process itself
//! instead of waiting for a stage to notice.

use crate::codes::Code;
use crate::console::{print_error, try_write_json_once};
use crate::failure::Failure;
use crate::output;
use serde_json::json;
use std::time::Duration;

/// If the person's terminal or the script's pipe takes nothing, the process ends all the same.
const GRACE: Duration = Duration::from_secs(1);

/// Sets the handler. Where the system refuses, Ctrl-C ends the process as it does any other.
pub(crate) fn install(json: bool) {
    let _ = ctrlc::set_handler(move || {
        let _no_new_files = output::abandon_all();
        std::thread::spawn(|| {
            std::thread::sleep(GRACE);
            std::process::exit(i32::from(Code::Interrupted.exit()));
        });
        let failure = Failure::new(Code::Interrupted, "interrupted").help("run the same command again");
        print_error(&failure);
        if json {
            try_write_json_once(&json!({ "error": failure.to_json() }));
        }
        std::process::exit(i32::from(Code::Interrupted.exit()));
    });
}
