#!/usr/bin/env python3
"""Reference motion, joint variables and efforts of any manipulator, from the contract's geometry alone.

    tools/make_vectors.py SCENARIO.toml [--at T… | --count N] [--out FILE.csv]   vectors, at 7 instants unless told
    tools/make_vectors.py --compare SCENARIO.toml FILE.csv                       digits in which the file's rows agree
    tools/make_vectors.py --check SCENARIO.toml… [--count N]                     reach, conditioning and largest efforts

Only positions are given here: the pose over time, and a leg's links and joint variables at a pose.
Rates, accelerations, angular velocities and virtual displacements are differences of those over a step of 1e-15 in 100 digits,
which leaves about 50 right; efforts follow from d'Alembert's principle, one equation for each of the platform's six virtual
displacements. No Jacobian, no rate formula of the paper and no code of the program is used. Needs Debian's python3-mpmath.
"""

import argparse
import csv
import sys
import tomllib
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 100
STEP = mpf(10) ** -15
DIGITS = 25
ZERO = mpf(10) ** -40  # differences of equal numbers leave far less
COORDINATES = {"URS": ("phi", "psi", "theta"), "UPS": ("phi", "psi", "d"), "RUS": ("phi", "psi", "theta"), "PUS": ("d", "psi", "theta")}
NAMES = ("phi", "psi", "theta", "d")
FRICTION_OF_URS = {"phi": "actuated", "psi": "universal", "theta": "knee"}


class OutOfReach(ValueError):
    """A leg of this kind cannot reach the point."""


# Vectors are lists of three; frames and matrices lists of three columns.


def vector(values):
    return [mpf(value) for value in values]


def add(*terms):
    return [mp.fsum(entries) for entries in zip(*terms)]


def scaled(factor, v):
    return [factor * entry for entry in v]


def minus(v, w):
    return [a - b for a, b in zip(v, w)]


def dot(v, w):
    return sum(a * b for a, b in zip(v, w))


def cross(v, w):
    return [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]


def norm(v):
    return mp.sqrt(dot(v, v))


def times(columns, v):
    return add(*(scaled(entry, column) for entry, column in zip(v, columns)))


def transposed(columns):
    return [list(row) for row in zip(*columns)]


def product(left, right):
    return [times(left, column) for column in right]


def skew_part(columns):
    """The vector of the skew-symmetric part."""
    return scaled(mpf(1) / 2, [columns[1][2] - columns[2][1], columns[2][0] - columns[0][2], columns[0][1] - columns[1][0]])


def turn(axis, angle):
    """The rotation about axis 0, 1 or 2 of B."""
    c, s = mp.cos(angle), mp.sin(angle)
    one, two = (axis + 1) % 3, (axis + 2) % 3
    columns = [[mpf(0)] * 3 for _ in range(3)]
    columns[axis][axis] = mpf(1)
    columns[one][one], columns[one][two] = c, s
    columns[two][one], columns[two][two] = -s, c
    return columns


def wrapped(angle):
    """The same angle in (-pi, pi]."""
    return angle - 2 * mp.pi * mp.ceil((angle - mp.pi) / (2 * mp.pi))


# The pose over time. Each of these returns a function of an instant that is smooth around the given one.


def helix(keys):
    start, end, duration = mpf(keys["start_angle"]), mpf(keys["end_angle"]), mpf(keys["duration"])
    radius, pitch = mpf(keys["radius"]), mpf(keys["pitch"])
    phase, height_phase = mpf(keys.get("phase", 0)), mpf(keys.get("height_phase", 0))
    rate_0, rate_f = mpf(keys.get("start_rate", 0)), mpf(keys.get("end_rate", 0))
    acc_0, acc_f = mpf(keys.get("start_acceleration", 0)), mpf(keys.get("end_acceleration", 0))
    beta_of = quintic(mpf(0), duration, [start, rate_0, acc_0], [end, rate_f, acc_f])

    def pose(t):
        beta = beta_of(t)
        c, s = mp.cos(beta + phase), mp.sin(beta + phase)
        tangent = scaled(1 / mp.sqrt(radius**2 + pitch**2), [-radius * s, radius * c, pitch])
        normal = [-c, -s, mpf(0)]
        return [radius * c, radius * s, pitch * (beta + height_phase)], [scaled(-1, cross(tangent, normal)), normal, tangent]

    return duration, lambda _: pose


