"""The examples, run as people run them."""

import importlib.util
import os
import subprocess
import sys

import numpy as np
import pytest

import ursula
from conftest import ROOT

FOLDER = ROOT / "examples" / "python"


def run(name, *arguments, cwd):
    return subprocess.run([sys.executable, FOLDER / name, *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          check=False)


def load(name):
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_own_torques_agree(helix):
    own, s = load("own_torques"), ursula.read_scenario(helix)
    m = s.motion(np.linspace(0, s.duration, 101))
    tau = s.inverse_dynamics(m)
    machine = own.Machine(helix)
    found = own.torques(machine, m.p, m.q, m.v, m.w, m.a, m.alpha)
    assert np.abs(found - tau).max() < 1e-13 * np.abs(tau).max()
    machine.mass *= 1 + 1e-9
    assert np.abs(own.torques(machine, m.p, m.q, m.v, m.w, m.a, m.alpha) - tau).max() > 1e-11 * np.abs(tau).max()


def test_own_solver_passes(helix, tmp_path):
    judged = run("judge_own_solver.py", helix, cwd=tmp_path)
    assert judged.returncode == 0 and "paper-helix: pass" in judged.stdout, judged.stderr


def test_own_solver_that_is_wrong_fails(quick, tmp_path):
    judged = run("judge_own_solver.py", quick, 1e-10, cwd=tmp_path)
    assert judged.returncode == 1 and "torque.pointwise: " in judged.stdout, judged.stderr
    assert run("judge_own_solver.py", tmp_path / "none.toml", cwd=tmp_path).returncode == 1


@pytest.mark.parametrize("script, figures", [("plot_torques.py", 1), ("figures_7_to_14.py", 8)])
def test_figures(script, figures, helix, tmp_path):
    drawn = run(script, helix, tmp_path, cwd=tmp_path)
    assert drawn.returncode == 0, drawn.stderr
    written = [each for each in os.listdir(tmp_path) if each.endswith(".svg")]
    if importlib.util.find_spec("matplotlib"):
        assert len(written) == figures and all((tmp_path / each).stat().st_size > 5000 for each in written)
    else:
        assert not written and "Matplotlib" in drawn.stdout
