#!/usr/bin/env python3
"""Draws the machines of tests/vectors/kind-*.toml at random, with legs of every kind; every call draws the same.

    tools/draw_machines.py FOLDER [NAME…]      writes FOLDER/kind-NAME.toml and, by tools/make_vectors.py, FOLDER/kind-NAME.csv

Every number is a multiple of 1/1024 (quaternions: 1/8192), so that the file, a double and the reference's decimals are the
same number. A draw is kept if the whole motion stays in reach with room to spare and is well conditioned.
"""

import math
import random
import sys
import tomllib
from pathlib import Path

sys.dont_write_bytecode = True
import make_vectors  # noqa: E402

ROOM = 0.18  # least share of every margin that a leg names
LARGEST_CONDITION = 60
INSTANTS = 7

# (kind, actuated coordinates, or none for the default, whether û is along e_z)
URS, UPS, RUS, PUS = "URS", "UPS", "RUS", "PUS"
MACHINES = {
    "ups-1": dict(legs=[(UPS, None, i == 2) for i in range(6)], motion="helix"),
    "ups-2": dict(legs=[(UPS, ["d"], False) for i in range(6)], motion="waypoints", viscous=True),
    "rus-1": dict(legs=[(RUS, None, i == 4) for i in range(6)], motion="waypoints"),
    "rus-2": dict(legs=[(RUS, ["phi"], False) for i in range(6)], motion="helix", viscous=True),
    "pus-1": dict(legs=[(PUS, None, i == 1) for i in range(6)], motion="helix"),
    "pus-2": dict(legs=[(PUS, ["d"], False) for i in range(6)], motion="waypoints", viscous=True),
    "mixture": dict(legs=[(UPS, None, False), (RUS, None, False), (URS, None, False), (PUS, None, True), (RUS, None, True), (UPS, None, False)],
                    motion="waypoints"),
    "three-ups": dict(legs=[(UPS, ["phi", "d"], False)] * 3, motion="waypoints"),
    "three-rus": dict(legs=[(RUS, ["phi", "psi"], False)] * 3, motion="helix", viscous=True),
    "three-mixed": dict(legs=[(PUS, ["d", "psi"], False), (UPS, ["psi", "d"], False), (URS, ["phi", "theta"], False)], motion="waypoints"),
    "four": dict(legs=[(URS, ["phi", "psi"], False), (UPS, ["phi", "d"], False), (RUS, None, False), (PUS, None, False)], motion="helix"),
    "five": dict(legs=[(RUS, ["psi"], False), (PUS, ["psi"], False), (UPS, None, True), (URS, ["theta"], False), (RUS, ["phi", "theta"], False)],
                 motion="waypoints", viscous=True),
    "friction": dict(legs=[(PUS, None, False), (UPS, None, False), (RUS, None, False), (UPS, None, False), (URS, None, False), (PUS, None, False)],
                     motion="waypoints", viscous=True, coulomb=True),
    "friction-two-motors": dict(legs=[(UPS, ["phi", "d"], False), (RUS, ["phi", "psi"], False), (PUS, ["d", "theta"], False)],
                                motion="helix", viscous=True, coulomb=True, load="platform"),
    "load-base": dict(legs=[(RUS, None, False), (UPS, None, False), (PUS, None, False), (PUS, None, False), (UPS, None, False), (RUS, None, False)],
                      motion="helix", load="base"),
    "load-platform": dict(legs=[(UPS, None, False), (PUS, None, False), (RUS, None, False)] * 2, motion="waypoints", viscous=True, load="platform"),
}


def exact(value, unit=1024):
    return round(value * unit) / unit


