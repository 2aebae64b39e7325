//! The export panel: what is made of the scene, file and format, and the renders under way.

use std::path::PathBuf;

use egui::{Align, ComboBox, Layout, ProgressBar, ScrollArea, TextEdit, Ui, vec2};

use super::{SCROLL_MARGIN, group, row::rename};
use crate::{
    document::Document,
    export_options::{
        CUBE_SIZES_PX, Choice, ExportKind, ExportOptions, HDRI_WIDTHS_PX, LAYOUTS, PRIMARIES, SUNS, UNITS, extension,
    },
    file_dialog::{FileDialogs, Purpose},
    jobs::{Job, Order, Progress, shell_line},
};

/// Width of the words before a line.
const CAPTION_PT: f32 = 50.0;

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
        let order = Order {
            verb: options.kind.verb(),
            scene_text: document.to_text(),
            options: options.arguments(&output),
            output,
        };
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
        if let Some(verb) = arguments.get_mut(1) {
            options.kind.verb().clone_into(verb);
        }
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
        ui.horizontal_wrapped(|ui| {
            for kind in ExportKind::ALL {
                let (name, hint) = kind.label();
                ui.selectable_value(&mut options.kind, kind, name).on_hover_text(hint);
            }
        });
        ui.add_space(4.0);
        match options.kind {
            ExportKind::Picture => group::show(ui, document.scene_mut(), group::IMAGE, ""),
            ExportKind::Hdri => hdri(ui, options),
            ExportKind::Cubemap => cubemap(ui, options),
        }
        file(ui, document, options, dialogs);
        ui.add_space(6.0);
        ui.horizontal_wrapped(|ui| {
            if ui.button("Render").on_hover_text("Makes the file in a process of its own.").clicked() {
                exports.start(ui.ctx(), document, options);
            }
            let copy = ui.button("Copy as command line");
            if copy.on_hover_text("Copies the command that makes this file without a window.").clicked() {
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
    line(ui, "File", |ui| {
        let width = ui.available_width() - 80.0;
        let edit = TextEdit::singleline(options.path_mut()).hint_text(hint).desired_width(width.max(60.0));
        let field = ui.add(edit);
        rename(ui, &field, "Picture file");
        field.on_hover_text("The ending decides about the format.");
        if ui.button("Choose...").clicked() {
            dialogs.start(ui.ctx(), Purpose::Export(options.kind), &options.output(document));
        }
    });
    let output = options.output(document);
    if let Some(complaint) = options.complaint(&output) {
        ui.colored_label(ui.visuals().warn_fg_color, complaint);
        return;
    }
    line(ui, "", |ui| match (options.kind, extension(&output).as_str()) {
        (ExportKind::Picture, "png") => {
            depth(ui, "PNG depth", &mut options.deep, ["8 bits a channel", "16 bits a channel"]);
        }
        (ExportKind::Picture, "exr") => {
            depth(ui, "EXR depth", &mut options.float, ["16-bit floats", "32-bit floats"]);
        }
        (ExportKind::Hdri, "exr") => {
            depth(ui, "EXR depth", &mut options.hdri.half, ["32-bit floats", "16-bit floats"]);
        }
        (_, "jpg" | "jpeg") => drop(ui.weak("8 bits a channel, compressed with loss")),
        (ExportKind::Cubemap, "") => drop(ui.weak("Six EXR files in this folder")),
        _ => {}
    });
}

/// Options of the light from all around.
fn hdri(ui: &mut Ui, options: &mut ExportOptions) {
    let hdri = &mut options.hdri;
    line(ui, "Width", |ui| {
        size(ui, "Panorama width", &mut hdri.width_px, &HDRI_WIDTHS_PX, |width| format!("{width} x {} px", width / 2));
    });
    line(ui, "Unit", |ui| choice(ui, "Unit of the light", &mut hdri.unit, &UNITS));
    line(ui, "Sun", |ui| choice(ui, "Sun's disc", &mut hdri.sun, &SUNS));
    line(ui, "Colours", |ui| choice(ui, "Primaries", &mut hdri.primaries, &PRIMARIES));
    line(ui, "Ground", |ui| {
        ui.checkbox(&mut hdri.black_ground, "Black").on_hover_text("For scenes with a ground of their own.");
    });
}

/// Options of the six faces.
fn cubemap(ui: &mut Ui, options: &mut ExportOptions) {
    let cube = &mut options.cubemap;
    line(ui, "Face", |ui| size(ui, "Side of a face", &mut cube.size_px, &CUBE_SIZES_PX, |side| format!("{side} px")));
    line(ui, "Layout", |ui| choice(ui, "Layout of the faces", &mut cube.layout, &LAYOUTS));
    line(ui, "Sun", |ui| choice(ui, "Sun's disc", &mut cube.sun, &SUNS));
    line(ui, "Ground", |ui| {
        ui.checkbox(&mut cube.black_ground, "Black").on_hover_text("For scenes with a ground of their own.");
    });
}

/// A caption and what stands beside it.
fn line(ui: &mut Ui, caption: &str, contents: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        let size = vec2(CAPTION_PT, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(size);
            ui.label(caption);
        });
        contents(ui);
    });
}

fn choice(ui: &mut Ui, name: &str, chosen: &mut usize, choices: &[Choice]) {
    let text = choices.get(*chosen).map_or("", |(_, text, _)| text);
    let combo = ComboBox::from_id_salt(name).selected_text(text).width(150.0).show_ui(ui, |ui| {
        for (index, (_, text, hint)) in choices.iter().enumerate() {
            ui.selectable_value(chosen, index, *text).on_hover_text(*hint);
        }
    });
    rename(ui, &combo.response, name);
}

fn size(ui: &mut Ui, name: &str, chosen: &mut u32, sizes_px: &[u32], text: impl Fn(u32) -> String) {
    let combo = ComboBox::from_id_salt(name).selected_text(text(*chosen)).width(150.0).show_ui(ui, |ui| {
        for size_px in sizes_px {
            ui.selectable_value(chosen, *size_px, text(*size_px));
        }
    });
    rename(ui, &combo.response, name);
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

#[cfg(test)]
mod tests {
    use super::*;

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
        let options = ExportOptions { kind: ExportKind::Hdri, ..options };
        let line = Exports::command_line(&document, &options);
        assert!(
            line.starts_with("tyndall hdri ") && line.ends_with("-o my scene-sky.exr")
                || line.ends_with("-o 'my scene-sky.exr'"),
            "{line}"
        );
    }
}
