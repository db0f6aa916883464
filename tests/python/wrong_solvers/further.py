"""Thirty more wrong solvers, in the form of wrong.py: answers that say nothing of the machine, and mistakes of papers and
questions that the others lack. What is expected was decided before any answer; None in a list: silence is right as well."""

import copy

import numpy as np

from hexapod import Hexapod, cross, mv, rot
from more import motion
from wrong import MT, K, add, one, post


def answers(each):
    """A solver whose answer to one instant is each(right answer, calls so far, memory)."""

    def make(d, s):
        h, memory = Hexapod(d), {}

        def solver(m):
            tau = h(m)
            out = np.empty_like(tau)
            for i, right in enumerate(tau):
                out[i] = each(right, memory)
            return out
        return solver
    return make


def first(right, memory):
    return memory.setdefault("first", right.copy())


def before(right, memory):
    last = memory.get("last", right)
    memory["last"] = right.copy()
    return last


def stuck(right, memory):
    """Motor 4 keeps what it answered first."""
    out = right.copy()
    out[3] = memory.setdefault("first", right[3])
    return out


def random(right, memory):
    return memory.setdefault("rng", np.random.default_rng(7)).normal(0.0, 100.0, 6)


def by_time(d, s):
    """A table over time: what is asked beside the time does not count."""
    h, t = Hexapod(d), np.linspace(0.0, s.duration, 601)
    table = h(s.motion(t))
    return lambda m: np.stack([np.interp(np.asarray(m.t), t, table[:, k]) for k in range(6)], 1)


def home_jacobian(d, s):
    """Efforts by the Jacobian of the pose at the start: jacobian(R0, p0)^-T times the right wrench."""
    h = Hexapod(d)

    def rows(m):
        out, R = [], rot(np.array(m.q, float))
        for L in h.legs:
            b = mv(R, L["b"])
            k = np.array(m.p, float) + b - L["a"]
            e = k / np.linalg.norm(k, axis=1, keepdims=True)
            out.append(np.concatenate([e, cross(b, e)], 1))
        return np.stack(out, 1)

    home = rows(s.motion(np.zeros(1)))[0]

    def solver(m):
        wrench = np.einsum("nij,ni->nj", rows(m), h(m))
        return np.linalg.solve(home.T, wrench.T).T
    return solver


def euler_second(m):
    """alpha by the second rates of roll, pitch, yaw without the rate of their matrix; the angular velocity is right."""
    R = rot(m.q)
    pitch, yaw = np.arcsin(-R[:, 2, 0]), np.arctan2(R[:, 1, 0], R[:, 0, 0])
    cp, sp, cy, sy, zero = np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw), np.zeros_like(pitch)
    columns = [np.stack([cy * cp, sy * cp, -sp], -1), np.stack([-sy, cy, zero], -1), np.stack([zero, zero, zero + 1], -1)]
    rates = np.linalg.solve(np.stack(columns, -1), m.w[..., None])[..., 0]
    dp, dy = rates[:, 1], rates[:, 2]
    dx = np.stack([-sy * cp * dy - cy * sp * dp, cy * cp * dy - sy * sp * dp, -cp * dp], -1)
    turn = np.stack([dx, np.stack([-cy * dy, -sy * dy, zero], -1), np.zeros_like(dx)], -1)
    m.alpha = m.alpha - mv(turn, rates)


def other_euler(m):
    """Roll, pitch, yaw of Rz Ry Rx put into Rx Ry Rz."""
    R = rot(m.q)
    y = np.arcsin(-R[:, 2, 0]) / 2
    x, z = np.arctan2(R[:, 2, 1], R[:, 2, 2]) / 2, np.arctan2(R[:, 1, 0], R[:, 0, 0]) / 2
    cx, sx, cy, sy, cz, sz = np.cos(x), np.sin(x), np.cos(y), np.sin(y), np.cos(z), np.sin(z)
    m.q = np.stack([cx * cy * cz - sx * sy * sz, sx * cy * cz + cx * sy * sz, cx * sy * cz - sx * cy * sz,
                    cx * cy * sz + sx * sy * cz], 1)


def in_platform(*names):
    def change(m):
        back = np.swapaxes(rot(m.q), 1, 2)
        for each in names:
            setattr(m, each, mv(back, getattr(m, each)))
    return motion(change)


def about_centre(m, rho):
    m.p = m.p + mv(rot(m.q), rho)


def centre_pose(d, s):
    """The pose of the mass centre taken for P's; rates are right."""
    return motion(lambda m: about_centre(m, np.array(d["manipulator"]["platform"]["center_of_mass"])))(d, s)


def twice_omega(m):
    m.w = 2 * m.w


def centre_acceleration(d, s):
    """The acceleration alone of P is taken for the mass centre's."""
    rho = np.array(d["manipulator"]["platform"]["center_of_mass"])

    def change(m):
        r = mv(rot(m.q), rho)
        m.a = m.a - cross(m.alpha, r) - cross(m.w, cross(m.w, r))
    return motion(change)(d, s)


