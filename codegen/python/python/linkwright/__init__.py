"""Planar mechanisms: equations, motion and forces of `.mech` descriptions.

A description is read once, and solved as often as needed::

    import linkwright
    import numpy as np

    m = linkwright.load("four_bar.mech")
    motion = m.solve(np.linspace(0, 2, 201))
    motion.phi_rocker          # angle of the rocker (rad), one per instant
    motion.position["K"]       # path of the point K (m), T x 2

    batch = m.solve(np.linspace(0, 2, 201), {"rod": np.linspace(0.10, 0.14, 1000)})
    batch["K"].shape           # (1000, 201, 2)

All quantities are in SI units (m, s, kg, rad). A motion that ends early has NaN after its end, and `failed` tells why.

The numbers have the bits of the command ``linkwright solve``: both call one solver. Objects never change, can be pickled, and release the
interpreter while they solve.
"""

from __future__ import annotations

from linkwright._batch import Batch, Extremes
from linkwright._checked import Assembly, Check
from linkwright._equations import Equations
from linkwright._errors import (
    DescriptionError,
    DescriptionWarning,
    Finding,
    MotionWarning,
)
from linkwright._fit import Difference, Fit
from linkwright._mechanism import Mechanism, Quantity, load, loads
from linkwright._motion import Failure, Motion, Simulation
from linkwright._sensitivity import Sensitivity

__version__ = "0.1.0"

__all__ = [
    "Assembly",
    "Batch",
    "Check",
    "DescriptionError",
    "DescriptionWarning",
    "Difference",
    "Equations",
    "Extremes",
    "Failure",
    "Finding",
    "Fit",
    "Mechanism",
    "Motion",
    "MotionWarning",
    "Quantity",
    "Sensitivity",
    "Simulation",
    "load",
    "loads",
]
