//! Tables that are kept between two runs.

use std::sync::Arc;

use tyndall_core::table_store::TableStore;
use tyndall_io::TableFolder;

/// Whether slow tables are kept.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct CacheArguments {
    /// Make all tables anew and keep none; otherwise they lie in the user's cache, or in `TYNDALL_CACHE_DIR`
    #[arg(long)]
    pub no_cache: bool,
}

impl CacheArguments {
    /// Where tables are kept, if they are.
    #[must_use]
    pub fn store(self) -> Option<Arc<dyn TableStore>> {
        let folder = if self.no_cache { None } else { TableFolder::of_user() };
        if let Some(folder) = &folder {
            tracing::debug!(folder = %folder.path().display(), "tables are kept");
        }
        folder.map(|folder| Arc::new(folder) as Arc<dyn TableStore>)
    }
}
