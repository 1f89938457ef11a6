//! `check`: every problem of a tour, or else how well its picture is solved, a sheet of views, and what the mirror image
//! tells.

use std::io;
use std::io::Write;
use std::path::Path;
use std::path::PathBuf;
use std::process::ExitCode;

use bevy_picture_tour::maps::HALO_LIFT;
use bevy_picture_tour::solve::Label;

use crate::beside;
use crate::depth;
use crate::failure::Failure;
use crate::open;
use crate::report::Bounds;
use crate::report::Component;
use crate::report::Findings;
use crate::report::Parameter;
use crate::report::Report;
use crate::report::Water;
use crate::sheet;
use crate::table::Table;

/// Pictures to draw beside the report.
#[derive(Debug)]
pub(crate) struct Drawings {
    /// Views to judge the tour by.
    pub(crate) sheet: Option<PathBuf>,
    /// Distances by the mirror image.
    pub(crate) depth: Option<PathBuf>,
}

/// Checks a tour, or the demo.
pub(crate) fn run(tour: Option<&Path>, json: bool, drawings: &Drawings) -> Result<ExitCode, Failure> {
    let mut stdout = io::stdout().lock();
    let report = match report(tour, drawings) {
        Err(Failure::Problems(problems)) if json => {
            let name = tour.map_or_else(String::new, |tour| tour.display().to_string());
            Report::of_problems(name, &problems)
        }
        report => report?,
    };
    match &report.findings {
        _ if json => {
            let text = serde_json::to_string_pretty(&report).map_err(io::Error::from)?;
            writeln!(stdout, "{text}")?;
        }
        Some(findings) => write_findings(&mut stdout, &report.tour, findings)?,
        None => {}
    }
    Ok(ExitCode::from(u8::from(!report.problems.is_empty())))
}

fn report(tour: Option<&Path>, drawings: &Drawings) -> Result<Report, Failure> {
    let opened = open::open(tour)?;
    let drawn = [&drawings.sheet, &drawings.depth].into_iter().flatten().cloned();
    beside::refuse_own(tour, opened.asset.tour(), drawn)?;
    let source = depth::source_of(&opened, tour)?;
    if let (None, Some(path)) = (&source, &drawings.depth) {
        return Err(Failure::CannotRun(format!(
            "{} cannot be drawn: a baked tour does not keep its picture; check the .tour.ron",
            path.display()
        )));
    }
    let assembled = opened.assemble(&|| false)?;
    if let Some(path) = &drawings.sheet {
        sheet::save(&assembled, path)?;
    }
    let mirrored = match &source {
        Some(source) => depth::measured(source, &assembled, drawings.depth.as_deref())?,
        None => None,
    };
    Ok(Report::of(opened.name, &assembled, mirrored))
}

fn write_findings(out: &mut impl Write, tour: &str, findings: &Findings) -> io::Result<()> {
    writeln!(out, "{tour}: no problems\n\nThe camera ({:?} method)", findings.method)?;
    parameters(&findings.parameters).write(out)?;
    if !findings.pairs.is_empty() {
        writeln!(out, "\nReflection pairs: how far each is from where the solution puts it")?;
        pairs(findings).write(out)?;
    }
    if !findings.remarks.is_empty() {
        writeln!(out, "\nRemarks")?;
        for remark in &findings.remarks {
            writeln!(out, "  - {remark}")?;
        }
    }
    writeln!(out, "\nReflection maps: what the picture's water shows, what was predicted, what is missing")?;
    components(&findings.components).write(out)?;
    if let Some(Water { error_codes, fresnel_strength, ripple_slope }) = findings.water {
        let ripples = match ripple_slope {
            0.0 => "it is still".to_owned(),
            slope => format!("its ripples' slope is {:.2} % (root mean square)", 100.0 * slope),
        };
        writeln!(
            out,
            "\nThe water: mirror images are predicted within {error_codes:.1} codes (median); they follow Fresnel's law \
             at {:.0} %; {ripples}",
            100.0 * fresnel_strength
        )?;
    }
    if let Some(mirror) = &findings.mirror_image {
        depth::write(out, mirror)?;
    }
    let Bounds { left, right, forward, back, up, down } = findings.bounds;
    writeln!(out, "\nThe picture holds up to these distances from where it was taken")?;
    writeln!(
        out,
        "  left {left:.1} m, right {right:.1} m, forward {forward:.1} m, back {back:.1} m, up {up:.1} m, down \
         {down:.1} m"
    )
}

fn parameters(parameters: &[Parameter]) -> Table<5> {
    let mut table = Table::new(["", "value", "±", "how sure", "from"]);
    for Parameter { name, value, unit, deviation, label, from } in parameters {
        // Heights are small lengths, distances large ones.
        let (name, decimals) = match *name {
            "focal_px" => ("focal length", 0),
            "height" => ("camera above the water", 2),
            "ground_height" => ("ground above the water", 2),
            "background_distance" => ("distance of the background", 1),
            angle => (angle, 2),
        };
        let unit = if *unit == "deg" { "°".to_owned() } else { format!(" {unit}") };
        let deviation = match deviation {
            Some(0.0) => "0".to_owned(),
            Some(deviation) => format!("{deviation:.decimals$}{unit}"),
            None => "?".to_owned(),
        };
        let label = match label {
            Label::Measured => "measured",
            Label::Weak => "weak",
            Label::Assumed => "assumed",
        };
        let value = format!("{value:.decimals$}{unit}");
        table.row([name.to_owned(), value, deviation, label.to_owned(), from.join(", ")]);
    }
    table
}

fn pairs(findings: &Findings) -> Table<5> {
    let mut table = Table::new(["", "off by", "depth", "used", ""]);
    for pair in &findings.pairs {
        table.row([
            pair.name.clone(),
            format!("{:.1} px", pair.residual_px),
            pair.depth.map_or_else(|| "far".to_owned(), |depth| format!("{depth:.1} m")),
            if pair.kept { "yes" } else { "no" }.to_owned(),
            pair.remark.clone().unwrap_or_default(),
        ]);
    }
    table
}

fn components(components: &[Component]) -> Table<6> {
    let percent = |share: f32| format!("{:.0} %", 100.0 * share);
    let mut table = Table::new(["", "seen", "predicted", "missing", "mean lift", ""]);
    for Component { name, reflection, mean_lift } in components {
        let [seen, predicted, missing] = match reflection {
            Some(shares) => [shares.seen, shares.predicted, shares.missing].map(percent),
            None => std::array::from_fn(|_| "-".to_owned()),
        };
        let remark = match reflection {
            _ if *mean_lift > HALO_LIFT => "a halo will show: draw its mask more exactly",
            None => "the water shows nothing of it",
            Some(_) => "",
        };
        table.row([name.clone(), seen, predicted, missing, percent(*mean_lift), remark.to_owned()]);
    }
    table
}
