"""Objects as a user of notebooks meets them."""

from __future__ import annotations

import pickle
import warnings
from pathlib import Path

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR, PENDULUM, TURNED, command


@pytest.fixture()
def m() -> linkwright.Mechanism:
    return linkwright.loads(FOUR_BAR)


def test_a_mechanism_names_its_parts(m: linkwright.Mechanism) -> None:
    assert m.name == "four_bar"
    assert list(m.parameters) == ["crank_length", "rod"]
    rod = m.parameters["rod"]
    assert (rod.value, rod.unit, rod.low, rod.high) == (0.12, "m", 0.08, 0.16)
    assert rod.docs == "Length of the coupler."
    assert m.points == ("A", "D", "B", "C", "P")
    assert m.coordinates[2] == "phi_crank"
    assert m.quantities["P_vx"] == "m/s"
    assert not m.measures
    assert "rod = 0.12" in repr(m)


def test_quantities_are_attributes_and_items(m: linkwright.Mechanism) -> None:
    motion = m.solve([0.0, 0.1, 0.2])
    np.testing.assert_array_equal(motion.phi_rocker, motion["phi_rocker"])
    assert motion["P"].shape == motion.position["P"].shape == (3, 2)
    np.testing.assert_array_equal(motion.velocity["P"][:, 1], motion.P_vy)
    np.testing.assert_array_equal(motion.acceleration["P"][:, 0], motion["P_ax"])
    np.testing.assert_allclose(motion.phi_crank, np.deg2rad(40) + 3 * motion.t, rtol=1e-15)
    assert "phi_rocker" in dir(motion)
    assert motion.units["phi_rocker_d"] == "rad/s"
    assert len(motion) == 3
    assert motion.failed is None
    assert motion.solved.all()
    with pytest.raises(AttributeError, match="did you mean 'phi_rocker'"):
        _ = motion.phi_roker
    with pytest.raises(KeyError, match="no point is named 'Q'"):
        _ = motion.position["Q"]


def test_times_are_in_any_order(m: linkwright.Mechanism) -> None:
    t = np.array([0.2, -0.1, 0.0, 0.2, 0.1])
    motion = m.solve(t)
    np.testing.assert_array_equal(motion.t, t)
    ordered = m.solve(np.sort(t))
    for place, instant in enumerate(t):
        where = np.flatnonzero(np.sort(t) == instant)[0]
        np.testing.assert_array_equal(motion.values[place], ordered.values[where])
    batch = m.solve(t, {})
    np.testing.assert_allclose(batch.values[0], motion.values, rtol=0, atol=1e-12)
    assert batch.solved[0] == 4


def test_a_changed_mechanism_is_another_one(m: linkwright.Mechanism) -> None:
    longer = m(rod="130mm")
    assert (longer.parameters["rod"].value, m.parameters["rod"].value) == (0.13, 0.12)
    assert m(rod=0.13).parameters["rod"].value == 0.13
    with pytest.raises(TypeError, match="did you mean 'rod'"):
        m(rodd=1.0)
    with pytest.raises(ValueError, match="length"):
        m(rod="3kg")
    with pytest.raises(ValueError, match="one value"):
        m(rod="1; drive x")


def test_tables_of_other_packages(m: linkwright.Mechanism) -> None:
    motion = m.solve([0.0, 0.1])
    records = motion.to_structured()
    np.testing.assert_array_equal(records["P_x"], motion.P_x)
    assert records.dtype.names is not None and records.dtype.names[0] == "t"
    pandas = pytest.importorskip("pandas")
    frame = motion.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.index) == [0.0, 0.1]
    np.testing.assert_array_equal(frame["phi_rocker"], motion.phi_rocker)
    polars = pytest.importorskip("polars")
    assert isinstance(motion.to_polars(), polars.DataFrame)
    batch = m.solve([0.0, 0.1], {"rod": [0.11, 0.12, 0.13]}, outputs=["P"])
    assert batch.to_pandas().shape == (6, 2)
    assert len(batch.to_structured()) == 6


