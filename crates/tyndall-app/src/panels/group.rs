//! A group of parameters: a foldable list of rows with a button that resets them all.

use egui::{Button, CollapsingHeader, Rect, RichText, Ui, UiBuilder, vec2};
use tyndall_core::{ParamInfo, ParamSet, TextInfo};
use tyndall_scene::Scene;

use super::{row, text_row};
use crate::{document::reset_group, relevance::no_effect};

/// Groups that have panels of their own.
pub(crate) const CAMERA: &str = "camera";
/// See [`CAMERA`].
pub(crate) const IMAGE: &str = "image";

/// Names of the groups in the order in which they are shown.
pub(crate) fn names(scene: &Scene) -> impl Iterator<Item = &'static str> {
    scene.groups().into_iter().map(|(name, _)| name)
}

/// Shows the rows of a group.
pub(crate) fn rows(ui: &mut Ui, scene: &mut Scene, group: &str, filter: &str) {
    let Some(position) = names(scene).position(|name| name == group) else { return };
    for (index, info) in scene.groups()[position].1.info().iter().enumerate() {
        if matches(group, info, filter) {
            let reason = no_effect(scene, group, info.name);
            let (group, set) = &mut scene.groups_mut()[position];
            row::show(ui, group, *set, index, reason);
        }
    }
    for (index, info) in scene.groups()[position].1.text_info().iter().enumerate() {
        if matches_text(group, info, filter) {
            let reason = no_effect(scene, group, info.name);
            let (group, set) = &mut scene.groups_mut()[position];
            text_row::show(ui, group, *set, index, reason);
        }
    }
}

/// Shows a group below a heading; nothing when the filter leaves nothing.
pub(crate) fn show(ui: &mut Ui, scene: &mut Scene, group: &str, filter: &str) {
    let Some((_, set)) = scene.groups().into_iter().find(|(name, _)| *name == group) else { return };
    let has_text = set.text_info().iter().any(|info| matches_text(group, info, filter));
    if !has_text && !set.info().iter().any(|info| matches(group, info, filter)) {
        return;
    }
    let changed = count_changed(set);
    let title = if changed == 0 { heading(group) } else { format!("{}  ({changed} changed)", heading(group)) };
    let open = (!filter.is_empty()).then_some(true);
    let header = CollapsingHeader::new(RichText::new(title).strong())
        .id_salt(group)
        .default_open(true)
        .open(open)
        .show_unindented(ui, |ui| rows(ui, scene, group, filter));
    if changed > 0 {
        reset_button(ui, header.header_response.rect, scene, group);
    }
    ui.add_space(4.0);
}

/// At the right end of the heading.
fn reset_button(ui: &mut Ui, heading_rect: Rect, scene: &mut Scene, group: &str) {
    let size = vec2(52.0, heading_rect.height());
    let rect = Rect::from_min_size(egui::pos2(ui.max_rect().right() - size.x, heading_rect.top()), size);
    // A child of its own, as the heading's place is taken already.
    let mut corner = ui.new_child(UiBuilder::new().id_salt((group, "reset")).max_rect(rect));
    let response = corner.put(rect, Button::new("Reset").small());
    row::rename(ui, &response, &format!("Reset group {group}"));
    if response.on_hover_text(format!("All parameters of {group} back to their defaults")).clicked() {
        reset_group(scene, group);
    }
}

fn count_changed(set: &dyn ParamSet) -> usize {
    let infos = set.info().iter().enumerate();
    let texts = set.text_info().iter().enumerate();
    infos.filter(|(index, info)| set.get(*index).total_cmp(&info.default).is_ne()).count()
        + texts.filter(|(index, info)| set.text(*index) != info.default).count()
}

/// The group's name with a capital.
fn heading(group: &str) -> String {
    let mut letters = group.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Whether every word of the filter is somewhere in what is known about the parameter.
fn matches(group: &str, info: &ParamInfo, filter: &str) -> bool {
    has_words(&format!("{group} {} {} {} {}", info.name, info.label(), info.doc, info.source), filter)
}

/// [`matches`] for a text.
fn matches_text(group: &str, info: &TextInfo, filter: &str) -> bool {
    has_words(&format!("{group} {} {} {} {}", info.name, info.label(), info.doc, info.source), filter)
}

fn has_words(known: &str, filter: &str) -> bool {
    let known = known.to_lowercase();
    filter.to_lowercase().split_whitespace().all(|word| known.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_filter_finds_names_docs_and_sources_in_any_order() {
        let scene = Scene::default();
        let found = |filter: &str| {
            let groups = scene.groups();
            let all = groups.iter().flat_map(|(group, set)| set.info().iter().map(move |info| (group, info)));
            all.filter(|(group, info)| matches(group, info, filter)).map(|(_, info)| info.name).collect::<Vec<_>>()
        };
        assert_eq!(found("aerosol_angstrom fast"), ["aerosol_angstrom"], "name and doc");
        assert_eq!(found("sun hestroffer"), ["limb_darkening"], "group and source");
        assert!(found("zzz").is_empty(), "nothing");
        assert!(found("").len() > 40, "an empty filter leaves everything");
    }
}
