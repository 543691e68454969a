"""Compares the package with NumPy, SciPy and pylinkage, and writes `report.md`.

`python benches/costs.py PEERS` needs SciPy and pylinkage with numba beside the package; PEERS is `tests/src/lanes/peers.py`, which times hand-written
NumPy and pylinkage. All runs are on one core, one after another, in one run.
"""

from __future__ import annotations

import datetime
import platform
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import linkwright
import numpy as np

HERE = Path(__file__).parent
REPOSITORY = HERE.parents[2]
#: Instants and their distance (s), and numbers of mechanisms in a batch, as those of the peers.
INSTANTS, STEP, SETS = 200, 0.01, (32, 512)
RUNS = 7
#: Number of sets whose values do not fit into a cache.
LARGE = 5000
PLACES = (((0.0, 0.0), (0.0, 0.5)), ((1.0, 0.0), (1.1, 0.4)))
ANGLES = ["phi_coupler", "phi_rocker"]
LEVELS = [f"{name}{end}" for end in ("", "_d", "_dd") for name in ANGLES]


def fastest(poses: int, work: Callable[..., object], *arguments: object, **named: object) -> float:
    """Return the least time of a pose in a call of `work` (ns)."""
    times = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        work(*arguments, **named)
        times.append(time.perf_counter() - begun)
    return 1e9 * min(times) / poses


def chain(dyads: int) -> str:
    """Return the description of a chain of dyads, as that of the peers."""
    lines = ["mechanism dyads { param scale = 1;"]
    for k in range(dyads + 1):
        ground, tip = PLACES[k % 2]
        lines.append(f"point G{k} = {ground}, T{k} = {tip};")
    lines.append("body crank at G0 { G0, T0 }")
    for k in range(1, dyads + 1):
        lines.append(f"body coupler{k} at T{k - 1} {{ T{k - 1}, T{k} }}")
        lines.append(f"body rocker{k} at G{k} {{ G{k}, T{k} }}")
    lines.append("revolute G0(ground, crank);")
    for k in range(1, dyads + 1):
        before = "crank" if k == 1 else f"rocker{k - 1}"
        lines.append(f"revolute T{k - 1}({before}, coupler{k});")
        lines.append(f"revolute T{k}(coupler{k}, rocker{k});")
        lines.append(f"revolute G{k}(ground, rocker{k});")
    lines.append("drive phi(crank) = 0.3*scale*sin(t);")
    return "\n".join([*lines, "}"])


def batch(m: linkwright.Mechanism, name: str, value: float, outputs: list[str], sets: tuple[int, ...] = SETS) -> float:
    """Return the least time of a pose in batches of these numbers of sets (ns)."""
    t = STEP * np.arange(INSTANTS)
    times = []
    for count in sets:
        values = {name: np.full(count, value)}
        times.append(fastest(count * INSTANTS, m.solve, t, values, outputs=outputs, threads=1))
    return min(times)


def four_bar() -> linkwright.Mechanism:
    return linkwright.load(HERE.parent / "examples/four_bar.mech")


def fsolve() -> float:
    """Return the time of a pose by fsolve (ns): two angles, each from the last ones."""
    from scipy.optimize import fsolve

    a, b, c, d = 0.04, 0.12, 0.08, 0.1
    t = STEP * np.arange(INSTANTS)

    def equations(angles: np.ndarray, crank: float) -> list[float]:
        first, second = angles
        return [
            a * np.cos(crank) + b * np.cos(first) - d - c * np.cos(second),
            a * np.sin(crank) + b * np.sin(first) - c * np.sin(second),
        ]

    def solve() -> np.ndarray:
        angles = np.array([0.354, 1.0])
        for instant in t:
            angles = fsolve(equations, angles, args=(np.radians(40) + 3 * instant,))
        return angles

    last = four_bar().solve(t)
    np.testing.assert_allclose(solve(), [last.phi_coupler[-1], last.phi_rocker[-1]], atol=1e-7)
    return fastest(INSTANTS, solve)


def peers(script: Path, program: str, *sets: int) -> tuple[dict[tuple[str, str], float], dict[str, str]]:
    """Return the times of a peer by method and mechanism (ns), and versions and first calls."""
    printed = subprocess.run(
        [sys.executable, script, program, *map(str, sets)], capture_output=True, text=True, check=True
    ).stdout
    times, facts = {}, {}
    for line in printed.splitlines():
        kind, *rest = line.split()
        if kind == "time":
            times[rest[0], rest[1]] = float(rest[2])
        elif kind in ("version", "first"):
            facts[f"{kind} {rest[0]}"] = rest[1]
    return times, facts


def imports() -> tuple[float, float]:
    """Return the median times of importing NumPy alone, and NumPy and the package (ms)."""
    medians = []
    for names in ("numpy", "numpy, linkwright"):
        code = f"import time; begun = time.perf_counter(); import {names}; print(time.perf_counter() - begun)"
        runs = [
            float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
            for _ in range(9)
        ]
        medians.append(1e3 * float(np.median(runs)))
    return medians[0], medians[1]


