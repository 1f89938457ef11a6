//! In the render world: the tours' meshes take their place among all transparent ones.
//!
//! Bevy sorts by the centers of meshes, which is wrong for planes that cross the view; the order computed in
//! `views.rs` replaces it, for the tours' own items alone.

use bevy::core_pipeline::core_3d::{Transparent3d, TransparentSortingInfo3d};
use bevy::prelude::*;
use bevy::render::extract_resource::ExtractResourcePlugin;
use bevy::render::render_phase::{ViewSortedRenderPhases, sort_phase_system};
use bevy::render::view::ExtractedView;
use bevy::render::{Render, RenderApp, RenderSystems};

use super::views::DrawOrder;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<DrawOrder>().add_plugins(ExtractResourcePlugin::<DrawOrder>::default());
    let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
    render_app.add_systems(
        Render,
        sort_tours.in_set(RenderSystems::PhaseSort).before(sort_phase_system::<Transparent3d>),
    );
}

fn sort_tours(
    order: Option<Res<DrawOrder>>,
    views: Query<&ExtractedView>,
    mut phases: ResMut<ViewSortedRenderPhases<Transparent3d>>,
) {
    let Some(order) = order else { return };
    for view in &views {
        let camera = view.retained_view_entity.main_entity.id();
        let (Some(distances), Some(phase)) =
            (order.0.get(&camera), phases.get_mut(&view.retained_view_entity))
        else {
            continue;
        };
        // The sort key is the view depth of a point plus a bias; at the camera itself the depth is zero.
        let mesh_center = view.world_from_view.translation();
        for item in phase.items.values_mut() {
            if let Some(&depth_bias) = distances.get(&item.entity.1.id()) {
                item.sorting_info = TransparentSortingInfo3d::Sorted { mesh_center, depth_bias };
            }
        }
    }
}