def quintic(begin, end, at_begin, at_end):
    """The polynomial of degree five with these values, rates and accelerations at both ends, from its six equations."""
    h = end - begin
    rows = mp.matrix(6, 6)
    right = mp.matrix(6, 1)
    for derivative in range(3):
        rows[derivative, derivative] = mp.factorial(derivative)
        right[derivative] = at_begin[derivative] * h**derivative
        for power in range(derivative, 6):
            rows[3 + derivative, power] = mp.ff(power, derivative)
        right[3 + derivative] = at_end[derivative] * h**derivative
    coefficients = list(mp.lu_solve(rows, right))[::-1]
    return lambda t: mp.polyval(coefficients, (t - begin) / h)


def spline(knots, values):
    """Pieces of degree five, four times continuously differentiable, at rest at both ends: all coefficients are found at once."""
    pieces = len(knots) - 1
    h = [knots[i + 1] - knots[i] for i in range(pieces)]
    rows, right, width = [], [], len(values[0])

    def equation(terms, value):
        row = [mpf(0)] * (6 * pieces)
        for piece, share, derivative, sign in terms:  # share: 0 at the piece's begin, 1 at its end
            for power in range(derivative, 6):
                if share or power == derivative:
                    row[6 * piece + power] += sign * mp.ff(power, derivative) / h[piece] ** derivative
        rows.append(row)
        right.append(value)

    nothing = [mpf(0)] * width
    for i in range(pieces):
        equation([(i, 0, 0, 1)], values[i])
        equation([(i, 1, 0, 1)], values[i + 1])
        for derivative in range(1, 5) if i else ():
            equation([(i - 1, 1, derivative, 1), (i, 0, derivative, -1)], nothing)
    for derivative in (1, 2):
        equation([(0, 0, derivative, 1)], nothing)
        equation([(pieces - 1, 1, derivative, 1)], nothing)
    inverse = mp.matrix(rows) ** -1
    solved = inverse * mp.matrix(right)

    def piece_at(t):
        piece = max(i for i in range(pieces) if i == 0 or knots[i] <= t)
        columns = [[solved[6 * piece + power, k] for power in range(5, -1, -1)] for k in range(width)]
        return lambda at: [mp.polyval(column, (at - knots[piece]) / h[piece]) for column in columns]

    return piece_at


def quaternion(point):
    """The unit quaternion of a pose's keys. Roll, pitch and yaw are turns about the fixed x, y and z."""
    if "rpy_deg" in point:
        roll, pitch, yaw = (mp.radians(mpf(angle)) for angle in point["rpy_deg"])
        q = [mpf(1), mpf(0), mpf(0), mpf(0)]
        for axis, angle in ((0, roll), (1, pitch), (2, yaw)):
            by = [mp.cos(angle / 2), *(mp.sin(angle / 2) if k == axis else mpf(0) for k in range(3))]
            v, w = by[1:], q[1:]
            q = [by[0] * q[0] - dot(v, w), *add(scaled(by[0], w), scaled(q[0], v), cross(v, w))]
        return q
    q = vector(point["orientation"])
    return scaled(1 / mp.sqrt(dot(q, q)), q)


def rotation(q):
    """The rotation of a quaternion of any length."""
    w, x, y, z = q
    n = dot(q, q)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return [scaled(1 / n, column) for column in transposed(rows)]


def waypoints(keys):
    points = keys["points"]
    values = []
    for point in points:
        q = quaternion(point)
        if values and dot(q, values[-1][3:]) < 0:
            q = scaled(-1, q)
        values.append(vector(point["position"]) + q)
    curve_at = spline([mpf(point["time"]) for point in points], values)

    def around(t):
        curve = curve_at(t)

        def pose(at):
            value = curve(at)
            return value[:3], rotation(value[3:])

        return pose

    return mpf(points[-1]["time"]), around


