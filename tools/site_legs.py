"""Drawings of a leg of each kind with its frames, points, coordinates and signs, from its geometry: SVG files.

The geometry is that of the table of kinds in docs/conventions.md and not the program's; tests/site compares it with
`ursula poses`.
"""

import math

import numpy as np

PROXIMAL, DISTAL, ANGLE, AXIS, FRAME, GREY = "#1f5fa8", "#c25700", "#8e2f8e", "#b00020", "#1b7a3d", "#666"
SIZE = (700, 560)


def turn(phi):
    """R of (1): columns are x, û, z turned by φ about −û."""
    c, s = math.cos(phi), math.sin(phi)
    return np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])


def fixed_frame(u):
    """F̂ of (2a): columns x̂, û, ẑ; for an axis along e_z the seed is e_y."""
    u = np.asarray(u, float) / np.linalg.norm(u)
    x = np.cross(u, [0, 0, 1])
    if x @ x < 1e-20:
        x = np.cross(u, [0, 1, 0])
    x /= np.linalg.norm(x)
    return np.column_stack([x, u, np.cross(x, u)])


def in_plane(F, psi):
    return F @ [0, math.cos(psi), math.sin(psi)]


def link_frame(x, along):
    """[x, along × x, along], as (40)."""
    return np.column_stack([x, np.cross(along, x), along])


def leg(kind, A, u, B, l, s, knee=1):
    """The content of a drawing: coordinates, points A, R, B, directions of the links, frames, the fixed frame and the turned one."""
    A, B = np.asarray(A, float), np.asarray(B, float)
    F_hat = fixed_frame(u)
    k = F_hat.T @ (B - A)
    r = math.hypot(k[0], k[2])
    phi = math.atan2(-k[0], k[2])
    F = F_hat @ turn(phi)
    out = {"A": A, "B": B, "F_hat": F_hat}
    if kind == "UPS":
        psi, d = math.atan2(r, k[1]), float(np.linalg.norm(k))
        e = in_plane(F, psi)
        out |= {"phi": phi, "psi": psi, "d": d, "e": e, "s": e, "F": F, "R": A + (d - s) * e, "proximal_end": A + l * e, "x1": F[:, 0], "x2": F[:, 0]}
    elif kind == "URS":
        q = np.linalg.norm(k)
        theta = knee * math.acos((l * l + s * s - q * q) / (2 * l * s))
        psi = math.atan2(s * math.sin(theta), l - s * math.cos(theta)) + math.atan2(r, k[1])
        e = in_plane(F, psi)
        out |= {"phi": phi, "psi": psi, "theta": theta, "e": e, "s": -in_plane(F, psi + theta), "F": F, "R": A + l * e, "x1": F[:, 0], "x2": F[:, 0]}
    elif kind == "RUS":
        theta = math.asin(k[1] / s)
        rod = s * math.cos(theta)
        psi = knee * math.acos((r * r - l * l - rod * rod) / (2 * l * rod))
        phi -= math.atan2(rod * math.sin(psi), l + rod * math.cos(psi))
        F, F2 = F_hat @ turn(phi), F_hat @ turn(phi + psi)
        e = F[:, 2]
        out |= {"phi": phi, "psi": psi, "theta": theta, "e": e, "s": F2 @ [0, math.sin(theta), math.cos(theta)], "F": F, "F2": F2, "R": A + l * e,
                "x1": F[:, 0], "x2": F2[:, 0]}
    else:  # PUS: the carriage keeps the fixed frame's axes
        along = knee * math.sqrt(s * s - r * r)
        theta = math.atan2(r, along)
        d = k[1] - along
        out |= {"d": d, "psi": phi, "theta": theta, "e": F_hat[:, 1], "s": in_plane(F, theta), "F": F, "R": A + d * F_hat[:, 1], "x1": F_hat[:, 0],
                "x2": F[:, 0]}
    return out


