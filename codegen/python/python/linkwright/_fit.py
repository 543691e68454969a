"""Comparison with measured values, and fits to them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright._columns import Array, unknown
from linkwright._errors import MotionWarning
from linkwright._table import Data, Notes, listed, table

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
        Measured minus solved values by column; NaN where a value is missing.
    freedom, evaluations : int
        Degrees of freedom, and number of solutions of the motion.
    mechanism : Mechanism
        Mechanism with the fitted values.
    """

    def __init__(self, mechanism: Mechanism, found: dict[str, Any]) -> None:
        names = found["names"]
        self.values: dict[str, float] = dict(zip(names, found["values"], strict=False))
        self.deviations: dict[str, float | None] = dict(zip(names, found["deviations"], strict=False))
        self.intervals: dict[str, list[float] | None] = dict(zip(names, found["intervals"], strict=False))
        self.at_bound: dict[str, float | None] = dict(zip(names, found["at_bound"], strict=False))
        self.correlations: Array = np.array(found["correlations"], dtype=np.float64)
        self.is_trusted: bool = found["is_trusted"]
        self.undetermined: tuple[str, ...] = tuple(found["undetermined"])
        columns = found["columns"]
        residuals = [np.array(it, dtype=np.float64) for it in found["residuals"]]
        self.residuals: dict[str, Array] = dict(zip(columns, residuals, strict=False))
        self.freedom: int = found["freedom"]
        self.evaluations: int = found["evaluations"]
        self.mechanism = mechanism(**self.values)

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in self.values.items())
        return f"<Fit: {values}{'' if self.is_trusted else ', not to be trusted'}>"


def compare(
    self: Mechanism,
    data: Data,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | Sequence[str] | str | None = None,
    skip: Sequence[str] = (),
    time: str | None = None,
    shift: float = 0.0,
    delimiter: str | None = None,
    decimal: str | None = None,
    start: float | None = None,
    step: float = 0.01,
) -> Mapping[str, Difference]:
    """Compare measured values with the motion.

    A table is read as ``linkwright compare`` reads it. Columns with the names of quantities measure them, and names of other programs are
    guessed. Columns with the names of inputs drive these. Columns without a quantity are left out with a warning.

    Parameters
    ----------
    data : path, str, bytes, mapping or DataFrame
        Table of a file; text with line breaks is the table itself. The columns of a mapping or a DataFrame are numbers; its index is a
        column, too, if it has a name. Times never decrease. NaN stands for a missing value.
    columns : mapping of str to str, optional
        Quantity or input by the name of a column that does not say it: ``{"Sensor 3": "phi_rocker"}``.
    units : mapping of str to str, sequence of str or str, optional
        Unit by the name of a column, or units of all columns without one: ``"deg"``, ``["mm", "deg"]``. A unit may follow a name,
        ``"K_x (mm)"``. SI units without both.
    skip : sequence of str, optional
        Names of columns that are left out.
    time : str, optional
        Column of times; without it, the one named ``t`` or ``time``.
    shift : float, optional
        Time (s) added to all times.
    delimiter, decimal : str, optional
        Separator of cells and decimal mark of a table; without them, those that give a table of numbers.
    start : float, optional
        Time of the assembly (s); without it, the first one.
    step : float, optional
        Longest step between visited times (s).

    Returns
    -------
    mapping of str to Difference
        Differences in SI units by the name of the column; columns without a solved value are absent.

    Raises
    ------
    ValueError
        The data are not a table, or an argument does not suit them.
    OSError
        The file cannot be read.

    Examples
    --------
    >>> m.compare("log.csv", columns={"Sensor 3": "phi_rocker"}, units="deg")["Sensor 3"].rms
    0.0171
    """
    reading = table(data, columns, units, skip, time, shift, delimiter, decimal)
    compared, error, warned, notes = self._core.compare(reading, start, float(step))
    _warn(notes, skip)
    for text in [*([f"`{self.name}` {error}"] if error else []), *warned]:
        warnings.warn(text, MotionWarning, stacklevel=2)
    return {column: Difference(quantity, *numbers) for column, quantity, numbers in compared if numbers is not None}


def calibrate(
    self: Mechanism,
    data: Data,
    parameters: Sequence[str] | str,
    *,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    deviations: Mapping[str, float | str] | Sequence[str] | str | None = None,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | Sequence[str] | str | None = None,
    skip: Sequence[str] = (),
    time: str | None = None,
    shift: float = 0.0,
    delimiter: str | None = None,
    decimal: str | None = None,
    step: float = 0.01,
) -> Fit:
    """Fit parameters to measured values, by least squares with exact derivatives.

    The fit is that of ``linkwright calibrate``, which knows the digits of a table: values in whole millimeters are off by rounding.

    Parameters
    ----------
    data : path, str, bytes, mapping or DataFrame
        Measured positions and rates, as `compare` takes them. Accelerations and forces are left out with a warning.
    parameters : sequence of str
        Parameters to fit.
    bounds : mapping of str to pair of float, optional
        Bounds of parameters. Without them, a parameter stays in its range; without a range, a length keeps its sign.
    deviations : mapping of str to float or str, sequence of str or str, optional
        Standard deviation of one value, if it is known: by the name of a column, in SI units or as ``"0.1mm"``, or of all columns in a
        unit, ``["0.1mm", "0.05deg"]``.
    columns, units, skip, time, shift, delimiter, decimal
        As in `compare`.
    step : float, optional
        Longest step between visited times (s).

    Raises
    ------
    RuntimeError
        The motion cannot be solved with the initial values, or the fit does not converge.
    ValueError
        A name is unknown, the data are not a table, or there are too few values.
    OSError
        The file cannot be read.
    """
    names = [parameters] if isinstance(parameters, str) else list(parameters)
    for name in names:
        if name not in self.parameters:
            raise ValueError(unknown("parameter", name, tuple(self.parameters)))
    reading = table(data, columns, units, skip, time, shift, delimiter, decimal)
    limits = [(name, float(low), float(high)) for name, (low, high) in (bounds or {}).items()]
    along = self._changed(along=names)
    found = along._core.calibrate(reading, listed(deviations), limits, float(step))
    _warn(found["notes"], skip)
    return Fit(self, found)


def _warn(notes: Notes, skip: Sequence[str]) -> None:
    """Warn about the reading of a table, at the caller of the caller."""
    for name, why in notes["left_out"]:
        if name not in skip:
            warnings.warn(f"column `{name}` is left out: {why}", stacklevel=3)
    for name, quantity, doubt in notes["guesses"]:
        warnings.warn(f"column `{name}` is read as {quantity}: {doubt}", stacklevel=3)