def hold(keys):
    pose = vector(keys["position"]), rotation(quaternion(keys))
    return mpf(keys["duration"]), lambda _: lambda _: pose


def motion_of(keys):
    kinds = {"helix": helix, "waypoints": waypoints, "hold": hold}
    given = {key.removesuffix("_deg"): mp.radians(mpf(value)) if key.endswith("_deg") else value
             for key, value in keys.items() if key != "rpy_deg"}
    if "rpy_deg" in keys:
        given["rpy_deg"] = keys["rpy_deg"]
    return kinds[keys["kind"]](given)


# The machine.


def tensor(entries):
    xx, yy, zz, xy, xz, yz = vector(entries) + [mpf(0)] * (6 - len(entries))
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


class Link:
    def __init__(self, keys):
        self.length = mpf(keys["length"])
        self.mass = mpf(keys["mass"])
        self.center = mpf(keys["center_of_mass"])
        self.inertia = tensor(keys["inertia"])


class Leg:
    """The leg's coordinates and links as a function of the place of B."""

    def __init__(self, keys):
        self.kind = keys.get("kind", "URS")
        self.coordinates = COORDINATES[self.kind]
        self.actuated = [name for name in self.coordinates if name in keys.get("actuated", self.default_motor())]
        self.a = vector(keys["base_point"])
        self.b = vector(keys["platform_point"])
        self.proximal, self.distal = Link(keys["proximal"]), Link(keys["distal"])
        self.knee = {"positive": 1, "negative": -1}[keys.get("knee", "positive")]
        self.viscous, self.coulomb = ([self.friction(keys.get(table, {}), name) for name in self.coordinates]
                                      for table in ("friction", "coulomb"))
        self.smoothing_speed = mpf(keys.get("coulomb", {}).get("smoothing_speed", 0.01))
        axis = vector(keys["base_axis"])
        u = scaled(1 / norm(axis), axis)
        e_y, e_z = [mpf(0), mpf(1), mpf(0)], [mpf(0), mpf(0), mpf(1)]
        x = cross(u, e_y if norm(cross(u, e_z)) < mpf(10) ** -10 else e_z)
        x = scaled(1 / norm(x), x)
        self.fixed = [x, u, cross(x, u)]

    def default_motor(self):
        return self.coordinates[:1] if self.kind != "UPS" else ("d",)

    def friction(self, table, name):
        return mpf(table.get(name, table.get(FRICTION_OF_URS[name], 0) if self.kind == "URS" else 0))

    def turned(self, angle):
        """F^ R(angle), a turn about -u."""
        x, y, z = self.fixed
        c, s = mp.cos(angle), mp.sin(angle)
        return [add(scaled(c, x), scaled(s, z)), y, add(scaled(-s, x), scaled(c, z))]

    def at(self, point):
        """Coordinates, (mass centre, frame) of both links, and the margins by which the leg reaches `point`."""
        k = times(transposed(self.fixed), minus(point, self.a))
        away = mp.hypot(k[0], k[2])
        return getattr(self, self.kind.lower())(k, away)

    def link(self, x, along, start, center):
        return add(start, scaled(center, along)), [x, cross(along, x), along]

    def urs(self, k, away):
        l, s, q = self.proximal.length, self.distal.length, norm(k)
        cosine = (l**2 + s**2 - q**2) / (2 * l * s)
        if abs(cosine) >= 1:
            raise OutOfReach("URS: stretched or folded")
        theta = self.knee * mp.acos(cosine)
        phi = mp.atan2(-k[0], k[2])
        psi = mp.atan2(s * mp.sin(theta), l - s * mp.cos(theta)) + mp.atan2(away, k[1])
        frame = self.turned(phi)
        e = times(frame, [mpf(0), mp.cos(psi), mp.sin(psi)])
        rod = times(frame, [mpf(0), -mp.cos(psi + theta), -mp.sin(psi + theta)])
        knee = add(self.a, scaled(l, e))
        links = [self.link(frame[0], e, self.a, self.proximal.center), self.link(frame[0], rod, knee, self.distal.center)]
        return [phi, psi, theta], links, {"|sin theta|": abs(mp.sin(theta)), "off the axis, m": away}

    def ups(self, k, away):
        l, s, d = self.proximal.length, self.distal.length, norm(k)
        if not s < d < s + l:
            raise OutOfReach(f"UPS: d = {mp.nstr(d, 6)} is not within the stroke")
        phi, psi = mp.atan2(-k[0], k[2]), mp.atan2(away, k[1])
        frame = self.turned(phi)
        e = times(frame, [mpf(0), mp.cos(psi), mp.sin(psi)])
        inner_end = add(self.a, scaled(d - s, e))
        links = [self.link(frame[0], e, self.a, self.proximal.center), self.link(frame[0], e, inner_end, self.distal.center)]
        return [phi, psi, d], links, {"d - s, m": d - s, "s + l - d, m": s + l - d, "|sin psi|": mp.sin(psi)}

    def rus(self, k, away):
        l, s = self.proximal.length, self.distal.length
        sine = k[1] / s
        if abs(sine) >= 1:
            raise OutOfReach("RUS: too far along the axis")
        theta = mp.asin(sine)
        across = s * mp.cos(theta)  # the rod as seen along the axis
        cosine = (away**2 - l**2 - across**2) / (2 * l * across)
        if abs(cosine) >= 1:
            raise OutOfReach("RUS: crank and rod do not meet")
        psi = self.knee * mp.acos(cosine)
        phi = wrapped(mp.atan2(-k[0], k[2]) - mp.atan2(across * mp.sin(psi), l + across * mp.cos(psi)))
        crank, upper = self.turned(phi), self.turned(phi + psi)
        rod = times(upper, [mpf(0), mp.sin(theta), mp.cos(theta)])
        knee = add(self.a, scaled(l, crank[2]))
        links = [self.link(crank[0], crank[2], self.a, self.proximal.center), self.link(upper[0], rod, knee, self.distal.center)]
        return [phi, psi, theta], links, {"|sin psi|": abs(mp.sin(psi)), "cos theta": mp.cos(theta)}

    def pus(self, k, away):
        s = self.distal.length
        if away >= s:
            raise OutOfReach("PUS: too far from the rail")
        theta = mp.acos(self.knee * mp.sqrt(1 - (away / s) ** 2))
        d = k[1] - s * mp.cos(theta)
        psi = mp.atan2(-k[0], k[2])
        frame, u = self.turned(psi), self.fixed[1]
        rod = times(frame, [mpf(0), mp.cos(theta), mp.sin(theta)])
        carriage = add(self.a, scaled(d, u))
        links = [(add(carriage, scaled(self.proximal.center, u)), self.fixed), self.link(frame[0], rod, carriage, self.distal.center)]
        return [d, psi, theta], links, {"|cos theta|": abs(mp.cos(theta)), "sin theta": mp.sin(theta)}


