"""Where motors slide, people read of forces: on the terminal, in the files, in Python."""

import html
import json
import re

import numpy as np
import pytest

import ursula
from conftest import ROOT

# Not in names of checks, options, columns and files.
TORQUE = re.compile(r"(?<![-./_\w])torques?(?![._]\w|[\w=])", re.IGNORECASE)
NOUNS = {"UPS": "force", "PUS": "force", "RUS": "torque"}


def said_by_page(path):
    text = path.read_text()
    data = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)[1]
    seen = re.sub(r"<(script|style)\b.*?</\1>", "", text, flags=re.DOTALL)
    labels = [each for plot in json.loads(data)["plots"] for each in
              (plot["title"], plot["xLabel"], plot["yLabel"], plot["description"], *(line["label"] for line in plot["lines"]))]
    return html.unescape(re.sub(r"<[^>]*>", " ", seen)) + "\n".join(labels)


def wrong_file(program, folder, kind, factor):
    assert program("init", "my.toml", "--kind", kind).returncode == 0
    s = ursula.read_scenario(folder / "my.toml")
    t = np.linspace(0, s.duration, 61)
    tau = factor * s.inverse_dynamics(s.motion(t))
    unit = "Nm" if kind == "RUS" else "N"
    rows = [",".join(["t_s"] + [f"tau_{k}_{unit}" for k in range(1, 7)])]
    rows += [",".join(map(repr, map(float, row))) for row in np.column_stack([t, tau])]
    (folder / "mine.csv").write_text("\n".join(rows) + "\n")
    return s, t, tau


@pytest.mark.parametrize("kind, factor, more", [
    *((kind, *judged) for kind in ("UPS", "RUS") for judged in ((1.001, []), (1.001, ["--rtol", "0.01"]), (1, []))),
    ("PUS", 1.001, [])])
def test_a_file(kind, factor, more, program, tmp_path):
    wrong_file(program, tmp_path, kind, factor)
    run = program("validate", "my.toml", "--torques", "mine.csv", "--out", "out", *more)
    assert run.returncode in (0, 1), run.stderr
    found = {"terminal": run.stdout, "page": said_by_page(tmp_path / "out" / "report.html"),
             "summary": (tmp_path / "out" / "summary.json").read_text()}
    for where, text in found.items():
        words = TORQUE.findall(text)
        assert bool(words) == (NOUNS[kind] == "torque"), (where, [text[m.start() - 60:m.end() + 20] for m in TORQUE.finditer(text)][:5])
    assert NOUNS[kind] in found["terminal"] and NOUNS[kind] in found["page"]
    if factor != 1 and not more:
        assert f"% of the largest {NOUNS[kind]}" in found["summary"] and f"every {NOUNS[kind]} scaled by" in found["terminal"]


def test_a_solver_and_refusals(program, tmp_path):
    s, t, tau = wrong_file(program, tmp_path, "UPS", 1)
    r = ursula.validate(s, solver=lambda m: np.ones(6) * s.inverse_dynamics(m) * 1.01, time_limit=60)
    said = " ".join([r.reason, *(c.why + c.basis for c in r.checks), *(f.name + f.text for f in r.findings)])
    assert r.verdict == "fail" and "force" in said and not TORQUE.findall(said)
    with pytest.raises(ValueError, match="forces of zero"):
        ursula.validate(s, torques=tau, t=t, rtol=2.0)


def test_motors_of_both_kinds_have_efforts():
    s = ursula.read_scenario(ROOT / "scenarios" / "mixture.toml")
    t = np.linspace(0, s.duration, 31)
    r = ursula.validate(s, torques=1.01 * s.inverse_dynamics(s.motion(t)), t=t)
    said = " ".join([r.reason, *(c.why for c in r.checks), *(f.name for f in r.findings)])
    assert r.verdict == "fail" and "effort" in said and not TORQUE.findall(said)


def test_which_motors_are_off_is_a_table(program, tmp_path):
    _, t, tau = wrong_file(program, tmp_path, "UPS", 1)
    rows = (tmp_path / "mine.csv").read_text().splitlines()
    for k in range(1, len(rows)):
        cells = rows[k].split(",")
        cells[3] = repr(1.01 * float(cells[3]))
        rows[k] = ",".join(cells)
    (tmp_path / "mine.csv").write_text("\n".join(rows) + "\n")
    assert program("validate", "my.toml", "--torques", "mine.csv", "--out", "out").returncode == 1
    page = (tmp_path / "out" / "report.html").read_text()
    table = re.search(r'<table class="motors[^"]*">.*?</table>', page, re.DOTALL)[0]
    assert table.count("within its limit") == 5 and "1.01 × expected" in table
    assert "no leg is right" not in page and "beyond its limit from" not in page[:page.index("<nav")]
