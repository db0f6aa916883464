"""Random machines of the four kinds of legs, as a scenario says them and as bodies and joints at one pose."""

import numpy as np


def unit(v):
    return v / np.linalg.norm(v)


def rotation(axis, angle):
    x, y, z = unit(np.asarray(axis, float))
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def random_rotation(rng):
    return rotation(rng.normal(size=3), rng.uniform(0, 3))


def tensor(rng, scale, line=None):
    """Of a random mass distribution; `line`: equal moments about the third axis."""
    if line is not None:
        t = scale * rng.uniform(0.5, 1)
        return np.diag([t, t, line * t])
    masses, points = rng.uniform(0.5, 1, 8), rng.normal(size=(8, 3)) * [0.2, 0.3, 1.0]
    I = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, points))
    return I * scale / np.trace(I)


def fixed_frame(u):
    x = np.cross(u, [0, 0, 1.0])
    if np.linalg.norm(x) < 1e-10:
        x = np.cross(u, [0, 1.0, 0])
    x = unit(x)
    return np.column_stack([x, u, np.cross(x, u)])


def frame(x, along):
    return np.column_stack([x, np.cross(along, x), along])


def place_leg(leg, B):
    """Origins and frames of the links, and the joints (kind, axis, centre) from the base, by docs/legs.md."""
    A, u, l, s = leg["A"], leg["u"], leg["l"], leg["s"]
    side = 1 if leg["knee"] else -1
    AB = B - A
    along = AB @ u
    across = AB - along * u
    distance = np.linalg.norm(across)
    out = unit(across)
    kind = leg["kind"]
    if kind == "UPS":
        d = np.linalg.norm(AB)
        if not s < d < s + l:
            return None
        e = AB / d
        x = unit(np.cross(u, AB))
        E = frame(x, e)
        return (A, E), (A + (d - s) * e, E), [("R", -u, A), ("R", x, A), ("P", e, A + 0.3 * d * e), ("S", None, B)]
    if kind == "URS":
        q = np.linalg.norm(AB)
        if not abs(l - s) * 1.1 < q < 0.95 * (l + s):
            return None
        x = unit(np.cross(u, AB))
        e = rotation(x, side * np.arccos((l * l + q * q - s * s) / (2 * l * q))) @ (AB / q)
        R = A + l * e
        return (A, frame(x, e)), (R, frame(x, unit(B - R))), [("R", -u, A), ("R", x, A), ("R", x, R), ("S", None, B)]
    if kind == "RUS":
        if abs(along) > 0.9 * s:
            return None
        c = np.sqrt(s * s - along * along)
        if not abs(l - c) * 1.1 < distance < 0.95 * (l + c):
            return None
        foot = (distance + (l * l - c * c) / distance) / 2
        e = (foot * out + side * np.sqrt(l * l - foot * foot) * np.cross(u, out)) / l
        R = A + l * e
        rod = unit(B - R)
        x, x2 = unit(np.cross(u, e)), unit(np.cross(u, rod))
        return (A, frame(x, e)), (R, frame(x2, rod)), [("R", -u, A), ("R", -u, R), ("R", -x2, R), ("S", None, B)]
    if not 0.1 * s < distance < 0.9 * s:
        return None
    ahead = side * np.sqrt(s * s - distance * distance)
    leg["d0"] = along - ahead
    C = A + leg["d0"] * u
    rod = unit(B - C)
    x = unit(np.cross(u, out))
    return (C, fixed_frame(u)), (C, frame(x, rod)), [("P", u, C), ("R", -u, C), ("R", x, C), ("S", None, B)]


def random_leg(rng, kind, A, B):
    q = np.linalg.norm(B - A)
    while True:
        leg = {"kind": kind, "A": A, "u": unit(rng.normal(size=3)), "knee": bool(rng.integers(2))}
        if kind == "UPS":
            leg["s"], leg["l"] = q * rng.uniform(0.6, 0.8), q * rng.uniform(0.5, 0.8)
        else:
            leg["l"], leg["s"] = q * rng.uniform(0.5, 0.9), q * rng.uniform(0.6, 1.2)
        if np.linalg.norm(np.cross(leg["u"], unit(B - A))) < 0.3:
            continue
        placed = place_leg(leg, B)
        if placed is not None:
            return leg, placed


