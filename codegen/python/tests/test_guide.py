"""The chapter of the guide runs, and prints what it says.

After an intended change, `GUIDE_UPDATE=1 pytest tests/test_guide.py` writes what the blocks print.
"""

from __future__ import annotations

import contextlib
import io
import os
import re

import pytest
from conftest import REPOSITORY

PAGE = REPOSITORY / "codegen/guide/python.md"
BLOCKS = re.compile(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", re.DOTALL)


@pytest.mark.filterwarnings("ignore::linkwright.MotionWarning")
def test_the_blocks_print_what_the_page_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(REPOSITORY)
    page = PAGE.read_text()
    names: dict[str, object] = {}

    def run(block: re.Match[str]) -> str:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block[1], str(PAGE), "exec"), names)  # noqa: S102
        text = f"```python\n{block[1]}```"
        return text if block[2] is None else f"{text}\n\n```text\n{printed.getvalue()}```"

    updated = BLOCKS.sub(run, page)
    if os.environ.get("GUIDE_UPDATE"):
        PAGE.write_text(updated)
    assert updated == page or os.environ.get("GUIDE_UPDATE")
    assert len(BLOCKS.findall(page)) >= 8
