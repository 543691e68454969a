"""Studies in several processes, and what survives the loss of one."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import linkwright
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))


def test_joblib_has_the_bits_of_one_process() -> None:
    pytest.importorskip("joblib")
    import study_with_joblib

    rods = np.linspace(0.10, 0.14, 4000)
    whole = study_with_joblib.swing(study_with_joblib.LINKAGE, rods)
    np.testing.assert_array_equal(study_with_joblib.study(rods), whole)


def test_threads_are_those_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    from linkwright._batch import thread_count

    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    assert thread_count(None) == 3
    monkeypatch.setenv("LINKWRIGHT_NUM_THREADS", "2")
    assert thread_count(None) == 2
    assert thread_count(5) == 5


def killed_once(mechanism: linkwright.Mechanism, rods: np.ndarray, place: int, folder: str) -> np.ndarray:
    """Solve a piece; the first process that gets the third piece is killed."""
    import study_with_dask

    marker = Path(folder) / "killed"
    if place == 3 and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return study_with_dask.swing(mechanism, rods)


def test_dask_solves_the_pieces_of_a_killed_worker_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("dask.distributed")
    import study_with_dask

    # Workers are processes of their own, also those that replace others.
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(EXAMPLES), str(Path(__file__).parent)]))
    m, rods = study_with_dask.LINKAGE, np.linspace(0.10, 0.14, 1_000_000)
    pieces = np.array_split(rods, 20)
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50)
    with cluster, distributed.Client(cluster) as client:
        parts = client.map(killed_once, [m] * 20, pieces, list(range(20)), [str(tmp_path)] * 20, pure=False)
        swings = np.concatenate(client.gather(parts))
    assert (tmp_path / "killed").exists()
    np.testing.assert_array_equal(swings, study_with_dask.swing(m, rods))


def test_gradients_in_jax() -> None:
    pytest.importorskip("jax")
    import gradients_in_jax as example

    length = example.fitted()
    angles = example.LINKAGE(crank_length=length).solve(example.TIMES).phi_rocker
    assert abs(angles.max() - angles.min() - np.pi / 3) < 1e-12


def test_gradients_in_torch() -> None:
    torch = pytest.importorskip("torch")
    import gradients_in_torch as example

    length = torch.tensor(0.03, dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(example.Rocker.apply, (length,))
