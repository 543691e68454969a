//! Proposes options that make an expensive simulation cheaper.

use linkwright_solver::Method;
use linkwright_solver::simulation::Effort;

/// Number of evaluations beyond which another method is proposed.
const MANY_EVALUATIONS: u64 = 1_000_000;

/// Returns the option that may save evaluations of an expensive motion; `None` if there are few evaluations.
pub fn hint(effort: &Effort, method: Method) -> Option<&'static str> {
    let is_implicit = match method {
        Method::Implicit => true,
        Method::Explicit => false,
        Method::Automatic => 2 * effort.implicit > effort.steps,
    };
    (effort.evaluations > MANY_EVALUATIONS).then_some(if is_implicit {
        "`--method dop853` takes explicit steps, and a larger `--rtol` fewer ones"
    } else {
        "`--method implicit` takes fewer steps where the motion is stiff, and so does a larger `--rtol`"
    })
}
