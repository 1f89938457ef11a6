//! Texts around the picture: bars, dialogs, suggestions.

use super::texts;

texts! {
    /// The bars at top and bottom, and the start page.
    Bar, BAR {
        program: "Picture tour",
        untitled: "New tour",
        file: "File",
        open: "Open…",
        recent: "Open recent",
        save: "Save",
        save_as: "Save as…",
        versions: "Earlier versions",
        find_picture: "Find the picture…",
        close: "Close",
        undo: "Undo",
        redo: "Redo",
        undo_what: "Undo: {}",
        redo_what: "Redo: {}",
        split: "Picture and tour",
        picture_only: "Picture only",
        tour_only: "Tour only",
        fit: "Fit",
        fit_hint: "Show all of the picture (F)",
        snap: "Snap",
        snap_hint: "Dragged points go to other points and to the picture's border; not while Alt is held",
        suggest: "Suggest",
        suggest_hint: "Let the machine propose all marks that it can find",
        start: "Step into a picture",
        start_hint: "Open a picture with water in it, or a tour; or drop one here.",
        open_picture: "Open a picture or tour…",
        unsaved: "not saved",
        more_tasks: "and {} more",
        cancel: "Cancel",
    }
}

texts! {
    /// Questions and messages.
    Dialog, DIALOG {
        closing: "Save before closing?",
        closing_detail: "Not everything that you marked is saved.",
        save_and_close: "Save and close",
        close_unsaved: "Close without saving",
        stay: "Stay",
        recovery: "There are unsaved marks of “{}”",
        recovery_detail: "The program ended before they were saved, {}. What is in the tour's own file stays as it is until you save.",
        recover: "Go on with them",
        discard: "Discard them",
        changed: "“{}” was changed by another window or program",
        changed_detail: "If you save over it, what stands there now is kept as an earlier version.",
        save_over: "Save over it",
        not_now: "Not now",
        existing: "There is a tour of this picture: “{}”",
        existing_detail: "Go on with its marks, or begin a new tour beside it.",
        open_existing: "Open it",
        start_new: "Begin a new one",
        dismiss: "Got it",
        picture_lost: "The tour's picture is not where it was. All marks are kept; say where the picture is now.",
    }
}

texts! {
    /// Proposals of the machine.
    Suggest, SUGGEST {
        horizon: "Suggest the horizon",
        regions: "Suggest water, sky and ground",
        pairs: "Suggest pairs",
        sure: "{} % sure",
        take: "Take",
        mend: "Mend",
        refuse: "Refuse",
    }
}

texts! {
    /// What a session does: work in the background, files, and what became of them.
    Session, SESSION {
        tracing: "Finding edges",
        growing: "Growing the region",
        outlining: "Finding the outline",
        looking: "Looking for a reflection",
        building: "Building the tour",
        refining: "Refining the tour",
        drafted: "A first draft was made from the picture alone.",
        drafted_advice: "The lamps show what to mend. Undo takes it all back.",
        nothing_found: "Nothing to propose",
        saved: "Saved {}",
        taken: "“{}” is there already: save under another name, or open it",
        left_behind: "Not copied, because another simulator made it: {}",
        open_title: "Open a picture or a tour",
        save_title: "Save the tour as",
        find_title: "Where is the picture now?",
        some_time_ago: "some time ago",
        seconds_ago: "{} s ago",
        minutes_ago: "{} min ago",
        hours_ago: "{} h ago",
        days_ago: "{} days ago",
        notes: "Not everything in the file is known, and would be lost: {}",
    }
}
