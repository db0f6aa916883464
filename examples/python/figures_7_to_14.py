"""Figures 7 to 14 of the paper: figures_7_to_14.py SCENARIO [FOLDER] writes fig-07.svg to fig-14.svg there."""

import sys
import tomllib
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
    joints = s.inverse_kinematics(m)

    def save(figure, number):
        figure.savefig(Path(folder) / f"fig-{number:02}.svg")
        pyplot.close(figure)

    def over_time(number, title, unit, columns, names):
        figure, axes = pyplot.subplots(layout="constrained")
        for column, name in zip(columns.T, names):
            axes.plot(m.t, column, label=name)
        axes.set(xlabel="t (s)", ylabel=unit, title=f"Fig. {number}: {title}")
        axes.legend()
        save(figure, number)

    legs = [str(leg) for leg in range(1, 7)]
    over_time(9, "acceleration of P", "m/s²", m.a, "xyz")
    over_time(10, "angular acceleration of the platform", "rad/s²", m.alpha, "xyz")
    over_time(11, "ψ at the universal joints", "rad", joints["psi"], legs)
    over_time(12, "θ at the knees", "deg", np.degrees(joints["theta"]), legs)
    over_time(13, "φ of the motors", "rad", joints["phi"], legs)
    over_time(14, "torques of the motors", "kN m", s.inverse_dynamics(m) / 1000, legs)

    def in_space(number, title):
        figure, axes = pyplot.subplots(subplot_kw={"projection": "3d"}, layout="constrained")
        axes.plot(*m.p.T)
        axes.set(xlabel="x (m)", ylabel="y (m)", zlabel="z (m)", title=f"Fig. {number}: {title}")
        return figure, axes

    save(in_space(7, "trajectory of P")[0], 7)

    # The platform's points B on their way, and the base's A.
    with open(path, "rb") as file:
        points = tomllib.load(file)["manipulator"]["leg"]
    a, b = (np.array([leg[key] for leg in points]) for key in ("base_point", "platform_point"))
    figure, axes = in_space(8, "platform along the trajectory")
    axes.plot(*np.vstack([a, a[:1]]).T, "k.-")
    for k in range(0, len(m), 60):
        B = m.p[k] + b @ m.Q[k].T
        axes.plot(*np.vstack([B, B[:1]]).T, ".-")
    save(figure, 8)


if __name__ == "__main__":
    main(*sys.argv[1:3])