class Draw:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def number(self, low, high):
        return exact(self.random.uniform(low, high))

    def numbers(self, low, high, count=3):
        return [self.number(low, high) for _ in range(count)]

    def sign(self):
        return self.random.choice((-1, 1))

    def direction(self):
        v = [self.random.gauss(0, 1) for _ in range(3)]
        n = math.sqrt(sum(x * x for x in v))
        return [x / n for x in v]

    def tensor(self, low, high):
        """The inertia of a body that can exist, from second moments along three random perpendicular axes."""
        a = self.direction()
        b = self.direction()
        along = sum(x * y for x, y in zip(a, b))
        b = [y - along * x for x, y in zip(a, b)]
        n = math.sqrt(sum(x * x for x in b))
        b = [x / n for x in b]
        c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        moments = [self.random.uniform(low, high) / 2 for _ in range(3)]
        second = [[sum(m * v[i] * v[j] for m, v in zip(moments, (a, b, c))) for j in range(3)] for i in range(3)]
        trace = sum(moments)
        entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        return [exact((trace if i == j else 0) - second[i][j]) for i, j in entries]

    def link(self, length, center):
        return {"length": exact(length), "mass": self.number(6, 25), "center_of_mass": exact(center), "inertia": self.tensor(0.5, 3)}

    def axis(self, angle, along_z):
        """An axis along the base's circle, outwards or between, and tilted."""
        if along_z:
            return [0.0, 0.0, 1.0]
        at = angle + math.radians(self.random.uniform(0, 360))
        return [exact(math.cos(at)), exact(math.sin(at)), self.number(-0.6, 0.6)]

    def leg(self, spec, angle, offset, height, of):
        kind, actuated, along_z = spec
        base_radius, platform_radius = self.random.uniform(1.3, 1.7), self.random.uniform(0.75, 1.05)
        at_base, at_platform = angle, angle + offset
        a = [exact(base_radius * math.cos(at_base)), exact(base_radius * math.sin(at_base)), self.number(-0.15, 0.15)]
        b = [exact(platform_radius * math.cos(at_platform)), exact(platform_radius * math.sin(at_platform)), self.number(-0.15, 0.15)]
        u = self.axis(angle, along_z)
        k = [y - x for x, y in zip(a, b)]
        k[2] += height
        q = math.sqrt(sum(x * x for x in k))
        unit = math.sqrt(sum(x * x for x in u))
        along = sum(x * y for x, y in zip(k, u)) / unit
        away = math.sqrt(q * q - along * along)
        draw = self.random.uniform
        if kind == URS:
            l, s = q * draw(0.65, 0.95), q * draw(0.65, 0.95)
        elif kind == UPS:
            s = q * draw(0.5, 0.75)
            l = q - s + draw(0.35, 0.6)
        elif kind == RUS:
            l, s = q * draw(0.35, 0.65), q * draw(0.75, 1.1)
        else:
            l, s = draw(0.1, 0.4), away * draw(1.2, 1.7)
        out = {"kind": kind}
        if actuated:
            out["actuated"] = actuated
        out |= {"base_point": a, "base_axis": u, "platform_point": b}
        out["proximal"] = self.link(l, draw(-0.1, 0.3) if kind == PUS else l * draw(0.25, 0.75))
        out["distal"] = self.link(s, s * draw(0.25, 0.75))
        if kind != UPS:
            out["knee"] = self.random.choice(("positive", "negative"))
        names = {"phi": "actuated", "psi": "universal", "theta": "knee"} if kind == URS else {}
        coordinates = [names.get(name, name) for name in make_vectors.COORDINATES[kind]]
        if of.get("viscous"):
            out["friction"] = {name: self.number(5, 60) for name in coordinates}
        if of.get("coulomb"):
            out["coulomb"] = {name: self.number(5, 60) for name in coordinates} | {"smoothing_speed": self.number(0.05, 0.3)}
        return out

    def helix(self, height):
        start, pitch, rise = self.number(-1.75, -1.45), self.number(0.9, 1.3), self.sign() * self.number(0.1, 0.2)
        return {"kind": "helix", "duration": self.number(1.5, 3), "radius": self.number(0.08, 0.16), "pitch": pitch, "start_angle": start,
                "end_angle": start + rise, "phase": self.number(-0.1, 0.1), "height_phase": exact(height / pitch - start - rise / 2)}

    def waypoints(self, height):
        points, time = [], 0.0
        for _ in range(self.random.choice((3, 4))):
            axis, half = self.direction(), self.random.uniform(0.02, 0.11)
            position = [self.number(-0.1, 0.1), self.number(-0.1, 0.1), exact(height + self.random.uniform(-0.1, 0.1))]
            orientation = [exact(math.cos(half), 8192), *(exact(x * math.sin(half), 8192) for x in axis)]
            points.append({"time": time, "position": position, "orientation": orientation})
            time += self.number(0.6, 1.0)
        return {"kind": "waypoints", "points": points}

    def scenario(self, name, of):
        height = self.number(0.95, 1.25)
        legs, count = [], len(of["legs"])
        for i, spec in enumerate(of["legs"]):
            if count == 6:
                angle = math.radians(120 * ((i + 1) // 2) + (9 if i % 2 == 0 else -9) + self.random.uniform(-4, 4))
                offset = math.radians((42 if i % 2 == 0 else -42) + self.random.uniform(-6, 6))
            else:
                angle = 2 * math.pi * i / count + self.random.uniform(-0.2, 0.2)
                offset = self.random.uniform(-0.4, 0.4)
            legs.append(self.leg(spec, angle, offset, height, of))
        out = {"name": f"kind-{name}", "manipulator": {
            "gravity": [*self.numbers(-0.9, 0.9, 2), self.number(-9.9, -9.7)],
            "platform": {"mass": self.number(150, 500), "center_of_mass": [*self.numbers(-0.2, 0.2, 2), self.number(0.1, 0.6)],
                         "inertia": self.tensor(60, 160)},
            "leg": legs}}
        if "load" in of:
            out["load"] = {"force": self.numbers(-400, 400), "moment": self.numbers(-90, 90), "point": self.numbers(-0.5, 0.5), "frame": of["load"]}
        out["trajectory"] = self.helix(height) if of["motion"] == "helix" else self.waypoints(height)
        return out


def toml(value):
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list):
        return "[" + ", ".join(toml(each) for each in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(each)}" for key, each in value.items()) + " }"
    return repr(value)