def ended(m: linkwright.Mechanism) -> float:
    """Return the time of a batch of which one in a hundred ends early, as a multiple of that of a good one."""
    t = np.linspace(0, 2, INSTANTS)
    good = np.full(5000, 0.12)
    bad = good.copy()
    # These reach a dead point on the way.
    bad[::100] = 0.0595
    times = [
        fastest(rods.size * INSTANTS, m.solve, t, {"rod": rods}, outputs=ANGLES, threads=1) for rods in (good, bad)
    ]
    assert 0.005 < m.solve(t, {"rod": bad}, outputs=ANGLES).failed.mean() <= 0.01
    return times[1] / times[0]


def overhead(m: linkwright.Mechanism) -> float:
    """Return the part of a call that is not spent in the solver."""
    t = np.linspace(0, 2, INSTANTS)
    rods = np.full(500, 0.12)
    names = LEVELS
    whole = fastest(1, m.solve, t, {"rod": rods}, outputs=names, threads=1)
    table = np.column_stack([np.full(500, 0.04), rods])
    core = fastest(1, m._core.solve_sets, table, None, t, names, (1, None))
    return whole / core - 1


def main() -> None:
    script = Path(sys.argv[1]) if len(sys.argv) > 1 else REPOSITORY / "tests/src/lanes/peers.py"
    m = four_bar()
    all_levels, positions = batch(m, "rod", 0.12, LEVELS), batch(m, "rod", 0.12, ANGLES)
    numpy_times, _numpy_facts = peers(script, "numpy")
    rows = [
        (
            "four-bar, positions and rates",
            "NumPy, closed form by hand",
            numpy_times["closed", "four_bar"],
            all_levels,
            "> 1",
        )
    ]
    large, _ = peers(script, "numpy", LARGE)
    own = batch(m, "rod", 0.12, LEVELS, (LARGE,))
    rows.append((f"the same, {LARGE} sets", "NumPy, closed form by hand", large["closed", "four_bar"], own, "> 1"))
    linkage, facts = peers(script, "pylinkage")
    step = linkage["step_fast", "four_bar"]
    rows.append(("four-bar, with rates", "pylinkage `step_fast`, positions alone", step, all_levels, "≥ 4"))
    rows.append(("four-bar, positions", "pylinkage `step_fast`", step, positions, "≥ 1.5"))
    rows.append(("four-bar, two angles", "SciPy `fsolve` from the last angles", fsolve(), all_levels, "≥ 200"))
    for dyads in (1, 7, 17):
        c = linkwright.loads(chain(dyads))
        own = batch(c, "scale", 1.0, [f"T{dyads}"])
        rows.append(
            (
                f"{dyads} dyads, positions",
                "NumPy by products of matrices, as LInK",
                numpy_times["product", f"dyads_{dyads}"],
                own,
                "≥ 8",
            )
        )
    alone, both = imports()
    lines = ["| case | peer | ns a pose | ours | ratio | aim |", "|---|---|---:|---:|---:|---|"]
    lines += [
        f"| {case} | {peer} | {theirs:.1f} | {own:.1f} | {theirs / own:.1f} | {aim} |"
        for case, peer, theirs, own, aim in rows
    ]
    calls = [
        f"- import: NumPy {alone:.0f} ms, with the package {both:.0f} ms; aim: at most 50 more",
        f"- a batch of which 1 % of the sets end early takes {ended(m):.2f} times as long as a good one; aim: at most 1.2",
        f"- a batch of 100,000 poses takes {100 * overhead(m):.1f} % longer than its call of Rust; aim: below 5 %",
    ]
    print("\n".join([*lines, "", *calls]))
    commit = subprocess.run(
        ["git", "rev-parse", "--short=12", "HEAD"], cwd=HERE, capture_output=True, text=True, check=True
    ).stdout.strip()
    (HERE / "report.md").write_text(
        f"""# What the package costs

Written by `python codegen/python/benches/costs.py`.

- machine: {processor()}
- Python {platform.python_version()}, NumPy {np.__version__}, pylinkage {facts["version pylinkage"]}, numba {facts["version numba"]}
- commit: {commit}
- date: {datetime.date.today()}

All figures are of one run on one core; each is the fastest of {RUNS}. Batches have {SETS[0]} or {SETS[1]} sets of {INSTANTS} instants, of which the
faster counts, and prove the path of each set. They compute rates and accelerations also where only positions are requested. The first call of
pylinkage compiles: {float(facts["first four_bar"]) / 1e3:.1f} s with its import.

{chr(10).join(lines)}

{chr(10).join(calls)}
"""
    )


def processor() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


if __name__ == "__main__":
    main()