class Machine:
    def __init__(self, scenario):
        keys, load = scenario["manipulator"], scenario.get("load", {})
        if "file" in load or "table" in load:
            raise ValueError("only constant loads")
        platform = keys["platform"]
        self.gravity = vector(keys.get("gravity", [0.0, 0.0, -9.81]))
        self.rho = vector(platform["center_of_mass"])
        self.legs = [Leg(keys.get("leg_defaults", {}) | leg) for leg in keys["leg"]]
        self.masses, self.inertias = [mpf(platform["mass"])], [tensor(platform["inertia"])]
        for leg in self.legs:
            self.masses += [leg.proximal.mass, leg.distal.mass]
            self.inertias += [leg.proximal.inertia, leg.distal.inertia]
        self.force, self.moment, self.point = (vector(load.get(key, [0, 0, 0])) for key in ("force", "moment", "point"))
        self.load_on_platform = load.get("frame", "base") == "platform"
        self.names = [name for leg in self.legs for name in leg.coordinates]
        self.motors = [(i, leg.coordinates.index(name)) for i, leg in enumerate(self.legs) for name in leg.actuated]
        if len(self.motors) != 6:
            raise ValueError(f"{len(self.motors)} motors")

    def motor_rows(self):
        """The places of the motors' coordinates among all of them."""
        return [3 * leg + k for leg, k in self.motors]

    def at(self, pose):
        """All coordinates; mass centre and frame of every body, the platform first; the legs' margins."""
        p, turn_of_platform = pose
        coordinates, bodies, margins = [], [(add(p, times(turn_of_platform, self.rho)), turn_of_platform)], []
        for i, leg in enumerate(self.legs):
            try:
                q, links, margin = leg.at(add(p, times(turn_of_platform, leg.b)))
            except OutOfReach as why:
                raise OutOfReach(f"leg {i + 1}: {why}") from None
            coordinates += q
            bodies += links
            margins.append(margin)
        return coordinates, bodies, margins


