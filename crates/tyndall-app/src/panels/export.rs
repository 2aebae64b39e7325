//! The export panel: size, file and format of the picture, and the renders under way.

use std::path::{Path, PathBuf};

use egui::{ComboBox, ProgressBar, ScrollArea, TextEdit, Ui};

use super::{SCROLL_MARGIN, group, row::rename};
use crate::{
    document::Document,
    file_dialog::{FileDialogs, Purpose},
    jobs::{Job, Order, Progress, shell_line},
};

/// What the user has chosen for pictures besides their size.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub(crate) struct ExportOptions {
    /// Where the picture goes; the ending decides about the format.
    pub(crate) path: String,
    /// Precision of EXR files: 32 bits in place of 16.
    pub(crate) float: bool,
    /// Precision of PNG files: 16 bits in place of 8.
    pub(crate) deep: bool,
}

impl ExportOptions {
    /// The file: as typed, or else named after the scene.
    pub(crate) fn output(&self, document: &Document) -> PathBuf {
        match self.path.trim() {
            "" => PathBuf::from(format!("{}.png", document.file_stem())),
            path => PathBuf::from(path),
        }
    }

    /// Options of `tyndall render` that follow from the choices.
    fn arguments(&self, output: &Path) -> Vec<String> {
        match extension(output).as_str() {
            "exr" if self.float => vec!["--float".to_owned()],
            "png" if self.deep => vec!["--bits".to_owned(), "16".to_owned()],
            _ => vec![],
        }
    }
}

/// Renders that were started, the latest last.
#[derive(Debug, Default)]
pub(crate) struct Exports {
    jobs: Vec<Job>,
    /// Why the last one could not even be started.
    error: Option<String>,
}

impl Exports {
    /// Starts a render of the scene as it is now.
    pub(crate) fn start(&mut self, ctx: &egui::Context, document: &Document, options: &ExportOptions) {
        let output = options.output(document);
        if let Err(error) = document.scene().check() {
            self.error = Some(error.to_string());
            return;
        }
        let order = Order { scene_text: document.to_text(), options: options.arguments(&output), output };
        let ctx = ctx.clone();
        match Job::start(&order, move || ctx.request_repaint()) {
            Ok(job) => {
                self.error = None;
                self.jobs.push(job);
            }
            Err(error) => self.error = Some(format!("The render cannot be started: {error}")),
        }
    }

    /// The command line that renders the scene as it is now.
    pub(crate) fn command_line(document: &Document, options: &ExportOptions) -> String {
        let placeholder = PathBuf::from(format!("{}.toml", document.file_stem()));
        let path = document.path().unwrap_or(&placeholder);
        let mut arguments = document.scene().to_command_line(document.saved_scene(), path);
        let output = options.output(document);
        arguments.extend(["-o".to_owned(), output.display().to_string()]);
        arguments.extend(options.arguments(&output));
        shell_line(&arguments)
    }
}

/// Shows the panel.
pub(crate) fn show(
    ui: &mut Ui,
    document: &mut Document,
    options: &mut ExportOptions,
    exports: &mut Exports,
    dialogs: &FileDialogs,
) {
    ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
        group::show(ui, document.scene_mut(), group::IMAGE, "");
        file(ui, document, options, dialogs);
        ui.add_space(6.0);
        ui.horizontal_wrapped(|ui| {
            if ui.button("Render").on_hover_text("Renders the scene in a process of its own.").clicked() {
                exports.start(ui.ctx(), document, options);
            }
            let copy = ui.button("Copy as command line");
            if copy.on_hover_text("Copies the command that renders this scene without a window.").clicked() {
                ui.ctx().copy_text(Exports::command_line(document, options));
            }
        });
        if document.path().is_none() {
            ui.weak("The command line needs the scene saved as a file.");
        }
        if let Some(error) = &exports.error {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
        ui.add_space(6.0);
        jobs(ui, &mut exports.jobs);
    });
}

