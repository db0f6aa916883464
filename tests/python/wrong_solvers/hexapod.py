"""Inverse dynamics of six-dof parallel manipulators (URS, UPS, RUS, PUS legs) in plain NumPy, written from the contract's
table alone; every textbook mistake of wrong.py is a flag.

Closed form displacement -> joint axes and points -> unit rate twists, forward recursion for bias accelerations ->
Newton-Euler wrenches -> virtual power."""
import copy
import numpy as np

def cross(a, b):
    a, b = np.broadcast_arrays(a, b)
    o = np.empty(a.shape)
    a0, a1, a2, b0, b1, b2 = a[:, 0], a[:, 1], a[:, 2], b[:, 0], b[:, 1], b[:, 2]
    o[:, 0] = a1 * b2 - a2 * b1
    o[:, 1] = a2 * b0 - a0 * b2
    o[:, 2] = a0 * b1 - a1 * b0
    return o


def dot(a, b):
    return np.sum(a * b, axis=-1, keepdims=True)


def mv(R, v):
    return np.einsum('nij,j->ni', R, v) if v.ndim == 1 else np.einsum('nij,nj->ni', R, v)


def rot(q):
    w, x, y, z = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    return np.stack([np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
                     np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
                     np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1)], 1)


def tensor(v):
    v = list(v) + [0.0] * (6 - len(v))
    xx, yy, zz, xy, xz, yz = v
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def merged(defaults, leg):
    out = copy.deepcopy(defaults)
    for k, v in leg.items():
        if isinstance(v, dict) and isinstance(out.get(k), dict):
            out[k].update(v)
        else:
            out[k] = v
    return out


NAMES = {'URS': ('phi', 'psi', 'theta'), 'UPS': ('phi', 'psi', 'd'), 'RUS': ('phi', 'psi', 'theta'),
         'PUS': ('d', 'psi', 'theta')}
ALIAS = {'actuated': 'phi', 'universal': 'psi', 'knee': 'theta'}
DEFAULT = {'URS': ['phi'], 'UPS': ['d'], 'RUS': ['phi'], 'PUS': ['d']}