# Differences.


def first(values):
    """Derivatives from five values that are STEP apart."""
    return (8 * (values[3] - values[1]) - (values[4] - values[0])) / (12 * STEP)


def second(values):
    return (16 * (values[1] + values[3]) - (values[0] + values[4]) - 30 * values[2]) / (12 * STEP**2)


def entrywise(difference, vectors):
    return [difference(values) for values in zip(*vectors)]


def columnwise(difference, matrices):
    return [entrywise(difference, columns) for columns in zip(*matrices)]


def unwrapped(names, rows):
    """Turning coordinates without jumps by a full turn."""
    full, middle = 2 * mp.pi, rows[2]
    return [[q - full * mp.nint((q - ref) / full) if name != "d" else q for name, q, ref in zip(names, row, middle)] for row in rows]


def turning(frames):
    """Angular velocity and acceleration of a frame."""
    back = transposed(frames[2])
    return (skew_part(product(columnwise(first, frames), back)), skew_part(product(columnwise(second, frames), back)))


class Instant:
    """All results at one instant."""

    def __init__(self, machine, motion, t):
        self.t = mpf(t)
        pose = motion(self.t)
        poses = [pose(self.t + k * STEP) for k in range(-2, 3)]
        states = [machine.at(each) for each in poses]
        self.p, self.frame = poses[2]
        self.v = entrywise(first, [each[0] for each in poses])
        self.a = entrywise(second, [each[0] for each in poses])
        self.w, self.alpha = turning([each[1] for each in poses])
        rows = unwrapped(machine.names, [state[0] for state in states])
        self.q, self.q_dot, self.q_ddot = states[2][0], entrywise(first, rows), entrywise(second, rows)
        self.margins = states[2][2]
        self.jacobian, right = [], []
        wrenches = [self.inertial(machine, b, [state[1][b] for state in states]) for b in range(len(machine.masses))]
        for direction in range(6):
            q, bodies, platform = self.displacement(machine, direction)
            work = sum(dot(force, c) + dot(moment, theta) for (force, moment), (c, theta) in zip(wrenches, bodies))
            work += self.frictional(machine, q) + self.external(machine, *platform)
            self.jacobian.append([q[row] for row in machine.motor_rows()])
            right.append(-work)
        self.tau = list(mp.lu_solve(mp.matrix(self.jacobian), mp.matrix(right)))

    @staticmethod
    def inertial(machine, b, places):
        """The force and moment of weight and inertia on body b."""
        acceleration = entrywise(second, [c for c, _ in places])
        frames = [frame for _, frame in places]
        w, alpha = turning(frames)
        turned = lambda v: times(frames[2], times(machine.inertias[b], times(transposed(frames[2]), v)))
        force = scaled(machine.masses[b], minus(machine.gravity, acceleration))
        return force, scaled(-1, add(turned(alpha), cross(w, turned(w))))

    def displacement(self, machine, direction):
        """Displacements of coordinates, bodies (mass centre, turn) and platform (P, turn), for a unit shift or turn of the platform."""
        poses = []
        for k in range(-2, 3):
            if direction < 3:
                p = list(self.p)
                p[direction] += k * STEP
                poses.append((p, self.frame))
            else:
                poses.append((self.p, product(turn(direction - 3, k * STEP), self.frame)))
        states = [machine.at(each) for each in poses]
        of_bodies = [(entrywise(first, [state[1][b][0] for state in states]), self.turn_of([state[1][b][1] for state in states]))
                     for b in range(len(machine.masses))]
        of_platform = entrywise(first, [each[0] for each in poses]), self.turn_of([each[1] for each in poses])
        return entrywise(first, unwrapped(machine.names, [state[0] for state in states])), of_bodies, of_platform

    @staticmethod
    def turn_of(frames):
        return skew_part(product(columnwise(first, frames), transposed(frames[2])))

    def frictional(self, machine, q):
        """Virtual work of friction in every joint."""
        work = mpf(0)
        for i, leg in enumerate(machine.legs):
            for k in range(3):
                rate = self.q_dot[3 * i + k]
                work -= (leg.viscous[k] * rate + leg.coulomb[k] * mp.tanh(rate / leg.smoothing_speed)) * q[3 * i + k]
        return work

    def external(self, machine, shift, turned):
        force, moment = machine.force, machine.moment
        if machine.load_on_platform:
            force, moment = times(self.frame, force), times(self.frame, moment)
        arm = times(self.frame, machine.point)
        return dot(force, add(shift, cross(turned, arm))) + dot(moment, turned)

    def orientation(self):
        """The quaternion with w >= 0, from its largest entry."""
        (xx, yx, zx), (xy, yy, zy), (xz, yz, zz) = self.frame
        squares = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz]
        largest = max(range(4), key=lambda k: squares[k])
        rows = [[squares[0], zy - yz, xz - zx, yx - xy], [zy - yz, squares[1], yx + xy, xz + zx],
                [xz - zx, yx + xy, squares[2], zy + yz], [yx - xy, xz + zx, zy + yz, squares[3]]]
        q = scaled(1 / (2 * mp.sqrt(squares[largest])), rows[largest])
        return q if q[0] >= 0 else scaled(-1, q)

    def condition(self, machine):
        """The condition number of the map from the platform's twist to the motors' rates; turns count times a length of the platform."""
        length = mp.sqrt(sum(dot(leg.b, leg.b) for leg in machine.legs) / len(machine.legs))
        rows = [[q / (length if direction >= 3 else 1) * (length if leg_coordinate(machine, motor) != "d" else 1)
                 for direction, q in enumerate(column)] for motor, column in enumerate(transposed(self.jacobian))]
        singular = mp.svd_r(mp.matrix(rows), compute_uv=False)
        return max(singular) / min(singular)