fn file(ui: &mut Ui, document: &Document, options: &mut ExportOptions, dialogs: &FileDialogs) {
    let hint = options.output(document).display().to_string();
    ui.horizontal(|ui| {
        ui.label("File");
        let width = ui.available_width() - 80.0;
        let field = ui.add(TextEdit::singleline(&mut options.path).hint_text(hint).desired_width(width.max(60.0)));
        rename(ui, &field, "Picture file");
        field.on_hover_text("PNG, JPEG or EXR, by the ending.");
        if ui.button("Choose...").clicked() {
            dialogs.start(ui.ctx(), Purpose::ExportPicture, &options.output(document));
        }
    });
    let output = options.output(document);
    ui.horizontal(|ui| match extension(&output).as_str() {
        "png" => depth(ui, "PNG depth", &mut options.deep, ["8 bits a channel", "16 bits a channel"]),
        "exr" => depth(ui, "EXR depth", &mut options.float, ["16-bit floats", "32-bit floats"]),
        "jpg" | "jpeg" => drop(ui.weak("8 bits a channel, compressed with loss")),
        _ => drop(ui.colored_label(ui.visuals().warn_fg_color, "The ending must be .png, .exr or .jpg.")),
    });
}

fn depth(ui: &mut Ui, name: &str, high: &mut bool, words: [&str; 2]) {
    let combo = ComboBox::from_id_salt(name).selected_text(words[usize::from(*high)]).width(150.0).show_ui(ui, |ui| {
        ui.selectable_value(high, false, words[0]);
        ui.selectable_value(high, true, words[1]);
    });
    rename(ui, &combo.response, name);
}

fn jobs(ui: &mut Ui, jobs: &mut Vec<Job>) {
    let mut closed = None;
    for (index, job) in jobs.iter_mut().enumerate().rev() {
        let output = job.output().display().to_string();
        ui.push_id(index, |ui| match job.progress().clone() {
            Progress::Running(done) => {
                ui.horizontal(|ui| {
                    let width = (ui.available_width() - 80.0).max(60.0);
                    ui.add(ProgressBar::new(done).desired_width(width).text(output));
                    if ui.button("Cancel").clicked() {
                        job.cancel();
                    }
                });
            }
            ended => {
                ui.horizontal_wrapped(|ui| {
                    match ended {
                        Progress::Finished { seconds } => drop(ui.label(format!("{output}: done in {seconds:.1} s"))),
                        Progress::Failed(reason) => {
                            drop(ui.colored_label(ui.visuals().error_fg_color, format!("{output}: {reason}")));
                        }
                        _ => drop(ui.weak(format!("{output}: cancelled"))),
                    }
                    if ui.small_button("Dismiss").clicked() {
                        closed = Some(index);
                    }
                });
            }
        });
    }
    if let Some(index) = closed {
        jobs.remove(index);
    }
}

/// Ending of a file's name in lower case.
fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_named_after_the_scene_until_the_user_names_it() {
        let document = Document::from_preset(&tyndall_scene::presets()[1]).unwrap();
        let mut options = ExportOptions::default();
        assert_eq!(options.output(&document), PathBuf::from("low-sun.png"), "from the title");
        options.path = " elsewhere/a.exr ".to_owned();
        assert_eq!(options.output(&document), PathBuf::from("elsewhere/a.exr"), "as typed");
    }

    #[test]
    fn options_belong_to_the_format_of_the_file() {
        let options = ExportOptions { path: String::new(), float: true, deep: true };
        for (file, expected) in [("a.png", "--bits 16"), ("a.EXR", "--float"), ("a.jpg", "")] {
            assert_eq!(options.arguments(Path::new(file)).join(" "), expected, "{file}");
        }
    }

    #[test]
    fn the_command_line_has_the_changes_since_the_file_was_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::new();
        document.save_as(&folder.path().join("my scene.toml")).unwrap();
        document.scene_mut().sun.elevation_deg = 4.5;
        let options = ExportOptions { path: "out.exr".to_owned(), ..ExportOptions::default() };
        let line = Exports::command_line(&document, &options);
        assert!(line.starts_with("tyndall render '") || cfg!(windows), "{line}");
        assert!(line.ends_with("--set sun.elevation_deg=4.5 -o out.exr"), "{line}");
    }
}