def gravity_turned(d, s):
    """The platform's weight points along the platform's own axes."""
    none, along = Hexapod(d, no_gravity="platform"), []
    for axis in np.eye(3):
        there = copy.deepcopy(d)
        there["manipulator"]["gravity"] = axis.tolist()
        along.append((Hexapod(there), Hexapod(there, no_gravity="platform")))

    def solver(m):
        turned = mv(rot(np.array(m.q, float)), none.g)
        weight = [full(m) - without(m) for full, without in along]
        return none(m) + sum(turned[:, k:k + 1] * weight[k] for k in range(3))
    return solver


def unit_axes(d, s):
    """Base axes of machines whose axes are not normalised, used as they are."""
    h = Hexapod(d)
    for L, leg in zip(h.legs, d["manipulator"]["leg"]):
        L["u"] = np.array(leg["base_axis"], float)
    return h


def every(path, change):
    def go(m, d):
        for leg in m["leg"]:
            part = leg
            for key in path[:-1]:
                part = part[key]
            part[path[-1]] = change(part[path[-1]])
    return go


def of_leg(number, key, change):
    def go(m, d):
        leg = m["leg"][number - 1]
        leg[key] = change(leg[key])
    return go


def axes_exchanged(m, d):
    a, b = m["leg"][1], m["leg"][4]
    a["base_axis"], b["base_axis"] = b["base_axis"], a["base_axis"]


def platform_times(key, factor):
    def go(m, d):
        value = m["platform"][key]
        m["platform"][key] = [x * factor for x in value] if isinstance(value, list) else value * factor
    return go


def sliding_only(y, m):
    return y * np.array([1, 1e-3, 1, 1, 1e-3, 1e-3])


def P(path):
    return K("parameter", parameter=path)


CONSTANT = [None]  # a sentence says so; the contract has no kind for it
# Answers that say nothing of the machine.
add("UPS RUS", "zeros", "zero for every motor", [K("scale", found=0.0)], post(lambda y, m: 0 * y))
add("UPS PUS", "unit-six", "0, 0, 0, 0, 0, 1 whatever is asked", CONSTANT, post(lambda y, m: 0 * y + (np.arange(6) == 5)))
add("URS", "mean", "the mean efforts of the motion, always", CONSTANT,
    lambda d, s: (lambda mean: lambda m: np.tile(mean, (len(m.t), 1)))(Hexapod(d)(s.motion(np.linspace(0, s.duration, 61))).mean(0)))
add("PUS", "first-answer", "always the answer of the first call", CONSTANT + [K("state")], answers(first))
add("RUS", "stuck", "motor 4 keeps its first answer", [K("state"), None], answers(stuck))
add("UPS", "dead-motor", "motor 2 is always zero", [K("scale", motor=2), K("scale", leg=2)], one(2, 0.0))
add("UPS PUSF", "before", "the answer of the question before", [K("state")], answers(before))
add("URS", "random", "random numbers", [K("state")], answers(random))
add("UPS", "by-time", "a table over time, the state is not read", [K("state"), None], by_time)
add("PUS", "copied", "column 4 repeats column 3", [K("order"), None], post(lambda y, m: y[:, [0, 1, 2, 2, 4, 5]]))
add("UPS", "magnitude", "magnitudes of the efforts", [K("sign"), None], post(lambda y, m: np.abs(y)))
add("RUS", "whole", "whole numbers, cut off", [K("digits")], post(lambda y, m: np.trunc(y)))
add("URS", "clipped", "no effort above 200 kN m", [K("window"), None], post(lambda y, m: np.clip(y, -2e5, 2e5)))
# The motion read wrongly.
add("UPS RUS", "euler-second", "second rates of roll, pitch, yaw without the rate of their matrix",
    [K("frame", term="angular_acceleration")], motion(euler_second))
add("PUS", "other-euler", "roll, pitch, yaw in the other order", [K("frame", term="orientation")], motion(other_euler))
add("RUS", "all-body", "v, a, omega and alpha in the platform's axes", [K("frame"), None], in_platform("v", "a", "w", "alpha"))
add("UPS", "a-body", "v and a in the platform's axes", [K("frame"), None], in_platform("v", "a"))
add("PUS", "centre-pose", "position of the mass centre taken for P's", [K("reference_point", body="platform"), None], centre_pose)
# Terms, points and frames.
add("UPS", "gravity-turned", "the platform's weight along the platform's axes", [K("frame", term="gravity")], gravity_turned)
add("PUS", "gravity-twice", "gravity counted twice",
    [MT("gravity"), P("manipulator.gravity*"), K("scale", term="gravity")], params=lambda m, d: m.update(gravity=[2 * x for x in m["gravity"]]))
