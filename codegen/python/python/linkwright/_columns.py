"""Values of named quantities at instants."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Endings of the components of a point, by order of differentiation.
COMPONENTS = (("_x", "_y"), ("_vx", "_vy"), ("_ax", "_ay"))


def unknown(kind: str, name: str, names: Mapping[str, object] | tuple[str, ...]) -> str:
    """Return the message about a name that does not exist."""
    near = get_close_matches(name, list(names), n=1)
    if near:
        return f"no {kind} is named {name!r}; did you mean {near[0]!r}?"
    return f"no {kind} is named {name!r}; there are: {', '.join(names) or 'none'}"


class Points(Mapping[str, Array]):
    """Positions, velocities or accelerations of points by name, each with x and y in the last dimension."""

    def __init__(self, columns: Columns, level: int) -> None:
        self._columns = columns
        self._level = level

    def __getitem__(self, name: str) -> Array:
        x, y = (name + it for it in COMPONENTS[self._level])
        places = self._columns._places
        if x not in places or y not in places:
            raise KeyError(unknown("point", name, tuple(self)))
        first, second = places[x], places[y]
        values = self._columns.values
        if second == first + 1:
            return values[..., first : second + 1]
        return values[..., [first, second]]

    def __iter__(self) -> Iterator[str]:
        x, y = COMPONENTS[self._level]
        places = self._columns._places
        for name in places:
            stem = name.removesuffix(x)
            if stem != name and stem + y in places:
                yield stem

    def __len__(self) -> int:
        return sum(1 for _ in self)


class Columns:
    """Named quantities; the last dimension of `values` is that of the quantities."""

    #: Values in SI units, (…, T, number of quantities).
    values: Array
    #: Instants (s).
    t: Array
    _places: dict[str, int]
    _units: dict[str, str]

    def __init__(self, t: Array, values: Array, units: dict[str, str]) -> None:
        self.t = t
        self.values = values
        self._units = units
        self._places = {name: place for place, name in enumerate(units)}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the quantities."""
        return tuple(self._places)

    @property
    def units(self) -> Mapping[str, str]:
        """SI unit of each quantity; empty for a pure number."""
        return MappingProxyType(self._units)

    @property
    def position(self) -> Points:
        """Positions (m) by the name of a point, (…, T, 2)."""
        return Points(self, 0)

    @property
    def velocity(self) -> Points:
        """Velocities (m/s) by the name of a point, (…, T, 2)."""
        return Points(self, 1)

    @property
    def acceleration(self) -> Points:
        """Accelerations (m/s²) by the name of a point, (…, T, 2)."""
        return Points(self, 2)

    def __getitem__(self, name: str) -> Array:
        """Return the values of a quantity, (…, T), or the positions of a point, (…, T, 2)."""
        place = self._places.get(name)
        if place is not None:
            return self.values[..., place]
        if name in self.position:
            return self.position[name]
        raise KeyError(unknown("quantity", name, self.names))

    def __contains__(self, name: object) -> bool:
        return name in self._places or name in self.position

    def __getattr__(self, name: str) -> Array:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(it for it in self._places if it.isidentifier())]

    def _records(self, lead: list[tuple[str, Array]]) -> NDArray[np.void]:
        """Return leading columns and all quantities as one structured array, row by row."""
        names = [name for name, _ in lead] + list(self._places)
        rows = self.values.reshape(-1, len(self._places))
        records = np.empty(len(rows), dtype=[(name, np.float64) for name in names])
        for name, values in lead:
            records[name] = values
        for name, place in self._places.items():
            records[name] = rows[:, place]
        return records
