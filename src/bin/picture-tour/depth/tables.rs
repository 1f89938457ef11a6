//! What the water's mirror image tells, in words and tables.

use std::io;
use std::io::Write;

use super::MeasuredBand;
use super::MirrorImage;
use super::Standing;
use crate::table::Table;

/// Writes what the mirror image tells.
pub(crate) fn write(out: &mut impl Write, mirror: &MirrorImage) -> io::Result<()> {
    if !mirror.found {
        return writeln!(
            out,
            "\nDistances by the mirror image: none; the water shows nothing that could be matched"
        );
    }
    writeln!(
        out,
        "\nDistances by the mirror image: known of {:.0} % of what is not water",
        100.0 * mirror.known
    )?;
    let mut table = Table::new(["", "by its mark", "mirrored", "±", "known", ""]);
    for Standing { name, distance, mirrored, known, verdict } in &mirror.standing {
        let [by, deviation] = match mirrored {
            Some(values) => values.map(meters),
            None => std::array::from_fn(|_| "?".to_owned()),
        };
        let remark = match *verdict {
            "wrong foot" => "they disagree: check its contact line or distance",
            "not flat" => "parts of it stand at other distances",
            "unknown" => "too little is known to tell",
            _ => "",
        };
        let known = format!("{:.0} %", 100.0 * known);
        table.row([name.clone(), meters(*distance), by, deviation, known, remark.to_owned()]);
    }
    table.write(out)?;
    if !mirror.bands.is_empty() {
        writeln!(out, "\nWhat the background shows, far to near (`picture-tour bands` cuts it so)")?;
        table_of_bands(&mirror.bands).write(out)?;
    }
    let mut lines = Vec::new();
    let [offset, deviation] = mirror.horizon_offset_px;
    let side = if offset < 0.0 { "higher" } else { "lower" };
    lines.push(format!(
        "it puts the horizon {:.1} ± {deviation:.1} px {side} than the solution does",
        offset.abs()
    ));
    if let Some([tilt, deviation]) = mirror.waterline_tilt_deg {
        lines.push(format!("leveled, the far waterline falls by {tilt:+.2} ± {deviation:.2}° to the right (a shore across the view: 0°)"));
    }
    if let Some(by) = &mirror.by_pairs {
        let [pitch, pitch_deviation] = by.pitch_deg;
        let [roll, roll_deviation] = by.roll_deg;
        lines.push(format!(
            "with {} more pairs found in it the pitch is {pitch:.3} ± {pitch_deviation:.3}° (by the marks {:.3}°), the \
             roll {roll:.3} ± {roll_deviation:.3}° ({:.3}°)",
            by.pairs, by.marked_pitch_deg, by.marked_roll_deg
        ));
    }
    for line in lines {
        writeln!(out, "  - {line}")?;
    }
    Ok(())
}

/// A length with as many digits as it may deserve.
fn meters(value: f64) -> String {
    let decimals = if value < 1.0 { 2 } else { 1 };
    format!("{value:.decimals$} m")
}

/// Bands as a table, in the order they come.
pub(crate) fn table_of_bands(bands: &[MeasuredBand]) -> Table<4> {
    let mut table = Table::new(["", "±", "measured", ""]);
    for band in bands {
        let distance = band.distance.map_or_else(|| "sky".to_owned(), meters);
        let deviation = band.deviation.map_or_else(|| "-".to_owned(), meters);
        let measured = format!("{:.0} %", 100.0 * band.measured);
        let remark = match (band.recedes, band.real) {
            (true, _) => "recedes along its contact line",
            (false, true) => "",
            (false, false) => "cannot be told from the one before",
        };
        table.row([distance, deviation, measured, remark.to_owned()]);
    }
    table
}
