"""The motors' torques along the motion: plot_torques.py SCENARIO [FOLDER] writes torques.svg there."""

import sys
from pathlib import Path

import numpy as np
import ursula


def main(path, folder="."):
    try:
        from matplotlib import pyplot
    except ImportError:
        print("Matplotlib is not installed: nothing is drawn")
        return
    s = ursula.read_scenario(path)
    m = s.motion(np.linspace(0, s.duration, 301))
    figure, axes = pyplot.subplots(layout="constrained")
    for leg, tau in enumerate(s.inverse_dynamics(m).T, 1):
        axes.plot(m.t, tau / 1000, label=f"τ{leg}")
    axes.set(xlabel="t (s)", ylabel="torque (kN m)", title=s.name)
    axes.legend()
    figure.savefig(Path(folder) / "torques.svg")


if __name__ == "__main__":
    main(*sys.argv[1:3])