class Hexapod:
    def __init__(self, scenario, **flags):
        m = scenario['manipulator']
        self.f = flags
        self.g = np.array(m.get('gravity', [0, 0, -9.81]), float)
        self.mp = m['platform']['mass']
        self.rho = np.array(m['platform']['center_of_mass'], float)
        self.Ip = tensor(m['platform']['inertia'])
        self.legs = []
        for leg in m['leg']:
            L = merged(m.get('leg_defaults', {}), leg)
            kind = L.get('kind', 'URS')
            u = np.array(L['base_axis'], float)
            f, c = L.get('friction', {}), L.get('coulomb', {})
            f = {ALIAS.get(k, k): v for k, v in f.items()}
            c = {ALIAS.get(k, k): v for k, v in c.items()}
            n = NAMES[kind]
            self.legs.append(dict(
                kind=kind, a=np.array(L['base_point'], float), u=u / np.linalg.norm(u),
                b=np.array(L['platform_point'], float), knee=1.0 if L.get('knee', 'positive') == 'positive' else -1.0,
                l=L['proximal'].get('length', 0.0), s=L['distal']['length'],
                mass=(L['proximal']['mass'], L['distal']['mass']),
                com=(L['proximal']['center_of_mass'], L['distal']['center_of_mass']),
                I=(tensor(L['proximal']['inertia']), tensor(L['distal']['inertia'])),
                act=[n.index(x) for x in n if x in [ALIAS.get(y, y) for y in L.get('actuated', DEFAULT[kind])]],
                visc=[f.get(x, 0.0) for x in n], coul=[c.get(x, 0.0) for x in n],
                smooth=c.get('smoothing_speed', 0.01)))
        self.load = scenario.get('load')
        self.cache = {}

    # joints of a leg: list of (type, axis, point); bodies: (number of joints, origin, direction e, x, com distance)
    def displacement(self, L, B):
        N = len(B)
        u = np.broadcast_to(L['u'], (N, 3))
        A = np.broadcast_to(L['a'], (N, 3))
        k = B - A
        ky = dot(k, u)
        perp = k - ky * u
        kr = np.linalg.norm(perp, axis=1, keepdims=True)
        z = perp / kr
        x = cross(u, z)
        l, s = L['l'], L['s']
        plane = lambda c, sn: c * u + sn * z
        kind = L['kind']
        if kind == 'URS':
            d2 = ky ** 2 + kr ** 2
            cth = (d2 - l * l - s * s) / (2 * l * s)
            sth = -L['knee'] * np.sqrt(1 - cth ** 2)
            psi = np.arctan2(kr, ky) - np.arctan2(s * sth, l + s * cth)
            e = plane(np.cos(psi), np.sin(psi))
            th = np.arctan2(sth, cth)
            sv = plane(np.cos(psi + th), np.sin(psi + th))
            Rp = A + l * e
            return ([('R', -u, A), ('R', x, A), ('R', x, Rp)],
                    [(2, A, e, x, L['com'][0]), (3, Rp, sv, x, L['com'][1])])
        if kind == 'UPS':
            d = np.linalg.norm(k, axis=1, keepdims=True)
            e = k / d
            return ([('R', -u, A), ('R', x, A), ('P', e, B)],
                    [(2, A, e, x, L['com'][0]), (3, A + (d - s) * e, e, x, L['com'][1])])
        if kind == 'RUS':
            sth = ky / s
            cth = np.sqrt(1 - sth ** 2)
            r2 = s * cth                       # rod's projection on the crank's plane
            cpsi = (kr ** 2 - l * l - r2 ** 2) / (2 * l * r2)
            spsi = L['knee'] * np.sqrt(1 - cpsi ** 2)
            # direction in the plane: angle phi about -u.  turn(v, a) = v turned by a about -u
            back = np.arctan2(r2 * spsi, l + r2 * cpsi)
            turn = lambda v, a: np.cos(a) * v + np.sin(a) * cross(-u, v)
            e = turn(z, -back)
            z2 = turn(e, np.arctan2(spsi, cpsi))
            x1, x2 = cross(u, e), cross(u, z2)
            Rp = A + l * e
            sv = sth * u + cth * z2
            return ([('R', -u, A), ('R', -u, Rp), ('R', -x2, Rp)],
                    [(1, A, e, x1, L['com'][0]), (3, Rp, sv, x2, L['com'][1])])
        if kind == 'PUS':
            sth = kr / s
            cth = L['knee'] * np.sqrt(1 - sth ** 2)
            d = ky - s * cth
            sv = plane(cth, sth)
            C = A + d * u
            return ([('P', u, C), ('R', -u, C), ('R', x, C)],
                    [(1, C, u, x, L['com'][0]), (3, C, sv, x, L['com'][1])])
        raise ValueError(kind)

    def twist(self, joints, upto, point):
        """unit rate angular velocities and velocities of a point, each N x 3 x upto"""
        W, V = [], []
        for t, n, r in joints[:upto]:
            if t == 'R':
                W.append(n)
                V.append(cross(n, point - r))
            else:
                W.append(np.zeros_like(n))
                V.append(n)
        return np.stack(W, -1), np.stack(V, -1)

    def recursion(self, joints, upto, point, qd, qdd):
        """omega, alpha, acceleration of a body-fixed point after `upto` joints"""
        N = len(point)
        w = np.zeros((N, 3)); al = np.zeros((N, 3)); o = joints[0][2]
        v = np.zeros((N, 3)); a = np.zeros((N, 3))
        for i, (t, n, r) in enumerate(joints[:upto]):
            arm = r - o
            v = v + cross(w, arm)
            a = a + cross(al, arm) + cross(w, cross(w, arm))
            o = r
            q1, q2 = qd[:, i:i + 1], qdd[:, i:i + 1]
            if t == 'R':
                al = al + n * q2 + cross(w, n * q1)
                w = w + n * q1
            else:
                a = a + n * q2 + 2 * cross(w, n * q1)
                v = v + n * q1
        arm = point - o
        return w, al, a + cross(al, arm) + cross(w, cross(w, arm))

    def groups(self, N):
        """legs of a kind together: their rows one below the other, numbers repeated"""
        if N in self.cache:
            return self.cache[N]
        apart = any(k.endswith('_leg') for k in self.f)
        g = {}
        for i, L in enumerate(self.legs, 1):
            g.setdefault((L['kind'], tuple(L['act']), i if apart else 0), []).append(i)
        out = []
        for (kind, act, _), idx in g.items():
            Ls = [self.legs[i - 1] for i in idx]
            rep = lambda f: np.repeat(np.array([f(L) for L in Ls], float), N, axis=0)
            out.append((idx, dict(kind=kind, act=list(act), a=rep(lambda L: L['a']), u=rep(lambda L: L['u']), b=rep(lambda L: L['b']),
                knee=rep(lambda L: [L['knee']]), l=rep(lambda L: [L['l']]), s=rep(lambda L: [L['s']]),
                mass=[rep(lambda L: [L['mass'][j]]) for j in (0, 1)], com=[rep(lambda L: [L['com'][j]]) for j in (0, 1)],
                I=[rep(lambda L: L['I'][j]) for j in (0, 1)], visc=rep(lambda L: L['visc']), coul=rep(lambda L: L['coul']),
                smooth=rep(lambda L: L['smooth']))))
        self.cache[N] = out
        return out

    def __call__(self, m):
        f = self.f
        p, q, v, w, a, al = (np.array(x, float) for x in (m.p, m.q, m.v, m.w, m.a, m.alpha))
        if f.get('q_order') == 'xyzw':         # takes w,x,y,z for x,y,z,w
            q = q[:, [3, 0, 1, 2]]
        R = rot(q)
        if f.get('single'):
            R = R.astype(np.float32).astype(float)
        if f.get('R_transposed'):
            R = np.swapaxes(R, 1, 2)
        Rt = np.swapaxes(rot(q), 1, 2)
        if 'w_frame' in f:
            w = mv(Rt if f['w_frame'] == 'M' else rot(q), w)
        if 'al_frame' in f:
            al = mv(Rt if f['al_frame'] == 'M' else rot(q), al)
        w = w * f.get('w_scale', 1.0)
        v = v * f.get('v_scale', 1.0)
        N = len(p)
        # platform
        rho = mv(R, self.rho)
        if f.get('com_unrotated'):
            rho = np.broadcast_to(self.rho, (N, 3))
        cen = cross(w, cross(w, rho)) * (0.0 if f.get('no_platform_centripetal') else 1.0)
        aG = a + cross(al, rho) + cen
        I = np.einsum('nij,jk,nlk->nil', R, self.Ip, R)
        if f.get('tensor_unrotated'):
            I = np.broadcast_to(self.Ip, (N, 3, 3))
        if f.get('tensor_rotated_back'):
            I = np.einsum('nji,jk,nkl->nil', R, self.Ip, R)
        if f.get('tensor_about_P'):             # I_G as though about P: Steiner subtracted
            I = I - self.mp * (np.einsum('ni,ni->n', rho, rho)[:, None, None] * np.eye(3) - np.einsum('ni,nj->nij', rho, rho))
        if f.get('tensor_steiner_twice'):
            I = I + self.mp * (np.einsum('ni,ni->n', rho, rho)[:, None, None] * np.eye(3) - np.einsum('ni,nj->nij', rho, rho))
        gp = self.g * (0.0 if f.get('no_gravity') in ('platform', 'all') else 1.0)
        F = self.mp * ((0 if f.get('no_inertia') == 'platform_mass' else aG) - gp)
        gyro = cross(w, mv(I, w)) * (0.0 if f.get('no_gyro') in ('platform', 'all') else 1.0)
        if f.get('gyro_mixed'):
            gyro = cross(w, mv(np.broadcast_to(self.Ip, (N, 3, 3)), w))
        if f.get('gyro_sign') == 'platform':
            gyro = -gyro
        Ial = mv(I, al) * (0.0 if f.get('no_inertia') == 'platform_tensor' else 1.0)
        arm = np.zeros_like(rho) if f.get('no_moment_arm') else rho
        M = Ial + gyro + cross(arm, F)
        if self.load and not f.get('no_load'):
            fo, mo = np.array(self.load.get('force', [0, 0, 0]), float), np.array(self.load.get('moment', [0, 0, 0]), float)
            body = self.load.get('frame', 'base') == 'platform'
            if f.get('load_frame'):
                body = not body
            if body:
                fo, mo = mv(R, fo), mv(R, mo)
            pt = mv(R, np.array(self.load.get('point', [0, 0, 0]), float))
            if f.get('load_at_P'):
                pt = 0 * pt
            sg = -1.0 if f.get('load_sign') else 1.0
            F = F - sg * fo
            M = M - sg * (mo + cross(pt, np.broadcast_to(fo, (N, 3))))
        rhs = np.concatenate([F, M], 1)         # N x 6
        if f.get('single'):
            rhs = rhs.astype(np.float32).astype(float)
        found = {}
        N0, R0, rhs0 = N, R, rhs
        for idx, L in self.groups(N0):
            i = idx[0]
            nl = len(idx)
            R, p1, v1, w1, a1, al1 = (np.tile(x, (nl,) + (1,) * (x.ndim - 1)) for x in (R0, p, v, w, a, al))
            N = N0 * nl
            rhs = np.zeros((N, 6))
            b = mv(R, L['b'])
            B = p1 + b
            bj = L['b'] if f.get('b_unrotated') == 'velocity' else b
            vB = v1 + cross(w1, bj)
            aB = a1 + cross(al1, b) + cross(w1, cross(w1, b)) * (0.0 if f.get('no_bias') in ('platform', 'both') else -1.0 if f.get('bias_sign') else 1.0)
            joints, bodies = self.displacement(L, B)
            _, J = self.twist(joints, 3, B)
            Ji = np.linalg.inv(J)
            qd = mv(Ji, vB)
            zero = np.zeros_like(qd)
            _, _, bias = self.recursion(joints, 3, B, qd, zero)
            if f.get('no_bias') in ('leg', 'both'):
                bias = 0 * bias
            qdd = mv(Ji, aB - bias)
            Q = np.zeros((N, 3))
            for j, (nj, o, e, x, c) in enumerate(bodies):
                name = ('proximal', 'distal')[j]
                hit = lambda key: f.get(key) in (name, 'legs', 'all') and f.get(key + '_leg', i) == i
                if hit('other_end'):
                    c = (L['l'] if j == 0 else L['s']) - c
                if hit('com_mid'):
                    c = (L['l'] if j == 0 else L['s']) / 2
                if hit('com_at_end'):
                    c = 0.0 * c
                if f.get('rod_fixed') and j == 1:
                    nj, o, c = 2, joints[0][2], f['rod_fixed'] - L['s'] + c
                G = o + c * e
                W, V = self.twist(joints, nj, G)
                om, alpha, acc = self.recursion(joints, nj, G, qd, qdd)
                if hit('no_coriolis'):          # all that is quadratic in the rates but the gyroscopic moment
                    _, alpha, acc = self.recursion(joints, nj, G, 0 * qd, qdd)
                if hit('no_coriolis_P'):        # only 2 w x d-dot (UPS rods)
                    dd = [qd[:, k:k + 1] * joints[k][1] for k in range(nj) if joints[k][0] == 'P']
                    for t in dd:
                        acc = acc - 2 * cross(om, t)
                if f.get('leg_alpha'):          # without 2 d-dot w / d of the leg's angular acceleration
                    turn = 2 * qd[:, 2:] / np.linalg.norm(B - joints[0][2], axis=1, keepdims=True) * om
                    alpha, acc = alpha + turn, acc + cross(turn, G - joints[0][2])
                if hit('no_alpha_bias'):
                    _, alpha, _ = self.recursion(joints, nj, G, 0 * qd, qdd)
                T = np.stack([x, cross(e, x), e], -1)   # body frame
                if hit('link_tensor_unrotated'):
                    T = np.broadcast_to(np.eye(3), T.shape)
                Il = L['I'][j]
                mass = L['mass'][j]
                Iw = np.einsum('nij,njk,nlk->nil', T, Il, T)
                if hit('link_tensor_about_end'):
                    r = G - o
                    Iw = Iw - mass[:, :, None] * (np.einsum('ni,ni->n', r, r)[:, None, None] * np.eye(3) - np.einsum('ni,nj->nij', r, r))
                if hit('link_tensor_steiner'):
                    r = G - o
                    Iw = Iw + mass[:, :, None] * (np.einsum('ni,ni->n', r, r)[:, None, None] * np.eye(3) - np.einsum('ni,nj->nij', r, r))
                if hit('no_spin'):
                    edot = cross(om, e)
                    alpha = alpha - dot(alpha, e) * e - dot(om, e) * edot
                    om = om - dot(om, e) * e
                    W = W - e[:, :, None] * np.einsum('ni,nik->nk', e, W)[:, None, :]
                gl = self.g * (0.0 if hit('no_gravity') else 1.0)
                fo = mass * ((0 * acc if hit('no_link_mass_inertia') else acc) - gl)
                gy = cross(om, mv(Iw, om)) * (0.0 if hit('no_gyro') else 1.0)
                mo = mv(Iw, alpha) * (0.0 if hit('no_link_tensor') else 1.0) + gy * (0.0 if hit('no_link_tensor') else 1.0)
                if hit('no_link'):
                    fo, mo = 0 * fo, 0 * mo
                Q[:, :nj] += np.einsum('nik,ni->nk', V, fo) + np.einsum('nik,ni->nk', W, mo)
            for k in range(3):
                vis, cou = L['visc'][:, k], L['coul'][:, k]
                mode = f.get('friction')
                if mode == 'none' or (mode == 'passive_none' and k not in L['act']) or (mode == 'actuated_none' and k in L['act']):
                    continue
                if mode == 'no_viscous':
                    vis = 0.0
                if mode == 'no_coulomb':
                    cou = 0.0 * cou
                fr = vis * qd[:, k]
                if np.any(cou):
                    fr = fr + cou * (np.sign(qd[:, k]) if mode == 'unsmoothed' else np.tanh(qd[:, k] / L['smooth']))
                Q[:, k] += -fr if mode == 'sign' else fr
            bt = L['b'] if f.get('b_unrotated') in ('jacobian', 'velocity') else b
            # q-dot = Ji (v + w x b) = Ji [1, -b~] nu
            bx = np.zeros((N, 3, 3))
            bx[:, 0, 1], bx[:, 0, 2], bx[:, 1, 2] = -bt[:, 2], bt[:, 1], -bt[:, 0]
            bx = bx - np.swapaxes(bx, 1, 2)
            D = np.concatenate([Ji, -np.einsum('nij,njk->nik', Ji, bx)], 2)     # 3 x 6
            if f.get('legs_to_P'):              # leg's reaction carried to P without its moment
                D2 = D.copy(); D2[:, :, 3:] = 0
                rhs = rhs + np.einsum('nij,ni->nj', D2, Q)
            else:
                rhs = rhs + np.einsum('nij,ni->nj', D, Q)
            if f.get('rotor'):
                for k in L['act']:
                    rhs = rhs + D[:, k, :] * (f['rotor'] * qdd[:, k:k + 1])
            rhs0 = rhs0 + rhs.reshape(nl, N0, 6).sum(0)
            for j, ii in enumerate(idx):
                part = slice(j * N0, (j + 1) * N0)
                found[ii] = (D[part], Q[part], L['act'])
        rhs, R, N = rhs0, R0, N0
        rows = [found[i] for i in sorted(found)]
        Jm = np.stack([r[0][:, k, :] for r in rows for k in r[2]], 1)                 # N x 6 x 6: q-dot_act = Jm nu
        if f.get('open'):                       # effort of the driven joint of the open chain alone
            return np.stack([r[1][:, k] for r in rows for k in r[2]], 1)
        if f.get('least_squares'):
            D = np.concatenate([r[0] for r in rows], 1)      # N x 18 x 6
            tau = np.einsum('nij,nj->ni', np.linalg.pinv(np.swapaxes(D, 1, 2)), rhs)
            return tau[:, [3 * n + k for n, r in enumerate(rows) for k in r[2]]]
        JT = Jm if f.get('jac_transposed') else np.swapaxes(Jm, 1, 2)
        if f.get('jac_inverse'):
            return np.einsum('nij,nj->ni', np.swapaxes(np.linalg.inv(Jm), 1, 2) if f['jac_inverse'] == 'T' else Jm, rhs)
        tau = np.linalg.solve(JT, rhs[..., None])[..., 0]
        return tau