def table(header, keys):
    return f"\n{header}\n" + "".join(f"{key} = {toml(value)}\n" for key, value in keys.items())


def text_of(scenario):
    machine = scenario["manipulator"]
    out = f'name = "{scenario["name"]}"\n'
    out += table("[manipulator]", {"gravity": machine["gravity"]}) + table("[manipulator.platform]", machine["platform"])
    out += "".join(table("[[manipulator.leg]]", leg) for leg in machine["leg"])
    if "load" in scenario:
        out += table("[load]", scenario["load"])
    keys = dict(scenario["trajectory"])
    points = keys.pop("points", None)
    out += table("[trajectory]", keys)
    if points:
        out += "points = [\n" + "".join(f"  {toml(point)},\n" for point in points) + "]\n"
    return out


def good(scenario):
    """Whether the motion stays in reach, no angle passes pi, and the motors hold the platform well."""
    machine = make_vectors.Machine(scenario)
    duration, motion = make_vectors.motion_of(scenario["trajectory"])
    before = None
    try:
        for t in make_vectors.instants(duration, 25, False):
            q, _, margins = machine.at(motion(t)(make_vectors.mpf(t)))
            if min(min(margin.values()) for margin in margins) < ROOM:
                return False
            if any(abs(value) > 2.9 for name, value in zip(machine.names, q) if name != "d"):
                return False
            if before and any(abs(a - b) > 0.5 for a, b in zip(q, before)):
                return False
            before = q
        return all(make_vectors.Instant(machine, motion, t).condition(machine) < LARGEST_CONDITION
                   for t in make_vectors.instants(duration, 4, False))
    except make_vectors.OutOfReach:
        return False


def drawn(name):
    of = MACHINES[name]
    for attempt in range(100000):
        scenario = Draw(f"{name} {attempt}").scenario(name, of)
        text = text_of(scenario)
        make_vectors.mp.dps = 30
        kept = quick(scenario) and good(tomllib.loads(text, parse_float=str))
        make_vectors.mp.dps = 100
        if kept:
            print(f"{name}: draw {attempt}", file=sys.stderr)
            return text
    raise RuntimeError(name)


def quick(scenario):
    """The same at a middle pose only."""
    machine = make_vectors.Machine(scenario)
    duration, motion = make_vectors.motion_of(scenario["trajectory"])
    t = duration / 2
    try:
        _, _, margins = machine.at(motion(t)(t))
    except make_vectors.OutOfReach:
        return False
    return min(min(margin.values()) for margin in margins) >= ROOM


def main():
    folder = Path(sys.argv[1])
    for name in sys.argv[2:] or MACHINES:
        path = folder / f"kind-{name}.toml"
        path.write_text(drawn(name))
        make_vectors.write(path, None, INSTANTS, path.with_suffix(".csv"))


if __name__ == "__main__":
    main()
