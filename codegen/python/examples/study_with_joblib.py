"""A study of many four-bars in two processes of joblib; each process solves its pieces on one thread."""

from pathlib import Path

import linkwright
import numpy as np
from joblib import Parallel, delayed

LINKAGE = linkwright.load(Path(__file__).with_name("four_bar.mech"))
TIMES = np.linspace(0.0, 2.0, 20)


def swing(mechanism: linkwright.Mechanism, rods: np.ndarray) -> np.ndarray:
    """Return the largest minus the smallest angle of the rocker (rad) for each length of the rod (m)."""
    angles = mechanism.solve(TIMES, {"rod": rods}, outputs=["phi_rocker"], threads=1)["phi_rocker"]
    return angles.max(axis=1) - angles.min(axis=1)


def study(rods: np.ndarray, pieces: int = 4, processes: int = 2) -> np.ndarray:
    work = (delayed(swing)(LINKAGE, piece) for piece in np.array_split(rods, pieces))
    return np.concatenate(Parallel(n_jobs=processes)(work))


if __name__ == "__main__":
    swings = study(np.linspace(0.10, 0.14, 10_000))
    print(f"{len(swings)} linkages swing {np.degrees(swings.min()):.3f} to {np.degrees(swings.max()):.3f} deg")
