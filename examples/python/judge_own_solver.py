"""Judges a solver of your own: judge_own_solver.py SCENARIO [ERROR]. ERROR is a relative error of its torques."""

import sys

import ursula

from own_torques import Machine, torques


def main(path, error=0.0):
    scenario = ursula.read_scenario(path)
    machine = Machine(path)

    def mine(m):
        return (1 + error) * torques(machine, m.p, m.q, m.v, m.w, m.a, m.alpha)

    result = ursula.validate(scenario, solver=mine)
    print(f"{result.scenario}: {result.verdict}, {result.reason}")
    for check in result.checks:
        if check.verdict not in ("pass", "not_applicable"):
            print(f"{check.name}: {check.why}")
    return 0 if result.verdict == "pass" else 1


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1], *(float(each) for each in sys.argv[2:3])))
    except ValueError as error:  # ScenarioError and PoseError, too
        sys.exit(f"error: {error}")