def random_machine(rng, kinds=("UPS", "URS", "RUS", "PUS"), free=False, rotor=False):
    """A dict: platform, legs with numbers as in a scenario, bodies and joints in B at the initial pose."""
    p, Q = np.array([0, 0, 1.5]) + rng.normal(size=3) * 0.1, rotation(rng.normal(size=3), rng.uniform(0, 0.4))
    platform = {"name": "platform", "mass": rng.uniform(5, 50), "rho": rng.normal(size=3) * 0.1, "I": tensor(rng, 20), "p": p, "Q": Q}
    machine = {"platform": platform, "legs": [], "gravity": rng.normal(size=3) * [0.5, 0.5, 0] + [0, 0, -9.7]}
    for i in range(6):
        angle = 2 * np.pi * (i + 0.3 * (-1) ** i) / 6
        A = np.array([np.cos(angle), np.sin(angle), 0]) * 1.3 + rng.normal(size=3) * 0.05
        b = np.array([np.cos(angle + 0.3), np.sin(angle + 0.3), 0]) * 0.6 + rng.normal(size=3) * 0.05
        leg, placed = random_leg(rng, kinds[rng.integers(len(kinds))], A, p + Q @ b)
        leg.update(b=b, placed=placed, name=f"leg{i + 1}", links=[])
        for k, scale in enumerate((0.4, 0.3)):
            length = leg["l"] if k == 0 else leg["s"]
            com = np.array([0, length * rng.uniform(0, 0.2), 0]) if leg["kind"] == "PUS" and k == 0 else np.array([0, 0, length * rng.uniform(0.2, 0.8)])
            if not free:
                com = com + rng.normal(size=3) * 0.02
            leg["links"].append({"mass": rng.uniform(1, 5), "com": com, "I": tensor(rng, scale, 0.02 if free else None)})
        n = 3
        leg["friction"] = [round(x, 3) for x in rng.uniform(0.1, 2, n)]
        driven = {"UPS": 2}.get(leg["kind"], 0)
        leg["driven"] = driven
        leg["rotor"] = round(float(rng.uniform(0.1, 1)), 3) if rotor else 0.0
        machine["legs"].append(leg)
    return machine


def bodies_of(machine, rng, free=False, split=True):
    """{name: body} and [joint] in B. Each link has a frame of its own, turned and moved at random."""
    bodies, joints = {}, []
    P = machine["platform"]

    def add(name, origin, R, mass, com, I, fixed_frame_=False):
        bodies[name] = {"name": name, "T": (np.array(origin), np.array(R)), "mass": mass, "com": com, "I": I}

    add("base", np.zeros(3), np.eye(3), 3.0, np.zeros(3), np.eye(3))
    add("platform", P["p"], P["Q"], P["mass"], P["p"] + P["Q"] @ P["rho"], P["Q"] @ P["I"] @ P["Q"].T)
    for leg in machine["legs"]:
        names = [leg["name"] + "_first", leg["name"] + "_second"]
        for (origin, E), link, name in zip(leg["placed"][:2], leg["links"], names):
            turn = random_rotation(rng)
            add(name, origin + rng.normal(size=3) * 0.1, turn, link["mass"], origin + E @ link["com"], E @ link["I"] @ E.T)
        ways = ["base"] + ([None] + names if leg["kind"] in ("UPS", "URS") else names[:1] + [None] + names[1:]) + ["platform"]
        position = {"PUS": leg.get("d0", 0)}.get(leg["kind"], 0)
        for k, (kind, axis, centre) in enumerate(leg["placed"][2]):
            joints.append({"name": f"{leg['name']}_j{k}", "kind": kind, "axis": axis, "centre": centre, "from": ways[k], "to": ways[k + 1],
                           "friction": leg["friction"][k] if k < 3 else 0, "driven": k == leg["driven"], "leg": leg,
                           "rotor": leg["rotor"] if k == leg["driven"] else 0, "position": position if k == 0 else 0})
            if kind == "P" and leg["kind"] == "UPS":
                d = np.linalg.norm(leg["placed"][2][3][2] - leg["A"])
                joints[-1]["limits"] = (leg["s"] - d, leg["s"] + leg["l"] - d)
    if split:
        split_bodies(bodies, rng)
    return bodies, joints


def split_bodies(bodies, rng):
    """Some links lose a piece of their mass to a body that is fixed to them."""
    for name in list(bodies):
        if name == "base" or rng.uniform() < 0.5:
            continue
        whole = bodies[name]
        m = whole["mass"] * rng.uniform(0.1, 0.4)
        c = whole["com"] + rng.normal(size=3) * 0.02
        I = whole["I"] * 0.1
        rest = whole["mass"] - m
        c_rest = (whole["mass"] * whole["com"] - m * c) / rest
        steiner = lambda mass, r: mass * (r @ r * np.eye(3) - np.outer(r, r))
        I_rest = whole["I"] - I - steiner(m, c - whole["com"]) - steiner(rest, c_rest - whole["com"])
        w = np.linalg.eigvalsh(I_rest)
        if w[0] <= 0 or w[2] > w[0] + w[1]:
            continue
        bodies[name + "_piece"] = {"name": name + "_piece", "T": (c + rng.normal(size=3) * 0.05, random_rotation(rng)), "mass": m, "com": c, "I": I,
                                   "fixed_to": name}
        whole.update(mass=rest, com=c_rest, I=I_rest)
