//! What `-v` shows.

use tracing_subscriber::EnvFilter;

/// Sends the libraries' reports to stderr: nothing without `-v`, what happens with `-v`, every detail with `-vv`.
/// `RUST_LOG` goes before both.
pub(crate) fn start(verbose: u8) {
    let level = match verbose {
        0 => "off",
        1 => "info",
        _ => "debug",
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_not_set| EnvFilter::new(level));
    let subscriber = tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr).without_time();
    // A program that has the library inside may have its own already, and keeps it.
    let _ = subscriber.with_target(false).try_init();
}
