"""Fits to measured values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright._columns import Array

if TYPE_CHECKING:
    from linkwright._mechanism import Mechanism


@dataclass(frozen=True)
class Difference:
    """Differences of measured from solved values, in the SI unit of the quantity.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    count : int
        Number of compared values.
    rms : float
        Root mean square.
    largest : float
        Difference of the largest magnitude, measured minus solved.
    time : float
        Time of the largest difference (s).
    """

    quantity: str
    count: int
    rms: float
    largest: float
    time: float


class Fit:
    """Parameters with which a mechanism moves as measured.

    Attributes
    ----------
    values : dict of str to float
        Fitted values in SI units.
    deviations : dict of str to float or None
        Standard deviations; None for a value that the motion does not determine.
    intervals : dict of str to list of float or None
        Intervals that hold each value with a probability of 95 %.
    at_bound : dict of str to float or None
        Bound at which a value is.
    correlations : ndarray, (p, p)
        Correlations of the values; NaN where they are not determined.
    is_trusted : bool
        True if the measured values determine all parameters and the residuals are noise.
    undetermined : tuple of str
        Combinations of parameters that the motion does not determine, one sentence each.
    residuals : dict of str to ndarray
        Measured minus solved values by quantity; NaN where a value is missing.
    freedom, evaluations : int
        Degrees of freedom, and number of solutions of the motion.
    mechanism : Mechanism
        Mechanism with the fitted values.
    """

    def __init__(self, mechanism: Mechanism, columns: list[str], found: dict[str, Any]) -> None:
        names = found["names"]
        self.values: dict[str, float] = dict(zip(names, found["values"], strict=False))
        self.deviations: dict[str, float | None] = dict(zip(names, found["deviations"], strict=False))
        self.intervals: dict[str, list[float] | None] = dict(zip(names, found["intervals"], strict=False))
        self.at_bound: dict[str, float | None] = dict(zip(names, found["at_bound"], strict=False))
        self.correlations: Array = np.array(found["correlations"], dtype=np.float64)
        self.is_trusted: bool = found["is_trusted"]
        self.undetermined: tuple[str, ...] = tuple(found["undetermined"])
        residuals = [np.array(it, dtype=np.float64) for it in found["residuals"]]
        self.residuals: dict[str, Array] = dict(zip(columns, residuals, strict=False))
        self.freedom: int = found["freedom"]
        self.evaluations: int = found["evaluations"]
        self.mechanism = mechanism(**self.values)

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in self.values.items())
        return f"<Fit: {values}{'' if self.is_trusted else ', not to be trusted'}>"
