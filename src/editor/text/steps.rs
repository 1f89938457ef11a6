//! Texts of the six steps, of what they need, and of the solver's report.

use super::texts;

texts! {
    /// Names of the steps, and what to do in each.
    Steps, STEPS {
        horizon: "Horizon",
        horizon_task: "Draw the line where level water would meet the sky, also where trees or hills hide it.",
        water: "Water",
        water_task: "Outline everything that is water, or draw a stroke on it and let it grow.",
        ground: "Ground and background",
        ground_task: "Outline the ground one could walk on, and say where the far shore stands.",
        objects: "Objects",
        objects_task: "Outline what stands in front of the background, and mark where it meets water or ground.",
        pairs: "Reflection pairs",
        pairs_task: "Click a sharp point and its reflection in the water; a few, spread over the whole width.",
        motion: "Motion and camera path",
        motion_task: "Say what moves and how, and where the camera flies by itself.",
    }
}

texts! {
    /// Lamps and needs.
    Needs, NEEDS {
        lamp_missing: "missing",
        lamp_rough: "rough",
        lamp_good: "good",
        horizon: "Draw the horizon, or take the suggested one.",
        horizon_unsure: "Reflection pairs would confirm the horizon.",
        horizon_off: "The reflections put the horizon {} px from where it is drawn: look at the dashed line.",
        water: "Outline the water.",
        guessed_water: "What is colored is a first guess: mend it, or say that it is right.",
        guessed_ground: "The ground is a first guess: mend it, or say that it is right.",
        guessed_sky: "The sky is a first guess: mend it, or say that it is right.",
        background: "Say where the background stands: draw where it meets the water, or mark pairs on it.",
        background_unsure: "The background's distance is uncertain: draw where it meets the water, or mark pairs on it.",
        background_pairs: "Its foot alone does not tell the background's distance: a horizon that is sure would, and pairs on it.",
        objects: "Nothing is outlined. What stands in the water or near the camera stays flat until it is.",
        outline: "“{}” has no outline.",
        contact: "The feet of “{}” are not below the horizon.",
        water_first: "Outline the water first.",
        one_pair: "Mark one more pair.",
        pairs: "Mark {} more pairs.",
        pairs_off: "{} of the pairs disagree with the others: move or remove them.",
        pairs_spread: "The pairs stand close together: mark one far to the left or right.",
        focal_length: "The focal length cannot be seen in this picture: type it below if you know it, or turning the head may swim.",
        motion: "Nothing moves yet: give the wind a speed, or an object a motion.",
        path: "No path yet: fly somewhere and take a keyframe, twice or more.",
    }
}

texts! {
    /// The solver's report.
    Report, REPORT {
        title: "What was found",
        none: "Nothing could be solved yet.",
        focal_length: "Focal length",
        pitch: "Looks up by",
        roll: "Tilted by",
        height: "Height above the water",
        ground_height: "Ground above the water",
        background_distance: "Background at",
        other: "Other",
        given: "given",
        measured: "measured",
        weak: "weak",
        assumed: "assumed",
        from: "From:",
        locks: "What you know",
        focal_unknown: "Found from the picture",
        focal_locked: "Locked to a value",
        focal_between: "Between two values",
        focal_exif: "From the picture's EXIF",
        focal_mm: "Millimeters",
        focal_mm_hint: "As on a camera with a frame 36 mm wide",
        focal_least: "At least",
        focal_most: "At most",
        field_of_view: "Field of view",
        lock_height: "Lock the height above the water",
        lock_distance: "Lock the background's distance",
        method: "Method",
        method_full: "Full: tilt, several depths",
        method_paper: "The paper's: level camera",
    }
}
