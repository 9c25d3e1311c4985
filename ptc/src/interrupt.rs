//! Ctrl-C.

use ptlib::Cancel;

use crate::exit::Exit;

/// Makes the first Ctrl-C a request to stop, which leaves no half-written file behind, and the
/// second one the end.
///
/// Where the system has no such thing the command works without.
pub(crate) fn cancel_on_interrupt() -> Cancel {
    let cancel = Cancel::new();
    let requested = cancel.clone();
    let _ = ctrlc::set_handler(move || {
        if requested.is_requested() {
            #[expect(clippy::disallowed_methods, reason = "this program is nobody's guest")]
            std::process::exit(Exit::Cancelled as i32);
        }
        requested.request();
    });
    cancel
}
