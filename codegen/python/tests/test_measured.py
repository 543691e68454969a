"""Measured values are read, compared and fitted as the command does it."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import Any

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR, REPOSITORY, TURNED, command

#: Column of the table of the guide that does not name its quantity.
COLUMNS = {"Winkel 3": "phi_rocker"}

#: SI units per unit of a column.
SCALES = {"mm": 1e-3, "deg": np.pi / 180}


@pytest.fixture
def m() -> linkwright.Mechanism:
    return linkwright.loads(FOUR_BAR)


@pytest.fixture
def lift(tmp_path: Path) -> Path:
    """Folder with the description and the table of the guide."""
    page = (REPOSITORY / "codegen/guide/measured.md").read_text()
    for name in ("lift.mech", "log.csv"):
        block = re.search(rf"`measured/{re.escape(name)}`:\n\n```\w+\n(.*?)```", page, re.DOTALL)
        assert block is not None
        (tmp_path / name).write_text(block[1])
    return tmp_path


def same_differences(differences: Any, report: dict[str, Any]) -> None:
    columns = {it["column"]: it for it in report["columns"]}
    assert list(differences) == list(columns)
    for name, difference in differences.items():
        column = columns[name]
        scale = SCALES.get(column["unit"], 1.0)
        assert (difference.quantity, difference.count, difference.time) == tuple(
            column[it] for it in ("quantity", "count", "t")
        )
        for value, expected in ((difference.rms, column["rms"]), (difference.largest, column["largest"])):
            # In SI units both are the same number; otherwise the unit is converted once.
            assert value == expected if scale == 1.0 else abs(value - expected * scale) <= 1e-15 * abs(value)


@pytest.mark.filterwarnings("ignore:.*`c8` is the first:UserWarning")
def test_an_export_is_compared_as_the_command_does() -> None:
    path, table = REPOSITORY / "mechanisms/arm.mech", REPOSITORY / "tests/data/arm_adams.csv"
    report = json.loads(command("compare", path, table, "--json"))
    m = linkwright.load(path)
    differences = m.compare(table)
    assert differences["c10_phid"].quantity == "phi_c10_d" and len(differences) == 16
    same_differences(differences, report)
    assert m.compare(str(table)) == differences
    assert m.compare(table.read_bytes()) == differences
    assert m.compare(table.read_text()) == differences


def test_units_dialect_and_names_are_those_of_the_command(lift: Path) -> None:
    m = linkwright.load(lift / "lift.mech")
    option = "Winkel 3=phi_rocker"
    report = json.loads(command("compare", "lift.mech", "log.csv", "--column", option, "--json", folder=lift))
    differences = m.compare(lift / "log.csv", columns=COLUMNS)
    same_differences(differences, report)
    skipped = m.compare(lift / "log.csv", columns=COLUMNS, skip=["P_x"], delimiter=";", decimal=",", time="Zeit")
    assert skipped == {name: it for name, it in differences.items() if name != "P_x"}
    shifted = m.compare(lift / "log.csv", columns=COLUMNS, shift=0.1, start=0.0)
    assert shifted["P_x"].rms > 10 * differences["P_x"].rms


def test_frames_and_mappings_are_tables(lift: Path) -> None:
    pandas = pytest.importorskip("pandas")
    polars = pytest.importorskip("polars")
    m = linkwright.load(lift / "lift.mech")
    expected = m.compare(lift / "log.csv", columns=COLUMNS)
    text = (lift / "log.csv").read_text()
    frame = pandas.read_csv(io.StringIO(text), sep=";", decimal=",")
    assert m.compare(frame, columns=COLUMNS) == expected
    assert m.compare(polars.from_pandas(frame), columns=COLUMNS) == expected
    assert m.compare({name: frame[name].to_numpy() for name in frame}, columns=COLUMNS) == expected
    # Without units in the names.
    plain = frame.rename(columns=lambda name: name.split(" (")[0])
    units = {"P_x": "mm", "P_y": "mm", "Winkel 3": "deg"}
    assert m.compare(plain, columns=COLUMNS, units=units) == expected
    assert m.compare(plain, columns=COLUMNS, units=["mm", "deg"]) == expected
    # The index of a motion has the times.
    assert m.compare(m.solve([0.0, 0.5, 1.0]).to_pandas())["P_x"].rms == 0.0


def test_a_fit_is_that_of_the_command(lift: Path) -> None:
    m = linkwright.load(lift / "lift.mech")
    arguments = [
        "calibrate",
        "lift.mech",
        "log.csv",
        "--column",
        "Winkel 3=phi_rocker",
        "--param",
        "G,L2,L3,L4",
        "--json",
    ]
    names = ["G", "L2", "L3", "L4"]
    for options, given in (([], None), (["--deviation", "0.1mm,0.05deg"], ["0.1mm", "0.05deg"])):
        report = json.loads(command(*arguments, *options, folder=lift))
        fit = m.calibrate(lift / "log.csv", names, columns=COLUMNS, deviations=given)
        parameters = report["parameters"]
        assert fit.values == {it["name"]: it["value"] for it in parameters}
        assert fit.deviations == {it["name"]: it["deviation"] for it in parameters}
        assert fit.intervals == {it["name"]: it["interval"] for it in parameters}
        assert fit.correlations.tolist() == report["correlations"]
        assert (fit.is_trusted, fit.freedom) == (report["trusted"], report["freedom"])
        for column in report["columns"]:
            rms = np.sqrt(np.mean(fit.residuals[column["column"]] ** 2))
            assert rms == pytest.approx(column["rms_after"] * SCALES[column["unit"]], rel=1e-13)


def test_steps_of_rounding_widen_deviations(m: linkwright.Mechanism) -> None:
    t = np.linspace(0, 2, 41)
    exact = m(rod=0.1234).solve(t).P_x
    rounded = m.calibrate({"t": t, "P_x (mm)": np.round(1e3 * exact, 0)}, "rod", deviations=["0.001mm"])
    fine = m.calibrate({"t": t, "P_x (mm)": 1e3 * exact}, "rod", deviations=["0.001mm"])
    assert rounded.deviations["rod"] > 10 * fine.deviations["rod"]


def test_a_column_drives_an_input(tmp_path: Path) -> None:
    t = np.linspace(0, 1, 21)
    angle = 0.2 * np.sin(3 * t)
    rows = [f"{t},{np.degrees(angle)},{40 * np.sin(angle) + 0.1}" for t, angle in zip(t, angle, strict=True)]
    table = "\n".join(["t,angle (deg),A_y (mm)", *rows, ""])
    (tmp_path / "turned.mech").write_text(TURNED)
    (tmp_path / "log.csv").write_text(table)
    m = linkwright.loads(TURNED)
    report = json.loads(command("compare", "turned.mech", "log.csv", "--json", folder=tmp_path))
    differences = m.compare(table)
    same_differences(differences, report)
    assert differences["A_y"].largest == pytest.approx(1e-4, rel=1e-9)
    driven = m.compare(table.replace("angle", "sensor"), columns={"sensor": "angle"})
    assert driven == differences
    with pytest.raises(ValueError, match=r"no value in its first or last row(.|\n)*`skip`"):
        m.compare(table.replace("angle (deg),A_y (mm)\n0.0,0.0,", "angle (deg),A_y (mm)\n0.0,,"))
    fit = m.calibrate(table, "length", skip=[])
    assert fit.values["length"] == pytest.approx(0.04, rel=0.1) and set(fit.residuals) == {"A_y"}


def test_measured_values_are_compared_and_fitted(m: linkwright.Mechanism) -> None:
    t = np.linspace(0, 2, 41)
    measured = m(rod=0.1234).solve(t)
    data = {"t": t, "P_x": measured.P_x, "P_y": measured.P_y, "phi_rocker": measured.phi_rocker}
    differences = m.compare(data)
    assert differences["P_x"].rms > 1e-4 and differences["P_x"].count == 41
    assert m(rod=0.1234).compare(data)["phi_rocker"].rms < 1e-14
    fit = m.calibrate(data, ["rod"])
    assert abs(fit.values["rod"] - 0.1234) < 1e-12
    assert fit.mechanism.parameters["rod"].value == fit.values["rod"]
    data["P_x"] = np.where(t > 1, np.nan, data["P_x"])
    assert abs(m.calibrate(data, "rod").values["rod"] - 0.1234) < 1e-12


def test_what_is_left_out_is_told(m: linkwright.Mechanism) -> None:
    t = np.linspace(0, 2, 41)
    motion = m(rod=0.1234).solve(t)
    data = {"t": t, "P_x": motion.P_x}
    with pytest.warns(UserWarning, match="`voltage` is left out: no quantity"):
        m.compare({**data, "voltage": t})
    with pytest.warns(UserWarning, match="`P_ax` is left out: accelerations"):
        fit = m.calibrate({**data, "P_ax": motion.P_ax}, "rod")
    assert set(fit.residuals) == {"P_x"}
    with pytest.warns(linkwright.MotionWarning, match="out of reach"):
        differences = m(crank_length=0.05, rod=0.14).compare(data)
    assert differences["P_x"].count < 41


def test_messages_name_the_arguments(m: linkwright.Mechanism, tmp_path: Path) -> None:
    t = np.linspace(0, 2, 41)
    data = {"t": t, "P_x": t}
    with pytest.raises(ValueError, match="no parameter is named 'rodd'"):
        m.calibrate(data, ["rodd"])
    with pytest.raises(ValueError, match=r"no column of `data` is called `t` or `time`(.|\n)*with `time`"):
        m.compare({"P_x": t, "P_y": t})
    with pytest.raises(ValueError, match=r"matches a quantity(.|\n)*`columns="):
        m.compare({"t": t, "voltage": t})
    with pytest.raises(ValueError, match="matches none"):
        m.calibrate(data, "rod", deviations={"Q_x": 1e-3})
    with pytest.raises(ValueError, match="`x` is not a unit"):
        m.compare(data, units={"P_x": "x"})
    with pytest.raises(ValueError, match="different numbers of values: t: 41, P_x: 3"):
        m.compare({"t": t, "P_x": [1, 2, 3]})
    with pytest.raises(ValueError, match="decimal mark"):
        m.compare("t,P_x\n0,1\n", decimal="x")
    with pytest.raises(OSError, match="cannot read"):
        m.compare(tmp_path / "missing.csv")
