"""A study of a million four-bars on a cluster of Dask; what a lost worker had is solved again, with the same bits."""

from pathlib import Path

import linkwright
import numpy as np
from dask.distributed import Client, LocalCluster

LINKAGE = linkwright.load(Path(__file__).with_name("four_bar.mech"))
TIMES = np.linspace(0.0, 0.5, 5)


def swing(mechanism: linkwright.Mechanism, rods: np.ndarray) -> np.ndarray:
    """Return the largest minus the smallest angle of the rocker (rad) for each length of the rod (m)."""
    angles = mechanism.solve(TIMES, {"rod": rods}, outputs=["phi_rocker"], threads=1)["phi_rocker"]
    return angles.max(axis=1) - angles.min(axis=1)


def study(client: Client, rods: np.ndarray, pieces: int = 40) -> np.ndarray:
    parts = client.map(swing, [LINKAGE] * pieces, np.array_split(rods, pieces))
    return np.concatenate(client.gather(parts))


if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1) as cluster, Client(cluster) as client:
        swings = study(client, np.linspace(0.10, 0.14, 1_000_000))
    print(f"{len(swings)} linkages swing {np.degrees(swings.min()):.3f} to {np.degrees(swings.max()):.3f} deg")
