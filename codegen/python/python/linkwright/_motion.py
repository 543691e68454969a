"""Motion of one mechanism."""

from __future__ import annotations

import html
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linkwright._columns import Array, Columns
from linkwright._errors import MotionWarning

if TYPE_CHECKING:
    import pandas
    import polars

    from linkwright import _core
    from linkwright._mechanism import Mechanism

#: Number of instants between which the page of a notebook plays.
PLAYED = 200


@dataclass(frozen=True)
class Failure:
    """Early end of a motion.

    Attributes
    ----------
    kind : str
        Name of the kind of failure, as in JSON and in C: ``"out_of_reach"``, ``"singular"``, …
    time : float
        Time that cannot be reached (s).
    block : int or None
        Index of the block of equations; of the quantity for ``"not_positive"``, of the parameter for ``"outside_range"``; None for a
        simulated motion.
    reason : str
        Reason in one sentence.
    """

    kind: str
    time: float
    block: int | None
    reason: str

    def __str__(self) -> str:
        return self.reason


@dataclass(frozen=True)
class Simulation:
    """Cost and accuracy of a simulated motion.

    Attributes
    ----------
    evaluations, steps, implicit_steps, rejected : int
        Numbers of evaluations of the equations of motion, of steps, of implicit ones among them, and of rejected steps.
    energy_drift : float
        Largest change of energy (J) that no force explains.
    """

    evaluations: int
    steps: int
    implicit_steps: int
    rejected: int
    energy_drift: float


class Motion(Columns):
    """Motion of a mechanism over T instants.

    Quantities are attributes, ``motion.phi_rocker``, and items, ``motion["phi_rocker"]``, with one value per instant. Their names are those
    of the columns that ``linkwright solve`` writes: ``phi_rocker``, ``phi_rocker_d`` and ``phi_rocker_dd`` for a coordinate, its rate and its
    acceleration; ``K_x``, ``K_vx``, ``K_ax`` for a point; ``effort_crank`` for a requested force. ``motion["K"]`` is the path of the point K,
    T x 2.

    Attributes
    ----------
    t : ndarray, (T,)
        Instants (s), in the order of the request.
    values : ndarray, (T, number of quantities)
        All values in SI units; NaN where the motion has ended.
    failed : Failure or None
        Early end of the motion; None if it is complete.
    warnings : tuple of str
        Warnings, such as a singular pose nearby.
    residual : float
        Largest scaled residual of the constraints.
    reciprocal_condition : float
        Reciprocal condition of the dimensionless Φ_q at the start.
    simulation : Simulation or None
        Cost of a simulated motion.
    mechanism : Mechanism
        Mechanism that moves.
    """

    failed: Failure | None
    warnings: tuple[str, ...]
    residual: float
    reciprocal_condition: float
    simulation: Simulation | None
    mechanism: Mechanism

    def __init__(self, mechanism: Mechanism, t: Array, solved: _core.Solved) -> None:
        super().__init__(t, solved.values, {name: unit for name, unit, _ in solved.columns})
        self.mechanism = mechanism
        self.warnings = tuple(solved.warnings)
        self.residual = solved.residual
        self.reciprocal_condition = solved.reciprocal_condition
        failure, reason = solved.failure, solved.error or ""
        self.failed = None if failure is None else Failure(*failure, reason)
        self.simulation = None
        if solved.simulation is not None:
            effort, drift = solved.simulation
            self.simulation = Simulation(*effort, drift)

    def _warn(self) -> Motion:
        """Warn about an early end and about singular poses, at the caller of the caller."""
        name = self.mechanism.name
        for text in [*([self.failed.reason] if self.failed else []), *self.warnings]:
            warnings.warn(f"`{name}` {text}" if self.failed else text, MotionWarning, stacklevel=3)
        return self

    @property
    def solved(self) -> NDArray[np.bool_]:
        """True for each instant with a pose, (T,)."""
        coordinates = len(self.mechanism.coordinates)
        finite = np.isfinite(self.values[:, :coordinates])
        return np.asarray(finite.all(axis=1), dtype=np.bool_)

    def __len__(self) -> int:
        return len(self.t)

    def to_structured(self) -> NDArray[np.void]:
        """Return `t` and all quantities as a structured array, one record per instant."""
        return self._records([("t", self.t)])

    def to_dict(self) -> dict[str, Array]:
        """Return `t` and all quantities by name."""
        return {"t": self.t, **{name: self[name] for name in self.names}}

    def to_pandas(self) -> pandas.DataFrame:
        """Return a DataFrame with a column per quantity and `t` as its index; needs pandas."""
        import pandas

        return pandas.DataFrame(self.to_dict()).set_index("t")

    def to_polars(self) -> polars.DataFrame:
        """Return a DataFrame of polars with `t` and a column per quantity; needs polars."""
        import polars

        return polars.DataFrame(self.to_dict())

    def page(self) -> str:
        """Return the page of this motion: one HTML file that loads nothing, with drawing, equations and curves."""
        start, end = float(self.t.min(initial=0.0)), float(self.t.max(initial=0.0))
        return self.mechanism.page(start, end, (end - start) / PLAYED or 1.0)

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:640px;border:0" title="{html.escape(self.mechanism.name)}"></iframe>'

    def __repr__(self) -> str:
        span = f", t = {self.t.min():g} to {self.t.max():g} s" if len(self.t) else ""
        end = f", {self.failed.kind} at t = {self.failed.time:g} s" if self.failed else ""
        return f"<Motion of {self.mechanism.name}: {len(self.t)} instants{span}{end}>"
