"""Runs the examples of reports/python/README.md as they are written, in their order."""

import re
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[3]
README = SOURCES / "reports/python/README.md"


def blocks():
    return re.findall(r"^```python\n(.*?)^```", README.read_text(), re.DOTALL | re.MULTILINE)


def test_every_example_runs_as_pasted(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    names = {"__name__": "readme"}
    for block in blocks():
        if file := re.match(r"# (\w+\.py)\n", block):
            Path(file[1]).write_text(block)
        else:
            exec(compile(block, str(README), "exec"), names)
    printed = capsys.readouterr().out
    for line in (
        "collision 3 pairs\ntriangles 2 and 4 at [0.75  0.125 0.125]",
        "collision (0.8888888888888888, 0.888888888888889) [[2, 4], [2, 5], [2, 7]]\n0.84",
        "wrong_frame_size - positions have 7 rows, but the mesh has 8 vertices\n[ True] [0.5] [0.5]",
        "holds [(), ()]",
        "2 holds",
        "defect\n[('closed-degenerate', 4, ",
        "judged/report.html",
        "holds\nquick:1:closed-generic:5",
    ):
        assert line in printed
        printed = printed[printed.index(line) + len(line) :]
    assert Path("step.vtu").exists() and Path("steps.log").exists()


def test_the_detector_of_the_readme_is_as_long_as_it_says():
    source = next(block for block in blocks() if block.startswith("# textbook.py"))
    kind = source[source.index("class TextbookCubic") :]
    assert len([line for line in kind.splitlines() if line]) <= 30
