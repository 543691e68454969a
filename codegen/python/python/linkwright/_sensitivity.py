"""Derivatives of a motion by parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright._columns import Array, unknown

if TYPE_CHECKING:
    from linkwright._motion import Motion


class Sensitivity:
    """Exact derivatives of positions and rates by parameters.

    ``sensitivity["phi_rocker", "rod"]`` is the derivative of the coordinate ``phi_rocker`` by the parameter ``rod``, one per instant;
    ``sensitivity["phi_rocker_d", "rod"]`` is that of its rate. They hold at a fixed time, in SI units.

    Attributes
    ----------
    motion : Motion
        Motion along which they are taken.
    parameters : tuple of str
        Parameters, in the order of the description.
    """

    def __init__(self, motion: Motion, parameters: tuple[str, ...]) -> None:
        self.motion = motion
        self.parameters = parameters

    def __getitem__(self, names: tuple[str, str]) -> Array:
        quantity, parameter = names
        if parameter not in self.parameters:
            raise KeyError(unknown("parameter", parameter, self.parameters))
        try:
            return self.motion[f"{quantity} per {parameter}"]
        except KeyError:
            known = self.motion.mechanism.coordinates
            raise KeyError(unknown("coordinate", quantity, known)) from None

    def _all(self, suffix: str) -> Array:
        coordinates = self.motion.mechanism.coordinates
        rows = [[self[name + suffix, parameter] for parameter in self.parameters] for name in coordinates]
        shape = (len(coordinates), len(self.parameters), len(self.motion.t))
        return np.moveaxis(np.array(rows, dtype=np.float64).reshape(shape), 2, 0)

    @property
    def positions(self) -> Array:
        """Derivatives of all coordinates by all parameters, (T, coordinates, parameters)."""
        return self._all("")

    @property
    def rates(self) -> Array:
        """Derivatives of all rates by all parameters, (T, coordinates, parameters)."""
        return self._all("_d")

    def __repr__(self) -> str:
        return f"<Sensitivity of {self.motion.mechanism.name} to {', '.join(self.parameters)}>"