def leg_coordinate(machine, motor):
    leg, k = machine.motors[motor]
    return machine.legs[leg].coordinates[k]


# Files.


def columns(machine, at):
    """Names and values of one row."""
    out = [("t_s", at.t)]
    out += [(f"p_{axis}_m", value) for axis, value in zip("xyz", at.p)]
    out += [(f"q_{axis}", value) for axis, value in zip("wxyz", at.orientation())]
    for name, unit, values in (("w", "rad_s", at.w), ("v", "m_s", at.v), ("alpha", "rad_s2", at.alpha), ("a", "m_s2", at.a)):
        out += [(f"{name}_{axis}_{unit}", value) for axis, value in zip("xyz", values)]
    for name in NAMES:
        unit = "m" if name == "d" else "rad"
        for dots, per, values in (("", "", at.q), ("dot", "_s", at.q_dot), ("ddot", "_s2", at.q_ddot)):
            out += [(f"{name}{dots}_{k // 3 + 1}_{unit}{per}", values[k]) for k, each in enumerate(machine.names) if each == name]
    for motor, tau in enumerate(at.tau):
        out.append((f"tau_{motor + 1}_{'N' if leg_coordinate(machine, motor) == 'd' else 'Nm'}", tau))
    return out


def written(name, value):
    if name == "t_s":
        return repr(float(value))
    return "0.0" if abs(value) < ZERO else mp.nstr(value, DIGITS)


