"""Wrong solvers by further mistakes of the literature, in the form of wrong.py; what is expected was decided before any
answer. What a model leaves out on purpose (lumped masses) has no name of its own: silence is right there."""

import numpy as np

from hexapod import Hexapod, dot, mv, rot
from wrong import MT, RP, K, add


def motion(change):
    """Another motion is asked of the right solver."""

    class Motion:
        def __init__(self, m):
            for name in ("t", "p", "q", "v", "w", "a", "alpha"):
                setattr(self, name, np.array(getattr(m, name), float))

    def make(d, s):
        right = Hexapod(d)

        def solver(m):
            other = Motion(m)
            change(other)
            return right(other)
        return solver
    return make


def rpy_rates(m):
    """Roll, pitch, yaw: their rates where the angular velocity belongs, their second rates where its rate does."""
    R = rot(m.q)
    pitch, yaw = np.arcsin(-R[:, 2, 0]), np.arctan2(R[:, 1, 0], R[:, 0, 0])

    def E(pitch, yaw):
        zero = np.zeros_like(pitch)
        x = np.stack([np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), -np.sin(pitch)], -1)
        y = np.stack([-np.sin(yaw), np.cos(yaw), zero], -1)
        return np.stack([x, y, np.stack([zero, zero, zero + 1], -1)], -1)

    rates = np.linalg.solve(E(pitch, yaw), m.w[..., None])[..., 0]
    cp, sp, cy, sy = np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
    dp, dy, zero = rates[:, 1], rates[:, 2], np.zeros_like(pitch)
    dx = np.stack([-sy * cp * dy - cy * sp * dp, cy * cp * dy - sy * sp * dp, -cp * dp], -1)
    dE = np.stack([dx, np.stack([-cy * dy, -sy * dy, zero], -1), np.zeros_like(dx)], -1)
    second = np.linalg.solve(E(pitch, yaw), (m.alpha - mv(dE, rates))[..., None])[..., 0]
    m.w, m.alpha = rates, second


def products(machine, d):
    inertia = list(machine["platform"]["inertia"])
    machine["platform"]["inertia"] = inertia[:3] + [-x for x in inertia[3:]]


def other_knee(machine, d):
    leg = machine["leg"][2]
    knee = leg.get("knee", machine.get("leg_defaults", {}).get("knee", "positive"))
    leg["knee"] = "negative" if knee == "positive" else "positive"


def lumped(machine, d):
    """Rods as two half masses at their ends."""
    for leg in machine["leg"]:
        rod = leg["distal"]
        rod["center_of_mass"] = rod["length"] / 2
        moment = rod["mass"] * rod["length"] ** 2 / 4
        rod["inertia"] = [moment, moment, 1e-9 * moment]


def undivided(d, s):
    """d-dot = s.v / s.u of a carriage without the division: efforts by the rods' lines alone."""
    h = Hexapod(d)

    def solver(m):
        tau, R = h(m), rot(np.array(m.q, float))
        for i, L in enumerate(h.legs):
            B = np.array(m.p, float) + mv(R, L["b"])
            leg = {k: np.array([v]) if k in ("l", "s", "knee") else v for k, v in L.items()}
            _, bodies = h.displacement(leg, B)
            tau[:, i] /= dot(bodies[1][2], np.broadcast_to(L["u"], B.shape))[:, 0]
        return tau
    return solver


add('UPS RUS', 'euler-rates', 'rates of roll, pitch, yaw taken for the angular velocity',
    [K('frame', term=('angular_velocity', 'angular_acceleration'))], motion(rpy_rates))
add('UPS PUS', 'products', 'products of inertia with the sign that CAD gives them',
    [K('parameter', parameter='manipulator.platform.inertia*'), K('sign', term='inertia', body='platform')], params=products)
add('UPS', 'leg-alpha', 'angular acceleration of the legs without 2 d-dot w / d', [MT(('coriolis', 'centripetal'), body='legs')],
    leg_alpha=True)
add('UPS', 'rod-fixed', 'mass centre of the rod at a fixed distance from the base', None, rod_fixed=1.5)
add('RUS', 'lumped', 'rods as half masses at their ends', [K('parameter', parameter='*distal.inertia*'), K('reference_point', body='distal')],
    params=lumped)
add('RUS URS', 'gyro-mixed', 'gyroscopic moment of the platform with the tensor of its own frame',
    [K('frame', term='gyroscopic', body='platform'), K('frame', term='inertia', body='platform')], gyro_mixed=True)
add('PUS', 'grav-carriage', 'gravity of the carriages left out', [MT('gravity', body='proximal')], no_gravity='proximal')
add('URS PUS', 'bias-sign', 'w x (w x b) with the wrong sign in the accelerations of the tips', [K('closure', term='bias')],
    bias_sign=True)
add('URS', 'knee', 'the other knee of leg 3', [K('parameter', parameter='manipulator.leg.3.knee')], params=other_knee)
add('PUS', 'undivided', 'rates of the carriages without the division by s.u', [K('jacobian')], undivided)
add('UPS URS', 'single-within', 'rotation and platform forces in single precision within', [K('digits')], single=True)
add('RUS', 'steiner-prox', 'proximal tensor with the parallel axis term added', RP('proximal'), link_tensor_steiner='proximal')
