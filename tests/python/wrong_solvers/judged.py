"""What the program names for wrong solvers that were written from the contract alone.

    PYTHONPATH=build/python tests/python/wrong_solvers/judged.py [REGEX]    every one, or those whose names match

A solver is `right` where the cause that is named is one of those expected, `silent` where none is named, `wrong` else.
"""

import fnmatch
import itertools
import re
import sys
import time
from functools import lru_cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import ursula  # noqa: E402
from machines import build  # noqa: E402
from wrong import W as SOLVERS  # noqa: E402
import further  # noqa: E402, F401, which adds to them
import more  # noqa: E402, F401, which adds to them
import several  # noqa: E402, F401, which adds to them

FIELDS = ("leg", "motor")
OF_ONE = ("sign", "scale", "offset", "missing_term", "reference_point", "units")


@lru_cache(maxsize=None)
def scenario(machine):
    document = build(ursula, machine)
    return document, ursula.scenario(document)


def fits(expected, found):
    if isinstance(expected, tuple):
        return any(fits(each, found) for each in expected)
    if isinstance(expected, str) and isinstance(found, str):
        return fnmatch.fnmatchcase(found, expected)
    return expected == found


def is_right(cause, alternative):
    """A leg or a motor that is named where all are at fault is wrong."""
    if alternative["kind"] in OF_ONE and any(field in cause and field not in alternative for field in FIELDS):
        return False
    return cause["kind"] == alternative["kind"] and all(
        fits(value, cause[field]) for field, value in alternative.items() if field in cause)


def are_right(causes, mistakes):
    """Each of several mistakes is named, and nothing else."""
    return len(causes) == len(mistakes) and any(
        all(any(is_right(cause, each) for each in alternatives) for cause, alternatives in zip(some, mistakes))
        for some in itertools.permutations(causes))


def judged(solver):
    """(class, cause): `right`, `silent`, `wrong`, or `missed` where the verdict is not the one expected."""
    document, where = scenario(solver["machine"])
    result = ursula.validate(where, solver=solver["make"](document, where))
    cause, expected = result.summary["cause"], solver["expected"]
    if expected == "pass":
        return ("right" if result.verdict == "pass" and cause is None else "missed"), cause
    if result.verdict != "fail":
        return "missed", cause
    together = result.summary["causes_together"]
    if isinstance(expected, dict):
        return ("silent" if cause is None else "right" if are_right(together, expected["together"]) else "wrong"), together
    if together:
        return "wrong", together
    if cause is None:
        return ("right" if expected is None or None in expected else "silent"), cause
    return ("right" if any(is_right(cause, each) for each in expected or [] if each) else "wrong"), cause


def main(pattern=""):
    totals = {}
    for solver in SOLVERS:
        if not re.search(pattern, solver["name"]):
            continue
        begun = time.time()
        try:
            grade, cause = judged(solver)
        except ValueError as error:  # the solver has no answer
            grade, cause = "no answer", str(error)[:100]
        totals[grade] = totals.get(grade, 0) + 1
        print(f"{grade:9} {solver['name']:40} {time.time() - begun:5.1f} s  {cause}", flush=True)
    print(totals)


if __name__ == "__main__":
    main(*sys.argv[1:])