class Drawing:
    def __init__(self, centre, scale, azimuth=-58, elevation=18):
        a, h = math.radians(azimuth), math.radians(elevation)
        forward = np.array([math.cos(h) * math.cos(a), math.cos(h) * math.sin(a), math.sin(h)])
        self.right = np.array([-math.sin(a), math.cos(a), 0])
        self.up = np.cross(forward, self.right)
        self.centre, self.scale, self.parts = np.asarray(centre), scale, []

    def at(self, point):
        off = np.asarray(point) - self.centre
        return SIZE[0] / 2 + self.scale * float(off @ self.right), SIZE[1] / 2 - self.scale * float(off @ self.up)

    def line(self, points, color, width=2.0, dash="", head=False):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, points))
        marks = f' marker-end="url(#head-{color[1:]})"' if head else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}" stroke-linecap="round"'
                          f'{f" stroke-dasharray={dash!r}" if dash else ""}{marks}/>'.replace("'", '"'))

    def text(self, point, words, color, dx=8, dy=-6):
        x, y = self.at(point)
        self.parts.append(f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{color}">{words}</text>')

    def arrow(self, start, direction, length, color, words, width=1.8, dash="", dx=6, dy=-5):
        end = start + length * direction
        self.line([start, end], color, width, dash, head=True)
        self.text(end, words, color, dx, dy)

    def dot(self, point, words, dx=9, dy=16):
        x, y = self.at(point)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="#fff" stroke="#111" stroke-width="2"/>')
        self.text(point, words, "#111", dx, dy)

    def arc(self, centre, start, end, radius, words, dx=4, dy=-4):
        """An arc from one unit direction to the other, in the direction in which the coordinate grows."""
        angle = math.acos(float(np.clip(start @ end, -1, 1)))
        normal = np.cross(np.cross(start, end), start)
        normal = normal / np.linalg.norm(normal)
        points = [centre + radius * (math.cos(angle * k / 24) * start + math.sin(angle * k / 24) * normal) for k in range(25)]
        self.line(points, ANGLE, 2.2, head=True)
        self.text(points[12], words, ANGLE, dx, dy)

    def svg(self, title):
        heads = "".join(f'<marker id="head-{color[1:]}" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="6" markerHeight="6" orient="auto-start-reverse">'
                        f'<path d="M0 0 8 4 0 8z" fill="{color}"/></marker>' for color in (PROXIMAL, DISTAL, ANGLE, AXIS, FRAME, GREY))
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE[0]} {SIZE[1]}" role="img" font-family="sans-serif" font-size="17">'
                f'<title>{title}</title><defs>{heads}</defs><rect width="100%" height="100%" fill="#fff"/>{"".join(self.parts)}</svg>\n')


# The drawn leg of each kind: the place of B, and the lengths of the links.
LEGS = {
    "URS": dict(B=(-0.75, 0.75, 1.0), l=0.95, s=0.9),
    "UPS": dict(B=(-0.80, 0.50, 0.95), l=0.78, s=0.85),
    "RUS": dict(B=(-1.0, 0.45, 0.85), l=0.65, s=0.95),
    "PUS": dict(B=(-0.60, 1.15, 0.85), l=0.3, s=1.25),
}
TITLES = {"URS": "A U-R-S leg, the paper's", "UPS": "A U-P-S leg, telescopic", "RUS": "An R-U-S leg, crank and rod", "PUS": "A P-U-S leg, carriage and rod"}


