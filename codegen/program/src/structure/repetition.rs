//! Reports equations that repeat one another, with the joints and a remedy.

use super::diagnose::{MAX_LISTED, balance, count};
use super::rank::{self, Dependence, Singular, Survey};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::model::{Joint, Role};
use crate::pool::Pool;
use crate::system::{Row, System};
use crate::units::OutputUnits;

/// Reports joints marked `redundant` that repeat nothing or contradict others.
pub(super) fn report_marks(pool: &Pool, system: &System, diagnostics: &mut Diagnostics) {
    let joints = &system.mechanism.joints;
    if let Some((line, user)) = rank::shared_line(system) {
        diagnostics.push(
            Diagnostic::error(
                Code::NotRedundant,
                joints[line].redundant.unwrap_or(joints[line].span),
                format!(
                    "`{}` cannot be redundant: `{}` measures along its line",
                    joints[line].label, joints[user].label
                ),
            )
            .label("its equations are all needed")
            .also(joints[user].span, "this needs its displacement")
            .help("mark another of the joints that repeat one another"),
        );
        return;
    }
    let is_large = system.coordinates.len() > rank::LARGEST_SURVEY;
    for (index, joint) in joints.iter().enumerate() {
        let Some(mark) = joint.redundant else {
            continue;
        };
        if system.monitored.iter().any(|row| row.joint == index) {
            continue;
        }
        let message = if is_large {
            format!(
                "whether `{}` is redundant is not worked out for more than {} coordinates",
                joint.label,
                rank::LARGEST_SURVEY
            )
        } else {
            format!(
                "`{}` is not redundant: its equations are independent",
                joint.label
            )
        };
        let help = if is_large {
            "leave the joint out"
        } else {
            "remove the word `redundant`"
        };
        diagnostics.push(
            Diagnostic::error(Code::NotRedundant, mark, message)
                .label("nothing repeats it")
                .help(help)
                .note(balance(system)),
        );
    }
    if let Some(misfit) = rank::misfit(pool, system) {
        let row = &system.monitored[misfit.monitored];
        let joint = &joints[row.joint];
        diagnostics.push(
            Diagnostic::error(
                Code::ContradictingEquations,
                joint.span,
                format!(
                    "`{}` does not fit the other joints: its equation `{}` is off by {}",
                    joint.label,
                    row.name,
                    size(misfit.size, row, system.mechanism.units.of_messages()),
                ),
            )
            .label("marked `redundant`, but not satisfied where the others are")
            .help("make the lengths fit exactly, as in `2*sqrt(3)` instead of `3.46`, or leave the joint out")
            .note("measured near the drawing, in poses in which all other equations hold"),
        );
    }
}

/// Returns a residual with its unit.
fn size(value: f64, row: &Row, units: &OutputUnits) -> String {
    let unit = units.of(&row.quantity.unit());
    let text = format!("{:.3e} {}", unit.of_si(value), unit.name);
    text.trim_end().to_string()
}

/// Reports a structurally square system whose equations repeat one another.
pub(super) fn report(
    pool: &Pool,
    system: &System,
    singular: &Singular,
    diagnostics: &mut Diagnostics,
) {
    match singular {
        Singular::Repeating(rows) => repeating(pool, system, rows, diagnostics),
        Singular::Contradicting {
            row,
            repeats,
            misfit,
        } => {
            let dependence = Dependence {
                row: *row,
                repeats: repeats.clone(),
            };
            diagnostics.push(contradicting(system, &dependence, *misfit));
        }
    }
}

fn repeating(pool: &Pool, system: &System, rows: &[usize], diagnostics: &mut Diagnostics) {
    let survey = Survey::of(pool, system).filter(|survey| !survey.dependences.is_empty());
    let Some(survey) = survey else {
        // The block is too large for a numerical rank, so the message names the block.
        let first = &system.mechanism.joints[system.rows[rows[0]].joint];
        let mut diagnostic = Diagnostic::error(
            Code::DependentEquations,
            first.span,
            format!(
                "{} of these joints and drivers repeat one another in every pose",
                count(rows.len(), "equation", "equations")
            ),
        )
        .label("one of them")
        .help("change one of these joints so that it says something of its own");
        for joint in joints_of(system, rows.iter().copied(), None) {
            diagnostic = diagnostic.also(system.mechanism.joints[joint].span, "one of them");
        }
        diagnostics.push(diagnostic);
        return;
    };
    let mut of_joints: Vec<usize> = survey
        .dependences
        .iter()
        .map(|found| system.row(found.row).joint)
        .collect();
    of_joints.dedup();
    for (at, joint) in of_joints.into_iter().enumerate() {
        let of_block: Vec<&Dependence> = survey
            .dependences
            .iter()
            .filter(|found| system.row(found.row).joint == joint)
            .collect();
        let mut diagnostic = dependent(system, joint, &of_block);
        if at == 0 {
            diagnostic = with_freedom(diagnostic, system, &survey);
        }
        diagnostics.push(diagnostic);
    }
}