def instants(duration, count, inside):
    """Equally spaced instants; `inside` keeps away from the ends, where rates and accelerations are zero, and takes exact binary fractions."""
    if inside:
        return [round(1024 * float(duration) * (k + 0.5) / count) / 1024 for k in range(count)]
    return [float(duration) * k / (count - 1) for k in range(count)]


def load(path):
    scenario = tomllib.loads(Path(path).read_text(), parse_float=str)  # numbers as they are written, not as doubles
    return Machine(scenario), *motion_of(scenario["trajectory"])


def write(path, at, count, out):
    machine, duration, motion = load(path)
    rows = [columns(machine, Instant(machine, motion, t)) for t in at or instants(duration, count, True)]
    text = ",".join(name for name, _ in rows[0]) + "\n" + "".join(",".join(written(*cell) for cell in row) + "\n" for row in rows)
    if out:
        Path(out).write_text(text)
    else:
        sys.stdout.write(text)


def compare(path, other):
    """The number of digits in which the file agrees, relative to the largest value in each group of columns."""
    machine, _, motion = load(path)
    with open(other, newline="") as file:
        theirs = list(csv.DictReader(file))
    worst = {}
    for row in theirs:
        ours = dict(columns(machine, Instant(machine, motion, row["t_s"])))
        if ours.keys() != row.keys():
            raise ValueError(f"{other}: columns differ: {sorted(ours.keys() ^ row.keys())}")
        groups = {}
        for name, value in ours.items():
            groups.setdefault(name.split("_")[0], []).append((value, mpf(row[name])))
        for name, pairs in groups.items():
            size = max(abs(value) for value, _ in pairs)
            apart = max(abs(a - b) for a, b in pairs)
            digits = -mp.log10(apart / size) if size > ZERO and apart else -mp.log10(apart) if apart else mpf(99)
            worst[name] = min(worst.get(name, digits), digits)
    print(f"{path}: digits of agreement: " + ", ".join(f"{name} {mp.nstr(digits, 3)}" for name, digits in worst.items()))


def check(path, count):
    """Prints how far the motion stays from the limits, how well conditioned it is and the largest efforts."""
    machine, duration, motion = load(path)
    margins, kappa, efforts = {}, (mpf(0), 0), [mpf(0)] * 6
    for t in instants(duration, count, False):
        at = Instant(machine, motion, t)
        for i, margin in enumerate(at.margins):
            for name, value in margin.items():
                key = f"{machine.legs[i].kind} {name}"
                margins[key] = min(margins.get(key, (value, i, t)), (value, i, t))
        kappa = max(kappa, (at.condition(machine), t))
        efforts = [max(old, abs(new)) for old, new in zip(efforts, at.tau)]
    print(f"{path}: {count} instants to {mp.nstr(duration, 5)} s")
    for name, (value, leg, t) in margins.items():
        print(f"  smallest {name}: {mp.nstr(value, 4)} (leg {leg + 1}, t = {t:.3f} s)")
    print(f"  condition number: {mp.nstr(kappa[0], 4)} (t = {kappa[1]:.3f} s)")
    print("  largest efforts: " + ", ".join(f"{mp.nstr(tau, 5)} {'N' if leg_coordinate(machine, k) == 'd' else 'N·m'}"
                                            for k, tau in enumerate(efforts)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--at", nargs="+", type=float, help="instants, s")
    parser.add_argument("--count", type=int)
    parser.add_argument("--out")
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    try:
        if given.compare:
            compare(*given.files)
        elif given.check:
            for path in given.files:
                check(path, given.count or 61)
        else:
            write(given.files[0], given.at, given.count or 7, given.out)
    except OutOfReach as why:
        sys.exit(f"out of reach: {why}")


if __name__ == "__main__":
    main()