def test_everything_can_be_pickled(m: linkwright.Mechanism) -> None:
    changed = pickle.loads(pickle.dumps(m(rod=0.13)))
    assert changed.parameters["rod"].value == 0.13
    motion = m(rod=0.13).solve([0.0, 0.1])
    again = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(again.values, motion.values)
    np.testing.assert_array_equal(again.phi_rocker, motion.phi_rocker)
    np.testing.assert_array_equal(again.mechanism.solve([0.0, 0.1]).values, motion.values)
    batch = pickle.loads(pickle.dumps(m.solve([0.0], {"rod": [0.11, 0.12]})))
    assert len(batch) == 2


def test_an_early_end_is_named_and_leaves_nan(m: linkwright.Mechanism) -> None:
    with pytest.warns(linkwright.MotionWarning, match="beyond t"):
        motion = m(rod=0.0801, crank_length=0.0999).solve(np.linspace(0, 2, 201))
    failed = motion.failed
    assert failed is not None and failed.kind in ("out_of_reach", "singular")
    assert 0.0 < failed.time < 2.0 and failed.block is not None
    after = motion.t > failed.time
    assert np.isnan(motion.values[after]).all() and not motion.solved[after].any()
    with pytest.raises(ValueError, match="outside of the range of `rod`"):
        m(rod=0.2)


def test_other_assemblies(m: linkwright.Mechanism) -> None:
    drawn, other = m.assemblies()
    assert drawn.drawn and not other.drawn
    mirrored = m.in_assembly(other)
    np.testing.assert_allclose(mirrored.solve([0.0]).values[0, :9], other.pose, atol=1e-14)
    batch = mirrored.solve([0.0, 0.1], {"rod": [0.12]})
    np.testing.assert_array_equal(batch["phi_rocker"][0], mirrored.solve([0.0, 0.1]).phi_rocker)
    assert m.in_assembly(drawn.label).solve([0.0]).phi_rocker == m.solve([0.0]).phi_rocker
    with pytest.raises(ValueError, match="no assembly"):
        m.in_assembly("+++").solve([0.0])


