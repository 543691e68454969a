//! Fits parameters of a description to a table of measured values.

mod pictures;

use linkwright_calibrate::{Calibrator, Measurements, Unfit, leave_out_underived};
use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::system::System;

use super::bounds::bounds;
use super::compare::read;
use super::description::{
    along, chosen, determined, interpreted, outputs_besides, set_all, source,
};
use super::rewritten::{SIGNATURE, rewritten};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::Calibrate;
use crate::report::calibration::{self, Report};
use crate::report::{comparison_plot, picture};

/// Fits parameters and reports the fit.
///
/// # Errors
/// The description or the table has errors, an option cannot be used, or the new description cannot be written. An [`Outcome`] reports
/// a fit that fails.
pub fn run(arguments: &Calibrate) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let plain = determined(&source, arguments.described.motion.as_deref())?;
    check_names(&plain.system, &arguments.param)?;
    let names: Vec<&str> = arguments.param.iter().map(|it| it.trim()).collect();
    let derived = along(&source, arguments.described.motion.as_deref(), &names)?;
    let derived = set_all(derived, &arguments.setting.set)?;
    let mut data = read(&arguments.table, &derived, true)?;
    let derived = data.drive(derived).map_err(Problem)?;
    leave_out_underived(&mut data, &derived).map_err(Problem)?;
    let measurements =
        Measurements::of(&data, "--deviation", &arguments.deviation).map_err(Problem)?;
    let mut outputs = outputs_besides(
        &arguments.described.file,
        &source,
        Some(&arguments.table.data),
        arguments.force,
    );
    let output = match &arguments.out {
        Some(path) => Some(outputs.file(path, SIGNATURE)?),
        None => None,
    };
    let mut pictures = Vec::new();
    if let Some(folder) = &arguments.plot {
        for name in comparison_plot::file_names(&data) {
            pictures.push(outputs.file(&in_folder(folder, &name)?, picture::SIGNATURE)?);
        }
    }
    let view = interpreted(&derived, &source)?;
    let mut calibrator = Calibrator::of(view, arguments.step);
    if let Some((_, modes)) = chosen(&arguments.setting.branch, calibrator.view(), data.times[0])? {
        calibrator = calibrator.in_modes(modes);
    }
    calibrator = bounded(calibrator, &derived.system, &arguments.bound)?;
    let start = calibrator.nominal();
    let title = derived.system.mechanism.title();
    let identification = calibrator.identify(&measurements, &start);
    if let Ok(identification) = &identification
        && !arguments.json
    {
        print(|output| calibration::write_head(&title, &data, identification, output))?;
    }
    let fit = match identification.and_then(|_| calibrator.fit(&measurements, &start)) {
        Ok(fit) => fit,
        Err(unfit) => {
            let why = match unfit {
                Unfit::OutsideBounds(name) => format!("error: `{name}` does not begin strictly within its bounds\n  = help: begin within them with `--set`, or move them with `--bound`"),
                Unfit::Unsolved(why) => format!("error: `{title}` {why}\n  = help: check with `linkwright compare` how far it moves as measured, or begin with other values by `--set`"),
                Unfit::TooFew(values, parameters) => format!("error: {values} measured values are too few for {parameters} parameters"),
                Unfit::NoParameters => "error: no parameter is selected for the fit".to_string(),
                Unfit::NotConverged => "error: the fit does not converge\n  = help: fit fewer parameters first, or begin nearer with `--set`".to_string(),
            };
            say(&why);
            return Ok(Outcome::Failed);
        }
    };
    let report = Report {
        start: &start,
        names: calibrator.names(),
        system: &derived.system,
        title,
        fit: &fit,
        data: &data,
    };
    print(|output| match arguments.json {
        true => calibration::write_json(&report, output),
        false => calibration::write(&report, output),
    })?;
    pictures::draw(&fit, &data, &derived.system, pictures, arguments.json)?;
    let is_trusted = fit.is_trusted();
    if !is_trusted {
        let is_free = fit.at_bound.iter().all(Option::is_none);
        let undetermined = is_free && !fit.identified.determines_all();
        say(match undetermined {
            true => {
                "error: this motion does not determine all parameters\n  = help: leave one of each combination out of `--param`, or measure something else"
            }
            false => {
                "error: this fit is not to be trusted\n  = help: check assembly, start and units with `linkwright compare`, or give the accuracy of the values with `--deviation`"
            }
        });
        if output.is_none() || !arguments.force {
            return Ok(Outcome::Failed);
        }
    }
    if let Some(output) = output {
        let names = calibrator.names().iter().map(String::as_str);
        let values: Vec<(&str, f64)> = names.zip(fit.values.iter().copied()).collect();
        let text = rewritten(&source, &values, &[], &derived).map_err(Problem)?;
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(text.as_bytes()))?;
        if !arguments.json {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(match is_trusted {
        true => Outcome::Done,
        false => Outcome::Failed,
    })
}

/// Returns the calibrator with the bounds of the options.
fn bounded(
    calibrator: Calibrator,
    system: &System,
    options: &[String],
) -> Result<Calibrator, Problem> {
    let mut calibrator = calibrator;
    for option in options {
        let refused = |why: &str| {
            Problem(format!(
                "error: `--bound {option}` {why}\n  = help: write `L=1mm..2mm`, `L=0..` or `L=..` for no bounds"
            ))
        };
        let (name, range) = option
            .split_once('=')
            .ok_or_else(|| refused("does not name a parameter"))?;
        let name = name.trim();
        let fitted = calibrator.names().iter().position(|it| it == name);
        let mut parameters = system.mechanism.parameters.iter();
        let parameter = parameters.find(|it| it.name == name);
        let (Some(place), Some(parameter)) = (fitted, parameter) else {
            return Err(refused("is not one of `--param`"));
        };
        let bounds = bounds(system, parameter, &format!("--bound {option}"), range)?;
        calibrator = calibrator.within(place, bounds);
    }
    Ok(calibrator)
}

/// Checks that all names are those of parameters, each once.
fn check_names(system: &System, names: &[String]) -> Result<(), Problem> {
    let mechanism = &system.mechanism;
    let known = || mechanism.parameters.iter().map(|it| it.name.as_str());
    let declare = "declare a parameter to fit, for example `param L2 = 40mm;`";
    if names.is_empty() {
        let help = match known().collect::<Vec<_>>().join(",") {
            none if none.is_empty() => format!("{declare}, and named by `--param L2`"),
            all => format!("name the parameters to fit, for example `--param {all}`"),
        };
        return Err(Problem(format!(
            "error: no parameter of `{}` is selected for the fit\n  = help: {help}",
            mechanism.title()
        )));
    }
    for (place, name) in names.iter().enumerate() {
        let name = name.trim();
        if names[..place].iter().any(|it| it.trim() == name) {
            return Err(Problem(format!("error: `--param` names `{name}` twice")));
        }
        if known().any(|it| it == name) {
            continue;
        }
        let help = match (nearest(name, known()), known().next()) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, None) => declare.to_string(),
            (None, Some(_)) => format!(
                "its parameters are: {}",
                known().collect::<Vec<_>>().join(", ")
            ),
        };
        return Err(Problem(format!(
            "error: `{}` has no parameter `{name}`\n  = help: {help}",
            mechanism.title()
        )));
    }
    Ok(())
}
