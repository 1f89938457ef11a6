//! Texts of the canvas and of the first five steps' panels.

use super::texts;

texts! {
    /// Marks, handles and tools.
    Marks, MARKS {
        canvas: "Picture",
        tour: "Tour",
        no_picture: "The picture is loading…",
        no_tour: "No tour yet: the horizon, or two reflection pairs, are needed.",
        tour_comes: "The tour is being built…",
        selected: "Selected",
        place: "Place",
        horizon_left: "Horizon, left end",
        horizon_right: "Horizon, right end",
        principal_point: "Optical middle",
        length_end: "Known length, end {}",
        pair_point: "Pair {}, point",
        pair_reflection: "Pair {}, reflection",
        corner: "corner {}",
        left_foot: "left foot",
        right_foot: "right foot",
        sway_root: "fixed end",
        sway_tip: "free end",
        waypoint: "waypoint {}",
        water: "Water",
        ground: "Ground",
        sky: "Sky",
        background: "Background",
        background_contact: "Background's foot",
        new_object: "object {}",
        new_band: "band {}",
        hint_select: "Drag handles; drag an edge to bend it. Wheel zooms, dragging beside marks pans; arrow keys move by 1 px, Shift 10, Alt 0.1.",
        hint_horizon: "Drag from one end of the horizon to the other, or click both.",
        hint_principal: "Click where the lens pointed.",
        hint_length: "Drag along a length that you know.",
        hint_outline: "Click around it; Enter, a double click or a click on the first corner closes. Backspace takes back, Escape gives up.",
        hint_contact: "Drag from the left foot to the right foot.",
        hint_background: "Click along the line where it meets the water; Enter ends.",
        hint_pair: "Click a point, then its reflection; or drag from one to the other. Escape ends.",
        hint_box: "Drag a box around it.",
        hint_stroke: "Draw strokes: inside on what belongs to it, outside on what does not; X switches.",
        hint_grow: "Click it, or draw a stroke on it.",
        hint_brush: "Paint what belongs to it, erase what does not; X switches.",
        hint_course: "Click the boat's way on the water; Enter ends.",
    }
}

texts! {
    /// Regions and their tools.
    Regions, REGIONS {
        draw: "Draw the outline",
        draw_again: "Draw anew",
        grow: "Grow from a stroke",
        boxed: "Find in a box",
        strokes: "Mend by strokes",
        brush: "Brush",
        is_right: "It is right",
        clear: "Clear",
        corners: "Outline with {} corners",
        mask: "Mask {}",
        none: "Not drawn yet",
        box_around: "Drag a box around “{}”.",
        live_wire: "Cling to edges",
        paint: "Paint",
        erase: "Erase",
        inside: "Inside",
        outside: "Outside",
        radius: "Radius",
        hardness: "Hardness",
        remove_water: "No water",
        remove_water_hint: "Removes the reflection pairs too",
    }
}

texts! {
    /// Step 1.
    Horizon, HORIZON {
        draw: "Draw the horizon",
        draw_again: "Draw anew",
        clear: "Clear",
        take_solved: "Take the solved one",
        take_solved_hint: "Puts the horizon where the reflections say that it is",
        left_end: "Left end",
        right_end: "Right end",
        tilt: "Tilt",
        scale: "Scale",
        scale_by: "Set by",
        scale_assumed: "Not known",
        above_water: "Height above water",
        above_ground: "Height above ground",
        known_length: "A known length",
        height: "Height",
        height_assumed: "{} m are assumed: an adult's eyes.",
        length: "Length",
        length_on: "Measured on “{}”",
        length_needs_object: "A known length needs an object that it is measured on.",
        draw_length: "Draw a length on:",
        picture: "The picture",
        medium: "Made as",
        photograph: "Photograph",
        painting: "Painting",
        print: "Print or drawing",
        own_principal: "The lens did not point at the middle",
    }
}

texts! {
    /// Step 3.
    Background, BACKGROUND {
        stands: "Stands",
        found: "Where the pairs say",
        at_distance: "At a distance",
        by_contact: "Where it meets the water",
        at_infinity: "Infinitely far",
        distance: "Distance",
        draw_contact: "Draw its foot",
        draw_contact_again: "Draw its foot anew",
        ground_height: "Above the water",
        ground_height_hint: "How high the ground lies above the water",
        remove_ground: "No ground",
        new_band: "Draw a band",
        band_name: "Band's name",
        remove: "Remove",
        remove_named: "Remove “{}”",
        sky_layer: "The sky is a layer of its own",
        no_sky: "The sky belongs to the background.",
    }
}

texts! {
    /// Step 4.
    Objects, OBJECTS {
        draw_new: "Draw a new object",
        name: "Object's name",
        remove: "Remove",
        outline: "Outline",
        stands: "Stands",
        in_water: "In the water",
        on_ground: "On the ground",
        draw_contact: "Draw the contact line",
        propose_contact: "Propose it",
        propose_contact_hint: "Finds the contact line from the outline's lower edge",
        left_foot: "Left foot",
        right_foot: "Right foot",
        turns: "Turns to a camera that moves around it",
    }
}

texts! {
    /// Step 5.
    Pairs, PAIRS {
        mark: "Mark pairs",
        tenfold: "Errors ×10",
        number: "Pair {}",
        left_out: "left out",
        point: "Point",
        reflection: "Reflection",
        on: "Lies on",
        unknown: "Not known",
        remove: "Remove the pair",
    }
}