def test_inputs_are_laws_or_signals() -> None:
    turned = linkwright.loads(TURNED)
    assert turned.inputs["angle"].value == 0.3
    t = np.linspace(0.0, 1.0, 11)
    law = turned(angle="0.2*sin(3*t)").solve(t)
    signal = (0.2 * np.sin(3 * t), 0.6 * np.cos(3 * t), -1.8 * np.sin(3 * t))
    rows = tuple(it[np.newaxis, :] for it in signal)
    batch = turned.solve(t, inputs={"angle": rows})
    for name in ("phi_arm", "phi_arm_d", "phi_arm_dd", "A_ax"):
        np.testing.assert_allclose(batch[name][0], law[name], atol=1e-15)
    text = turned.solve(t, {"length": [0.04, 0.05]}, inputs={"angle": "0.2*sin(3*t)"})
    np.testing.assert_array_equal(text["phi_arm"][1], law.phi_arm)
    fixed = turned.solve(t, inputs={"angle": (np.array([0.1, 0.2, 0.3]), 2.0)})
    assert fixed["phi_arm"].shape == (3, 11)
    np.testing.assert_array_equal(fixed["phi_arm"][:, 0], [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(fixed["phi_arm_d"], 2.0)


def test_a_pendulum_keeps_its_energy_and_its_period() -> None:
    pendulum = linkwright.loads(PENDULUM)
    t = np.linspace(0, 3, 301)
    motion = pendulum.simulate(t)
    energy = motion.kinetic_energy + motion.potential_energy
    np.testing.assert_allclose(energy, energy[0], rtol=0, atol=1e-8)
    assert motion.simulation is not None and motion.simulation.steps > 0
    # Period by the arithmetic-geometric mean: 2π sqrt(l/g) / agm(1, cos(5°)).
    a, b = 1.0, np.cos(np.deg2rad(5))
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)
    period = 2 * np.pi * np.sqrt(1 / 9.81) / a
    swung = pendulum.simulate([0.0, period])
    np.testing.assert_allclose(swung.phi_bob[1], np.deg2rad(-80), atol=1e-8)
    with pytest.raises(ValueError, match="before the start"):
        pendulum.simulate([-1.0])
    with pytest.raises(ValueError, match="no coordinate"):
        linkwright.loads(FOUR_BAR).simulate([0.0])


def test_check_and_its_text(m: linkwright.Mechanism, tmp_path: Path) -> None:
    check = m.check(end=2.0)
    assert len(check["assemblies"]) == 2 and check.error is None
    assert "RRR dyad" in str(check)
    path = tmp_path / "four_bar.mech"
    path.write_text(FOUR_BAR)
    import json

    assert json.loads(command("check", path, "--to", "2", "--json")) == check.results
    assert m.check(end=2.0, prove=True).proven


def test_sensitivities_are_exact(m: linkwright.Mechanism) -> None:
    t = np.linspace(0.1, 1, 5)
    sensitivity = m.sensitivity(t, ["rod"])
    step = 1e-6
    ahead, behind = (m(rod=0.12 + it).solve(t) for it in (step, -step))
    for name in ("phi_rocker", "phi_rocker_d", "x_coupler"):
        quotient = (ahead[name] - behind[name]) / (2 * step)
        np.testing.assert_allclose(sensitivity[name, "rod"], quotient, rtol=1e-6, atol=1e-6)
    assert sensitivity.positions.shape == (5, 9, 1)
    both = m.sensitivity(t)
    assert both.parameters == ("crank_length", "rod") and both.rates.shape == (5, 9, 2)
    np.testing.assert_allclose(both.positions[..., 1], sensitivity.positions[..., 0], rtol=1e-12)
    with pytest.raises(KeyError, match="no parameter"):
        _ = sensitivity["phi_rocker", "crank_length"]


def test_efforts_of_a_weight() -> None:
    text = TURNED.replace("drive", "gravity = (0, -9.81);\nmass arm = 2kg at A;\ndrive lift:")
    weighed = linkwright.loads(text)
    effort = weighed.effort([0.0])
    # The torque that carries 2 kg on an arm of 40 mm at 0.3 rad.
    np.testing.assert_allclose(effort["effort_lift"], 2 * 9.81 * 0.04 * np.cos(0.3), rtol=1e-12)


def test_pages_and_pictures(m: linkwright.Mechanism) -> None:
    assert m._repr_html_().startswith("<svg")
    motion = m.solve(np.linspace(0, 1, 11))
    assert "<iframe srcdoc=" in motion._repr_html_()
    assert "<math" in m.equations._repr_html_()
    assert m.equations.latex.count("\\") > 10
    assert "RRR dyad" in m.equations.derivation()
    with pytest.raises(ValueError, match="no form"):
        m.equations.derivation("pdf")


def test_generated_code_is_that_of_the_command(m: linkwright.Mechanism, tmp_path: Path) -> None:
    path = tmp_path / "four_bar.mech"
    path.write_text(FOUR_BAR)
    command("generate", path, "-o", tmp_path / "four_bar.rs")
    assert linkwright.load(path).rust() == (tmp_path / "four_bar.rs").read_text()
    assert set(m.c()) == {"four_bar.c", "four_bar.h", "linkwright.c", "linkwright.h"}


def test_warnings_of_a_description() -> None:
    text = FOUR_BAR.replace("param crank_length = 40mm;", "param crank_length = 40mm; param spare = 1;")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        m = linkwright.loads(text)
    assert [it.category for it in caught] == [linkwright.DescriptionWarning]
    assert "spare" in str(caught[0].message) and len(m.findings) == 1