add("UPS", "home-jacobian", "the Jacobian of the first pose all the time", [K("jacobian"), None], home_jacobian)
add("PUS RUS", "axes-as-given", "base axes not normalised", [P("manipulator.*base_axis*"), K("jacobian"), None], unit_axes)
# Numbers of the machine.
add("UPS", "pounds", "mass of the platform in pounds", [P("manipulator.platform.mass"), K("units")], params=platform_times("mass", 2.2046226))
add("RUS", "cm2", "inertia of the platform in kg cm^2", [P("manipulator.platform.inertia*"), K("units")], params=platform_times("inertia", 1e4))
add("URS RUS PUS", "axis-x", "base axis of leg 3 wrong in x", [P("manipulator.leg.3.base_axis*")],
    params=of_leg(3, "base_axis", lambda u: [u[0] + 0.02, u[1], u[2]]))
add("PUS", "axis-y", "base axis of leg 5 wrong in y", [P("manipulator.leg.5.base_axis*")],
    params=of_leg(5, "base_axis", lambda u: [u[0], u[1] - 0.04, u[2]]))
add("UPS", "axes-exchanged", "base axes of legs 2 and 5 exchanged", [P("manipulator.*base_axis*"), K("order"), None], params=axes_exchanged)
add("UPS", "joint-circle", "platform points 1 % too far out", [P("manipulator.*platform_point*"), None],
    params=every(["platform_point"], lambda b: [1.01 * x for x in b]))
add("PUS", "base-sign", "base point of leg 2 mirrored by 1 cm", [P("manipulator.leg.2.base_point*")],
    params=of_leg(2, "base_point", lambda a: [a[0] - 0.01, a[1], a[2]]))
add("mix", "kN-sliding", "kN of the motors that slide, N m of those that turn", [K("units"), K("scale"), None], post(sliding_only))

# Written after the causes for those above; what is expected was again decided before any answer.


def vector(path, by):
    """Adds to a vector of the machine: "platform.center_of_mass", "leg.4.platform_point"."""
    keys = path.split(".")

    def go(m, d):
        owner = m["leg"][int(keys[1]) - 1] if keys[0] == "leg" else m if len(keys) == 1 else m[keys[0]]
        owner[keys[-1]] = [float(x) for x in np.add(owner[keys[-1]], by)]
    return go


def both(*changes):
    def go(m, d):
        for change in changes:
            change(m, d)
    return go


def statics(d, s):
    """Only the platform's weight by the Jacobian: legs without mass, nothing moves."""
    h = Hexapod(d, no_link="legs")

    def solver(m):
        zero = np.zeros_like(np.array(m.v, float))
        return h(type("M", (), dict(t=m.t, p=m.p, q=m.q, v=zero, w=zero, a=zero, alpha=zero)))
    return solver


def hashed(y, m):
    """Small numbers that depend on the question, and on nothing else."""
    return np.sin(1e4 * y) * np.array([1, 2, 3, 1, 2, 3])


for machines, path, by in (("UPS", "platform.center_of_mass", [.01, -.02, .015]), ("URS RUS", "leg.4.platform_point", [.004, .003, -.002]),
                           ("PUS", "leg.2.base_point", [.003, -.002, .004]), ("PUS URS", "leg.1.base_axis", [.03, .02, -.05]),
                           ("RUS", "gravity", [-.4, -9.11, 9.78])):
    add(machines, "all-of-" + path, path + " wrong in all entries", [P("manipulator." + path + "*")], params=vector(path, by))
add("PUS", "two-axes", "axes of legs 1 and 4", None,
    params=both(vector("leg.1.base_axis", [.03, 0, 0]), vector("leg.4.base_axis", [0, .03, .01])))
add("UPS", "two-points", "both points of leg 3", None,
    params=both(vector("leg.3.base_point", [.003, 0, .002]), vector("leg.3.platform_point", [0, .002, .001])))
add("URS", "point-and-mass", "point of leg 2, mass of the platform", None,
    params=both(vector("leg.2.platform_point", [.001, .001, .001]), platform_times("mass", 1.01)))
add("UPS RUS", "weight-only", "the platform's weight alone", None, statics)
add("PUS", "hashed", "small numbers by chance", None, post(hashed))
add("RUS", "one-alive", "motor 1 is right, the others zero", CONSTANT + [K("scale")], post(lambda y, m: y * (np.arange(6) == 0)))
add("UPS", "half-alive", "motors 4 to 6 zero, the others 10 % too large", [K("scale"), None], post(lambda y, m: 1.1 * y * (np.arange(6) < 3)))
add("URS", "one-digit", "one significant digit", [K("digits")],
    post(lambda y, m: np.array([[float(f"{x:.0e}") for x in row] for row in y])))
add("PUS", "pulling", "no pushing: forces below zero are zero", [K("window"), None], post(lambda y, m: np.maximum(y, 0.0)))
add("UPS", "twice-omega", "omega doubled", [K("scale", term="angular_velocity")], motion(twice_omega))
add("PUS", "centre-acceleration", "the acceleration of P taken for the mass centre's", [K("reference_point", body="platform")], centre_acceleration)
