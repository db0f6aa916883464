"""Causes that are named for solvers that somebody wrote from the contract alone; a sample of tests/python/wrong_solvers.

A part of the sample, or all of it where URSULA_WHOLE is set (./dev prove).
"""

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "wrong_solvers"))
from judged import SOLVERS, judged  # noqa: E402

WHOLE = "URSULA_WHOLE" in os.environ
BY_NAME = {each["name"]: each for each in SOLVERS}
NAMED = ["tensor-P@UPS", "gyro-legs@UPS", "coriolis-legs@RUS", "spin@PUS", "jac-b@UPS", "open@RUS", "bias@UPS",
         "al-body@PUS", "grav-platform@UPS", "order-swap@UPS", "jac-b2@RUS", "digits-3@UPS", "single-in@PUS", "window@UPS",
         "euler-rates@UPS", "dead-motor@UPS", "axis-x@RUS", "par-gravity@UPS", "twice-omega@UPS", "centre-acceleration@PUS"]


@pytest.mark.parametrize("name", NAMED if WHOLE else NAMED[::5])
def test_names_the_cause(name):
    grade, cause = judged(BY_NAME[name])
    assert grade == "right", (name, cause)
    assert cause is not None and cause["explained"] > 0.99


TOGETHER = ["gyroP+gain3@RUS", "gyro+corL@URS", "gravL+swap25@PUS", "massP+comP@UPS", "gravL+fric+load@URSF"]


@pytest.mark.parametrize("name", TOGETHER if WHOLE else TOGETHER[:1])
def test_names_several_mistakes_together(name):
    grade, causes = judged(BY_NAME[name])
    assert grade == "right", (name, causes)


NONE = ["stuck@RUS", "right@ups", "unit-six@UPS"]


@pytest.mark.parametrize("name", NONE if WHOLE else NONE[:2])
def test_names_no_wrong_one(name):
    """An answer that never changes has a sentence alone, and a right solver none."""
    grade, cause = judged(BY_NAME[name])
    assert (grade, cause) == ("right", None)
