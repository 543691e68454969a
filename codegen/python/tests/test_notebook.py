"""The notebook runs, and its objects show themselves."""

from __future__ import annotations

import pytest
from conftest import REPOSITORY

FOLDER = REPOSITORY / "codegen/python/examples"


def test_the_notebook_runs() -> None:
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    notebook = nbformat.read(FOLDER / "tour.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": FOLDER}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pages = "".join(output["data"].get("text/html", "") for output in outputs if "data" in output)
    for shown in ("<svg", "<math", "<iframe srcdoc="):
        assert shown in pages, shown
    printed = "".join(output.get("text", "") for output in outputs)
    assert "the tool rises by up to 0." in printed
