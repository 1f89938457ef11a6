//! Step 2: where water is visible.

use crate::tour::edit::{Edit, RegionAt};

use super::super::egui::Ui;
use super::super::field;
use super::super::work::Work;
use super::super::{Out, Studio};
use super::region::region_ui;

/// Shows the step.
pub(super) fn water_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.mark.water);
    field::card(ui, |ui| {
        region_ui(ui, RegionAt::Water, studio, work, out);
        if let Some(water) = &work.tour.water {
            let has_pairs = !water.pairs.is_empty();
            let hint = if has_pairs { t.region.remove_water_hint } else { "" };
            let button = ui.button(t.region.remove_water);
            let button = if hint.is_empty() { button } else { button.on_hover_text(hint) };
            if button.clicked() {
                out.edit(Edit::Water(None));
            }
        }
    });
}
