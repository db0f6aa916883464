"""The motor forces of a hexapod on telescopic (U-P-S) legs by Newton and Euler: a solver of one's own, NumPy alone.

    ursula validate my.toml --solver 'python3 ups_solver.py'      asked line by line, at any instant
    python3 ups_solver.py my.toml < motion.csv > mine.csv         the forces at the instants of `ursula inverse`

A last number, such as 1e-6, is put into the forces as a relative error. Each leg is cut free at its two joints: the
moments about the universal joint's two axes give the force at B across the leg, the rod's balance the force along it.
The platform's six equations then give the motors. Viscous and Coulomb friction are in, a load is not.
Arrays are (instant, leg, component); vectors are in the base's frame B.
"""

import os
import sys
import tomllib

import numpy as np

cross = np.cross


def dot(a, b):
    return np.sum(a * b, axis=-1, keepdims=True)


def tensor(entries):
    xx, yy, zz, xy, xz, yz = (*entries, 0.0, 0.0, 0.0)[:6]
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


class Machine:
    def __init__(self, scenario):
        with open(scenario, "rb") as file:
            read = tomllib.load(file)
        machine = read["manipulator"]
        legs = [{**machine.get("leg_defaults", {}), **leg} for leg in machine["leg"]]
        if "load" in read or len(legs) != 6 or any(
                leg.get("kind") != "UPS" or leg.get("actuated", ["d"]) != ["d"] for leg in legs):
            raise ValueError("this example knows six U-P-S legs with a motor on each d, and no load")

        def of(*keys, default=None):
            def get(table, keys):
                return get(table.get(keys[0], {}), keys[1:]) if keys[1:] else table.get(keys[0], default)
            return np.array([get(leg, keys) for leg in legs], dtype=float).reshape(6, -1)

        self.g = np.array(machine.get("gravity", [0.0, 0.0, -9.81]))
        self.a, self.u, self.b = of("base_point"), of("base_axis"), of("platform_point")
        self.u /= np.linalg.norm(self.u, axis=1, keepdims=True)
        self.cylinder, self.rod = ({key: of(link, key) for key in ("length", "mass", "center_of_mass")} |
                                   {"inertia": np.array([tensor(leg[link]["inertia"]) for leg in legs])}
                                   for link in ("proximal", "distal"))
        self.viscous = {name: of("friction", name, default=0.0) for name in ("phi", "psi", "d")}
        self.coulomb = {name: of("coulomb", name, default=0.0) for name in ("phi", "psi", "d")}
        self.smoothing = of("coulomb", "smoothing_speed", default=0.01)
        self.platform = machine["platform"]

    def friction(self, name, rate):
        return -self.viscous[name] * rate - self.coulomb[name] * np.tanh(rate / self.smoothing)


def rotation(q):
    w, x, y, z = q.T
    return np.moveaxis(np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), -1, 0)


def inertia_moment(inertia, axes, w, w_dot):
    """I ω̇ + ω × I ω, where the columns of `axes` are the body's own axes."""
    def times(v):
        local = np.swapaxes(axes, -1, -2) @ v[..., None]
        return (axes @ (inertia @ local))[..., 0]
    return times(w_dot) + cross(w, times(w))


def forces(machine, p, q, v, w, a, alpha):
    """(N, 6), N, positive where the motor pushes the leg longer; p, v, w, a, alpha (N, 3), q (N, 4)."""
    Q = rotation(q)
    p, v, w, a, alpha = (each[:, None, :] for each in (p, v, w, a, alpha))
    g, u = machine.g, machine.u

    # The platform's joints B, and the legs' lengths and directions.
    arm = np.einsum("nij,kj->nki", Q, machine.b)
    v_B = v + cross(w, arm)
    a_B = a + cross(alpha, arm) + cross(w, cross(w, arm))
    leg = p + arm - machine.a
    d = np.sqrt(dot(leg, leg))
    e = leg / d

    # The leg turns about u, fixed in the base, and about x, square to u and to the leg: never about its own line alone.
    x = cross(u, e)
    sine = np.sqrt(dot(x, x))
    x = x / sine
    y = cross(x, e)

    # v_B = ḋ e + d ω × e with ω = α u + β x.
    d_dot = dot(v_B, e)
    about_u, about_x = dot(v_B, x) / (d * sine), dot(v_B, y) / d
    w_leg = about_u * u + about_x * x
    e_dot = cross(w_leg, e)

    # a_B = d̈ e + 2 ḋ ė + d (ω̇ × e + ω × ė), and x turns with α u.
    d_ddot = dot(a_B, e) + d * dot(e_dot, e_dot)
    x_dot = about_u * cross(u, x)
    rest = (a_B - d_ddot * e - 2 * d_dot * e_dot) / d - cross(w_leg, e_dot) - about_x * cross(x_dot, e)
    w_dot = dot(rest, x) / sine * u + dot(rest, y) * x + about_x * x_dot
    e_ddot = cross(w_dot, e) + cross(w_leg, e_dot)

    # What cylinder and rod resist with: force at the mass centre, moment about A.
    axes = np.stack([x, cross(e, x), e], axis=-1)
    cylinder, rod = machine.cylinder, machine.rod
    at_rod = d - rod["length"] + rod["center_of_mass"]
    f_cylinder = cylinder["mass"] * (cylinder["center_of_mass"] * e_ddot - g)
    f_rod = rod["mass"] * (d_ddot * e + 2 * d_dot * e_dot + at_rod * e_ddot - g)
    moment = (cross(cylinder["center_of_mass"] * e, f_cylinder) + cross(at_rod * e, f_rod) +
              inertia_moment(cylinder["inertia"] + rod["inertia"], axes, w_leg, w_dot))

    # The universal joint bears no moment about u and x but friction (φ is positive about −u, ψ about x).
    across_x = (machine.friction("phi", about_u) - dot(u, moment)) / (d * sine)
    across_y = (machine.friction("psi", about_x) - dot(x, moment)) / d
    along = machine.friction("d", d_dot) - dot(e, f_rod)  # the motor's force comes on top
    F = across_x * x + across_y * y + along * e  # of the leg on the platform

    # The platform, about P: its own resistance less the known forces is what the motors do along the legs.
    rho = np.einsum("nij,j->ni", Q, np.array(machine.platform["center_of_mass"]))[:, None, :]
    f = machine.platform["mass"] * (a + cross(alpha, rho) + cross(w, cross(w, rho)) - g)
    n = inertia_moment(tensor(machine.platform["inertia"]), Q[:, None], w, alpha) + cross(rho, f)
    wrench = np.concatenate([n, f], axis=-1)[:, 0] - np.concatenate([cross(arm, F), F], axis=-1).sum(axis=1)
    lines = np.concatenate([cross(arm, e), e], axis=-1)  # (N, leg, 6)
    return np.linalg.solve(np.swapaxes(lines, 1, 2), wrench[..., None])[..., 0]


def main(arguments):
    error = 0.0
    if arguments and not arguments[-1].endswith(".toml"):
        error = float(arguments.pop())
    machine = Machine(arguments[0] if arguments else os.environ["URSULA_SCENARIO"])
    table = bool(arguments)
    for line in sys.stdin:
        if line.startswith("t_s"):
            print("t_s," + ",".join(f"tau_{leg}_N" for leg in range(1, 7)))
            continue
        values = np.array(line.split(",")[:20], dtype=float)
        tau = (1 + error) * forces(machine, *np.split(values[None, 1:], [3, 7, 10, 13, 16], axis=1))[0]
        print(",".join(f"{each:.17g}" for each in ([values[0], *tau] if table else tau)), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
