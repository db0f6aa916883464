"""Motor torques of a U-R-S manipulator by virtual work: a solver of one's own, in NumPy and nothing else.

It reads machine and gravity from a scenario's file and has a route of its own, without joint angles: each leg's rates
come of the velocity of its end, and the inertia forces of all bodies are brought to the platform. Without friction and
without a load. Vectors are (3, N, 6): component, instant, leg.
"""

import tomllib

import numpy as np


def cross(a, b):
    return a[[1, 2, 0]] * b[[2, 0, 1]] - a[[2, 0, 1]] * b[[1, 2, 0]]


def dot(a, b):
    return (a * b).sum(axis=0)


def tensor(entries):
    xx, yy, zz, xy, xz, yz = (*entries, 0.0, 0.0, 0.0)[:6]
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


class Machine:
    def __init__(self, scenario):
        with open(scenario, "rb") as file:
            machine = tomllib.load(file)["manipulator"]
        defaults = machine.get("leg_defaults", {})
        legs = [{**defaults, **leg} for leg in machine["leg"]]
        if any(leg.get("kind", "URS") != "URS" or "friction" in leg or "coulomb" in leg for leg in legs):
            raise ValueError("this example knows legs of kind URS without friction only")
        self.gravity = np.array(machine.get("gravity", [0.0, 0.0, -9.81]))
        self.a = np.array([leg["base_point"] for leg in legs]).T
        axis = np.array([leg["base_axis"] for leg in legs]).T
        self.u = axis / np.sqrt(dot(axis, axis))
        self.b = np.array([leg["platform_point"] for leg in legs]).T
        self.knee = np.array([1.0 if leg.get("knee", "positive") == "positive" else -1.0 for leg in legs])
        self.links = [Links([leg[link] for leg in legs]) for link in ("proximal", "distal")]
        self.mass = machine["platform"]["mass"]
        self.center = np.array(machine["platform"]["center_of_mass"])
        self.inertia = tensor(machine["platform"]["inertia"])


class Links:
    """One link of each leg."""

    def __init__(self, links):
        self.length, self.mass, self.center = (
            np.array([link[key] for link in links]) for key in ("length", "mass", "center_of_mass"))
        self.inertia = np.array([tensor(link["inertia"]) for link in links])


def rotation(q):
    """(N, 3, 3) from unit quaternions [w, x, y, z]."""
    w, x, y, z = q.T
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)


def inertia_torque(inertia, axes, omega, omega_dot):
    """I ω̇ + ω × I ω for tensors in the frames whose axes are given."""
    frames = np.stack(axes, axis=-1)  # (3, N, 6, 3)

    def times(vector):
        local = np.einsum("jnlk,jnl->nlk", frames, vector)
        return np.einsum("jnlk,nlk->jnl", frames, np.matmul(inertia, local[..., None])[..., 0])

    return times(omega_dot) + cross(omega, times(omega))


def torques(machine, p, q, v, w, a, alpha):
    """(N, 6), N m, for p, v, w, a, alpha of shape (N, 3), q (N, 4): pose, twist and twist rate in B."""
    Q = rotation(q)
    p, v, w, a, alpha = (each.T[:, :, None] for each in (p, v, w, a, alpha))
    proximal, distal = machine.links
    u = np.broadcast_to(machine.u[:, None, :], (3, len(q), 6))
    arm = np.einsum("nij,jl->inl", Q, machine.b)
    r = p + arm - machine.a[:, None, :]
    v_B = v + cross(w, arm)
    a_B = a + cross(alpha, arm) + cross(w, cross(w, arm))

    # The leg's plane holds u and B; x is its normal. In it a triangle of l, s and |r|.
    along = dot(r, u)
    z = r - u * along
    across = np.sqrt(dot(z, z))
    z = z / across
    x = cross(u, z)
    l, s = proximal.length, distal.length
    cosine = (l * l + s * s - along**2 - across**2) / (2 * l * s)
    sine = machine.knee * np.sqrt(1 - cosine * cosine)
    psi = np.arctan2(across, along) + np.arctan2(s * sine, l - s * cosine)
    e = np.cos(psi) * u + np.sin(psi) * z
    e_turned = np.cos(psi) * z - np.sin(psi) * u  # x × e
    d = -cosine * e - sine * e_turned  # from the knee to B
    d_turned = -cosine * e_turned + sine * e  # x × d

    # v_B = −φ̇ u × r + ψ̇ l x × e + χ̇ s x × d, with φ̇ about −u, and both links turning about x.
    def rates(of):
        """(φ̇, ψ̇, χ̇) for a velocity of B: the first from its part along x, the others from those along d and e."""
        return -dot(of, x) / across, dot(of, d) / (l * dot(e_turned, d)), dot(of, e) / (s * dot(d_turned, e))

    phi, psi_rate, chi = rates(v_B)
    turn = -phi * u
    x_rate = cross(turn, x)
    w1, w2 = turn + psi_rate * x, turn + chi * x
    e_rate, d_rate = cross(w1, e), cross(w2, d)
    bias = cross(turn, v_B) + psi_rate * l * (cross(x_rate, e) + cross(x, e_rate)) + chi * s * (
        cross(x_rate, d) + cross(x, d_rate))
    phi_dot, psi_dot, chi_dot = rates(a_B - bias)
    w1_dot = -phi_dot * u + psi_dot * x + psi_rate * x_rate
    w2_dot = -phi_dot * u + chi_dot * x + chi * x_rate
    e_ddot = cross(w1_dot, e) + cross(w1, e_rate)
    d_ddot = cross(w2_dot, d) + cross(w2, d_rate)

    # What each body resists with, at its mass centre.
    g = machine.gravity[:, None, None]
    f1 = proximal.mass * (proximal.center * e_ddot - g)
    f2 = distal.mass * (l * e_ddot + distal.center * d_ddot - g)
    n1 = inertia_torque(proximal.inertia, (x, cross(e, x), e), w1, w1_dot)
    n2 = inertia_torque(distal.inertia, (x, cross(d, x), d), w2, w2_dot)

    # Its work for φ, ψ, χ, and the force at B that does the same: C⁻ᵀ.
    c1, c2 = proximal.center * e, l * e + distal.center * d
    for_phi = -dot(u, cross(c1, f1) + n1 + cross(c2, f2) + n2)
    for_psi = dot(e_turned, proximal.center * f1 + l * f2) + dot(x, n1)
    for_chi = distal.center * dot(d_turned, f2) + dot(x, n2)
    F = (-for_phi / across) * x + (for_psi / (l * dot(e_turned, d))) * d + (for_chi / (s * dot(d_turned, e))) * e

    # All of it at P, with the platform's own.
    rho = np.einsum("nij,j->in", Q, machine.center)[:, :, None]
    a_C = a + cross(alpha, rho) + cross(w, cross(w, rho))
    f = machine.mass * (a_C - g)
    axes = [np.einsum("ni->in", Q[:, :, k])[:, :, None] for k in range(3)]
    n = inertia_torque(machine.inertia, axes, w, alpha)
    moment = (n + cross(rho, f))[:, :, 0] + cross(arm, F).sum(axis=2)
    force = f[:, :, 0] + F.sum(axis=2)

    # φ̇ᵢ = −x·v_B / across: the rows of Jφ; τ does the work of all of it, Jφᵀ τ = W.
    row = -x / across
    J = np.concatenate([cross(arm, row), row])  # (6, N, 6)
    W = np.concatenate([moment, force]).T[:, :, None]
    return np.linalg.solve(J.transpose(1, 0, 2), W)[:, :, 0]