def draw(kind):
    spec = LEGS[kind]
    of = leg(kind, (0, 0, 0), (0, 1, 0), spec["B"], spec["l"], spec["s"])
    A, R, B, e, s, F_hat, F = (of[key] for key in ("A", "R", "B", "e", "s", "F_hat", "F"))
    x_hat, u, z_hat = F_hat.T
    on = Drawing((-0.3, 0.42, 0.5), 320)
    on.line([A - 0.45 * u, A + 1.35 * u], AXIS, 1.6, "9 5", head=True)
    on.text(A + 1.35 * u, "û, the base axis", AXIS, -40, 26)
    on.arrow(A, x_hat, 0.5, GREY, "x̂")
    on.arrow(A, z_hat, 0.62, GREY, "ẑ")
    turned = kind != "PUS"
    at = A if turned else R
    if kind == "UPS":
        end = of["proximal_end"]
        on.line([A, end], PROXIMAL, 13)
        on.line([R, B], DISTAL, 5)
        on.dot(R, "rod's inner end, A + (d − s) e", -292, 14)
        on.text(end, "cylinder's end, A + l e", PROXIMAL, -210, 2)
        on.arrow(B, e, 0.2, DISTAL, "+d: the motor pushes", 4)
    else:
        on.line([A, R] if turned else [R - 0.12 * u, R + 0.12 * u], PROXIMAL, 8 if turned else 16)
        on.line([R, B], DISTAL, 6)
        on.dot(R, "R", 12, 14)
    frames(on, of, kind)
    if kind != "RUS":
        on.arrow(at, F[:, 2], 0.55, GREY, "z", dash="4 4", dx=-16)
    angles(on, of, kind)
    on.dot(A, "A", -22, 18)
    on.dot(B, "B", 12, 6)
    return on.svg(TITLES[kind])


def frames(on, of, kind):
    """The axes of the frames in which the links' inertias are given."""
    A, R, B, e, s = (of[key] for key in ("A", "R", "B", "e", "s"))
    links = [(A + 0.55 * (R - A) if kind in ("URS", "RUS") else A if kind == "UPS" else R, of["x1"], e, "e")]
    if kind == "UPS":
        links = [(A + 1.03 * e, of["x1"], e, "e")]
    else:
        links.append((R + 0.55 * (B - R), of["x2"], s, "s"))
    for origin, x, along, name in links:
        if kind == "PUS" and name == "e":
            continue  # its axes are x̂, û, ẑ
        first, second, third = link_frame(x, along).T
        on.arrow(origin, first, 0.24, FRAME, "x" if "F2" not in of or name == "e" else "x₂", dx=-2, dy=16)
        on.arrow(origin, second, 0.24, FRAME, f"{name} × x" if "F2" not in of or name == "e" else "s × x₂")
        on.arrow(origin, third, 0.24, FRAME, name)


def angles(on, of, kind):
    A, R, e, s, F_hat, F = (of[key] for key in ("A", "R", "e", "s", "F_hat", "F"))
    u, z_hat = F_hat[:, 1], F_hat[:, 2]
    if kind == "PUS":
        on.line([A - 0.1 * z_hat, R - 0.1 * z_hat], ANGLE, 2.2, head=True)
        on.text((A + R) / 2 - 0.1 * z_hat, "d", ANGLE, -4, 24)
        on.arrow(R, z_hat, 0.5, GREY, "ẑ")
        on.arc(R, z_hat, F[:, 2], 0.44, "ψ", -8, -8)
        on.arc(R, u, s, 0.3, "θ", 6, -2)
        return
    on.arc(A, z_hat, F[:, 2], 0.47, "φ", -4, -8)
    if kind == "RUS":
        on.arrow(R, e, 0.5, GREY, "z of F", dash="4 4")
        on.arrow(R, of["F2"][:, 2], 0.5, GREY, "z₂", dash="4 4", dx=-20)
        on.arc(R, e, of["F2"][:, 2], 0.4, "ψ", 2, -8)
        on.arc(R, of["F2"][:, 2], s, 0.5, "θ", 2, -8)
        return
    on.arc(A, u, e, 0.33, "ψ", 8, 0)
    if kind == "URS":
        on.arc(R, -e, s, 0.25, "θ", -18, 4)
    else:
        side = 0.3 * of["F"][:, 0]
        on.line([A + side, of["B"] + side], ANGLE, 2.0, head=True)
        on.text(A + 0.9 * of["d"] * e + side, "d", ANGLE, 12, 0)


def write(folder):
    (folder / "pictures").mkdir(exist_ok=True)
    for kind in LEGS:
        (folder / "pictures" / f"leg_{kind}.svg").write_text(draw(kind), encoding="utf-8")
