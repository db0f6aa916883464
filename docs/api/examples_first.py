#!/usr/bin/env python3
"""Doxygen's input filter: puts an example into the comment of a public type, after its first sentence.

    examples_first.py HEADER
"""

import re
import sys

EXAMPLES = {
    "Scenario": "machine_in_code.cpp scenario",
    "ManipulatorParameters": "machine_in_code.cpp machine",
    "Manipulator": "sweep_by_hand.cpp sweep",
    "Trajectory": "machine_in_code.cpp trajectory",
    "Motion": "inverse_dynamics.cpp loop",
    "Solver": "inverse_dynamics.cpp loop",
    "Workspace": "inverse_dynamics.cpp loop",
    "DirectKinematics": "all_poses.cpp poses",
    "PlatformPose": "all_poses.cpp poses",
    "PlatformPoses": "all_poses.cpp poses",
    "Subject": "judge_own_solver.cpp judge",
    "ValidationResult": "judge_own_solver.cpp judge",
    "MechanismScenario": "judge_fourbar.cpp judge",
    "MechanismSubject": "judge_fourbar.cpp judge",
    "MechanismAlong": "judge_fourbar.cpp dynamics",
    "LoopSolver": "judge_fourbar.cpp dynamics",
    "LoopWork": "judge_fourbar.cpp dynamics",
    "Check": "judge_own_solver.cpp judge",
}
TYPE = re.compile(r"((?:^///[^\n]*\n)*)((?:template[^\n]*\n)?(?:class|struct) (\w+)[^;{]*\{)", re.M)


def with_example(match):
    comment, declaration, name = match.groups()
    if name not in EXAMPLES:
        return match.group()
    if not comment:
        return f"/// \\comment_missing\n{declaration}"  # unknown to Doxygen, and so an error
    words = " ".join(line[3:].strip() or "\n///\n///" for line in comment.splitlines())
    first, _, rest = words.partition(". ")
    first = first if first.endswith(".") else first + "."
    return f"/// {first}\n/// \\snippet {EXAMPLES[name]}\n/// {rest}\n{declaration}"


print(TYPE.sub(with_example, open(sys.argv[1], encoding="utf-8").read()), end="")
