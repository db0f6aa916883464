"""Results of ursula.identify."""

import json
import os
from html import escape

import numpy as np

from . import _ursula
from ._notebook import _verdict


class Identified:
    """The comparison of measured efforts with the model; identify makes it.

    `verdict`, `sentence`, `cause`, `causes`, `findings`, `delay`, `motors`, `combinations` and `parameters` are entries of `summary`, the dict of
    summary.json. `efforts` and `spectra` are dicts of arrays by column. `scenario_text` is TOML with the identified numbers and their tolerances.
    """

    def __init__(self, parts):
        text, self._page, self._table, self.scenario_text, self.efforts, self.spectra = parts
        self.summary = json.loads(text)
        for name in ("verdict", "sentence", "cause", "causes", "findings", "delay", "motors", "combinations", "parameters"):
            setattr(self, name, self.summary.get(name))

    def write(self, folder):
        """Writes summary.json, report.html, parameters.csv and identified.toml into a folder, which is created if necessary."""
        os.makedirs(folder, exist_ok=True)
        for name, text in (("summary.json", json.dumps(self.summary, indent=2) + "\n"), ("report.html", self._page),
                           ("parameters.csv", self._table), ("identified.toml", self.scenario_text)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)

    def _repr_html_(self):
        rows = "".join(
            f"<tr><td>{k}</td><td>{m['E_rms']:.3g}</td><td>{m['u_val']:.3g}</td><td>{100 * m['within_95']:.1f} %</td><td>{escape(m['unit'])}</td></tr>"
            for k, m in enumerate(self.motors, 1))
        return (f"<p><b>{escape(self.summary['scenario'])}</b>: {_verdict(self.verdict)}. {escape(self.sentence)}</p><table><thead><tr><th>motor</th>"
                f"<th>E</th><th>u_val</th><th>within</th><th>unit</th></tr></thead><tbody>{rows}</tbody></table>")

    def __repr__(self):
        return f"<ursula.Identified: {self.verdict}>"


def identify(s, measured=None, *, t=None, motion=None, efforts=None, map=(), constants=(), prior=False):
    """identify(s, measured=None, *, t=None, motion=None, efforts=None, map=(), constants=(), prior=False) -> Identified

    Compares measured efforts with the model of scenario `s`, judges it within its tolerances, and estimates its numbers.

    `measured` is a CSV file, read as `ursula identify` reads it. `map` has texts "NAME=COLUMN"; `constants` turn currents into efforts, N m/A or N/A.
    Arrays may replace the file: `t` (N,), s; `motion` (N, 6), driven coordinates, rad or m, or (N, 7), poses p, m, and q [w, x, y, z];
    `efforts` (N, 6), N m or N.
    `prior`: whether the scenario's tolerances are the prior uncertainty. Raises ValueError for a log that cannot be read or followed.
    """
    if not isinstance(s, _ursula.Scenario):
        raise TypeError(f"identify: s is of type {type(s).__name__}, expected a Scenario")
    if measured is not None:
        columns, currents = [str(each) for each in map], [float(each) for each in constants]
        return Identified(_ursula._identify_file(s, os.fsdecode(measured), columns, currents, bool(prior)))
    arrays = [_numbers(name, x) for name, x in (("t", t), ("motion", motion), ("efforts", efforts))]
    return Identified(_ursula._identify_arrays(s, *arrays, bool(prior)))


def _numbers(name, x):
    try:
        if x is not None:
            return np.ascontiguousarray(x, dtype=float)
    except (TypeError, ValueError):
        pass
    given = "missing" if x is None else f"of type {type(x).__name__}"
    raise TypeError(f"identify: {name} is {given}, expected an array of numbers, or the path of a file as measured")
