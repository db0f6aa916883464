"""The same solver as a process: ursula validate SCENARIO --solver 'python3 solver_process.py [ERROR]'

Each line of standard input is t, p, q, v, w, a, alpha, 20 values; it is answered with six torques. ERROR is put into
them, relative.
"""

import os
import sys

import numpy as np

from own_torques import Machine, torques


def main(error=0.0):
    machine = Machine(os.environ["URSULA_SCENARIO"])
    for line in sys.stdin:
        values = np.array(line.split(","), dtype=float)
        p, q, v, w, a, alpha = np.split(values[None, 1:], [3, 7, 10, 13, 16], axis=1)
        tau = (1 + error) * torques(machine, p, q, v, w, a, alpha)[0]
        print(",".join(f"{each:.17g}" for each in tau), flush=True)


if __name__ == "__main__":
    main(*(float(each) for each in sys.argv[1:2]))