/// Reports a joint whose equations follow from others.
fn dependent(system: &System, joint: usize, dependences: &[&Dependence]) -> Diagnostic {
    let declared = &system.mechanism.joints[joint];
    let names: Vec<String> = dependences
        .iter()
        .map(|found| format!("`{}`", system.row(found.row).name))
        .collect();
    let equations = if names.len() == 1 {
        "equation"
    } else {
        "equations"
    };
    let follow = if names.len() == 1 {
        "follows"
    } else {
        "follow"
    };
    let mut diagnostic = Diagnostic::error(
        Code::DependentEquations,
        declared.span,
        format!("`{}` repeats what other joints say", declared.label),
    )
    .label(format!(
        "its {equations} {} {follow} from the others in every pose",
        names.join(", ")
    ));
    let repeated = dependences
        .iter()
        .flat_map(|found| found.repeats.iter().copied());
    let others = joints_of(system, repeated, Some(joint));
    for &other in others.iter().take(MAX_LISTED) {
        diagnostic = diagnostic.also(
            system.mechanism.joints[other].span,
            "without this it would say something",
        );
    }
    if others.len() > MAX_LISTED {
        diagnostic = diagnostic.note(format!("and {} more take part", others.len() - MAX_LISTED));
    }
    for help in advice(system, declared, dependences) {
        diagnostic = diagnostic.help(help);
    }
    diagnostic
}

/// Returns remedies for a joint some of whose equations follow from others.
pub(super) fn advice(system: &System, joint: &Joint, dependences: &[&Dependence]) -> Vec<String> {
    if joint.role == Role::Driver {
        return vec!["remove the driver, or free what it moves".to_string()];
    }
    let first = dependences.first().map(|found| system.row(found.row));
    let joint_at = first.map_or(0, |row| row.joint);
    let rows = system.rows.iter().chain(&system.monitored);
    let all = rows.filter(|row| row.joint == joint_at).count();
    let mark = "write `redundant` before it, if it is meant to repeat them";
    if dependences.len() == all {
        return vec![format!("remove it, or {mark}")];
    }
    let prefix = format!("{}_", joint.slug);
    let weaker = first.and_then(|row| {
        let component = row.name.strip_prefix(&prefix)?;
        joint.kind.without(component)
    });
    match weaker {
        Some(weaker) => vec![
            format!("a joint like {weaker} would say only what is missing"),
            mark.to_string(),
        ],
        None => vec![mark.to_string()],
    }
}

/// Reports equations that repeat one another in every pose but contradict each other.
fn contradicting(system: &System, dependence: &Dependence, misfit: f64) -> Diagnostic {
    let row = system.row(dependence.row);
    let declared = &system.mechanism.joints[row.joint];
    let mut diagnostic = Diagnostic::error(
        Code::ContradictingEquations,
        declared.span,
        format!(
            "`{}` contradicts what other joints say by {}",
            declared.label,
            size(misfit, row, system.mechanism.units.of_messages())
        ),
    )
    .label(format!("`{}` cannot hold", row.name));
    let others = joints_of(system, dependence.repeats.iter().copied(), Some(row.joint));
    for &other in others.iter().take(MAX_LISTED) {
        let span = system.mechanism.joints[other].span;
        diagnostic = diagnostic.also(span, "says the same, but for the value");
    }
    diagnostic.help("remove one of these joints")
}

/// Returns the joints of these rows in written order, except for one.
fn joints_of(system: &System, rows: impl Iterator<Item = usize>, but: Option<usize>) -> Vec<usize> {
    let mut joints: Vec<usize> = rows.map(|row| system.row(row).joint).collect();
    joints.sort_unstable();
    joints.dedup();
    joints.retain(|&joint| Some(joint) != but);
    joints
}

/// Adds the degrees of freedom and the free motions.
pub(super) fn with_freedom(
    mut diagnostic: Diagnostic,
    system: &System,
    survey: &Survey,
) -> Diagnostic {
    const MAX_EXPLAINED: usize = 8;
    for motion in survey.motions.iter().take(MAX_EXPLAINED) {
        diagnostic = diagnostic.note(motion.sentence(system));
    }
    let redundant = match survey.dependences.len() {
        0 => String::new(),
        some => format!(
            ", {}",
            count(some, "redundant equation", "redundant equations")
        ),
    };
    diagnostic.note(format!(
        "KDOF = {}, NDOF = {}{redundant}",
        survey.kinematic, survey.net
    ))
}
