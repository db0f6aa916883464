"""Python ends while a daemon thread works: the process ends with its own exit code, whatever the thread does."""

import os
import signal
import subprocess
import sys

import pytest

from conftest import ROOT

TIMES = 3 if "URSULA_WHOLE" in os.environ else 1  # ./dev prove tries each more often

PROGRAM = """
import sys, threading, time
import numpy as np
import ursula

s = ursula.read_scenario(sys.argv[1])
s = ursula.scenario({**s.to_dict(), "simulation": {"samples": 21}})
m = s.motion(np.linspace(0, s.duration, 20_000))
began = threading.Event()

def solver(m):
    began.set()
    time.sleep(0.001)
    return s.inverse_dynamics(m)

def work():
    while True:
        CALL

for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
began.wait(float(sys.argv[2]))
sys.exit(7)
"""

CALLS = {
    "validate": "ursula.validate(s)",
    "a solver": "ursula.validate(s, solver)",
    "a sleeping solver": "ursula.validate(s, lambda m: (began.set(), time.sleep(1000)))",
    "map": "ursula.map(s, x=(-0.1, 0.1, 400), y=(-0.1, 0.1, 400))",
    "dynamics": "s.inverse_dynamics(m)",
    "short calls": "ursula.check(s)",
    "excite": "ursula.excite(s, tries=100_000)",
}


@pytest.mark.parametrize("call", CALLS, ids=str)
@pytest.mark.parametrize("after", (0.0, 0.02, 0.2))
def test_python_ends_while_a_daemon_thread_works(call, after):
    program = PROGRAM.replace("CALL", CALLS[call])
    for _ in range(TIMES):
        run = subprocess.run([sys.executable, "-c", program, str(ROOT / "scenarios/paper-helix.toml"), str(after)], capture_output=True,
                             text=True, timeout=600, check=False)
        assert run.returncode == 7, (call, signal.Signals(-run.returncode) if run.returncode < 0 else run.returncode, run.stderr)
        assert run.stderr == "", run.stderr


def test_a_call_at_exit_still_works():
    program = """
import atexit, sys
import ursula  # its own function for the end is registered first, so it runs last
s = ursula.read_scenario(sys.argv[1])
t = [0.0, 1.0]
atexit.register(lambda: print(s.inverse_dynamics(s.motion(t)).shape))
"""
    run = subprocess.run([sys.executable, "-c", program, str(ROOT / "scenarios/paper-helix.toml")], capture_output=True, text=True, timeout=600,
                         check=False)
    assert (run.returncode, run.stdout, run.stderr) == (0, "(2, 6)\n", "")


def test_a_call_after_its_own_end_still_works():
    program = """
import atexit, sys
made = []
atexit.register(lambda: print(made[0].validate(made[1], time_limit=1e8).verdict))  # registered first, so it runs last
import ursula
made += [ursula, ursula.scenario({**ursula.read_scenario(sys.argv[1]).to_dict(), "simulation": {"samples": 5}})]
"""
    run = subprocess.run([sys.executable, "-c", program, str(ROOT / "scenarios/paper-helix.toml")], capture_output=True, text=True, timeout=600,
                         check=False)
    assert (run.returncode, run.stdout, run.stderr) == (0, "pass\n", "")
