// What every tour shader does last: the game's grading, if the tour follows it.

#define_import_path bevy_picture_tour::finish

#ifdef TOUR_GRADED
#ifdef TONEMAP_IN_SHADER
#import bevy_core_pipeline::tonemapping::tone_mapping
#import bevy_pbr::mesh_view_bindings::view
#endif
#endif

fn finish(color: vec4<f32>) -> vec4<f32> {
#ifdef TOUR_GRADED
#ifdef TONEMAP_IN_SHADER
    return tone_mapping(color, view.color_grading);
#else
    return color;
#endif
#else
    return color;
#endif
}
