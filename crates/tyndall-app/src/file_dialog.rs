//! The system's file dialogs, on threads of their own: the window stays awake behind them.

use std::{
    path::{Path, PathBuf},
    sync::mpsc::{Receiver, Sender, channel},
    thread,
};

use rfd::AsyncFileDialog;

use crate::export_options::ExportKind;

/// What a file is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    OpenScene,
    SaveScene,
    Export(ExportKind),
}

/// Dialogs under way.
#[derive(Debug)]
pub(crate) struct FileDialogs {
    sender: Sender<(Purpose, PathBuf)>,
    receiver: Receiver<(Purpose, PathBuf)>,
}

impl Default for FileDialogs {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Self { sender, receiver }
    }
}

impl FileDialogs {
    /// Opens a dialog at a proposed file.
    pub(crate) fn start(&self, ctx: &egui::Context, purpose: Purpose, proposed: &Path) {
        let (sender, ctx, proposed) = (self.sender.clone(), ctx.clone(), proposed.to_owned());
        thread::spawn(move || {
            if let Some(path) = pollster::block_on(ask(purpose, &proposed)) {
                // The window may have been closed meanwhile.
                let _received = sender.send((purpose, path));
                ctx.request_repaint();
            }
        });
    }

    /// A file that the user has chosen since the last call.
    pub(crate) fn chosen(&self) -> Option<(Purpose, PathBuf)> {
        self.receiver.try_recv().ok()
    }
}

/// `None` when the user cancels, or when the system has no dialogs: every dialog has a path field beside it.
async fn ask(purpose: Purpose, proposed: &Path) -> Option<PathBuf> {
    let mut dialog = AsyncFileDialog::new();
    if let Some(folder) = proposed.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    let name = proposed.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let file = match purpose {
        Purpose::OpenScene => dialog.set_title("Open scene").add_filter("Scene", &["toml"]).pick_file().await,
        Purpose::SaveScene => {
            dialog.set_title("Save scene").add_filter("Scene", &["toml"]).set_file_name(name).save_file().await
        }
        Purpose::Export(kind) => {
            let endings: &[&str] = match kind {
                ExportKind::Hdri => &["exr", "hdr"],
                ExportKind::Picture | ExportKind::Cubemap => &["png", "exr", "jpg"],
            };
            let (title, _) = kind.label();
            dialog.set_title(title).add_filter(title, endings).set_file_name(name).save_file().await
        }
    };
    file.map(|file| file.path().to_owned())
}
