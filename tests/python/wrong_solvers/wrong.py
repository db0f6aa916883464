"""Wrong solvers: {name, machine, what, make(scenario dict) -> f(m), expected}. `expected`: list of alternatives, each a dict of
fields (a value may be a tuple of acceptable ones); None: nothing should be named. Decided from the contract before any answer."""
import copy
import numpy as np
from hexapod import Hexapod

W = []


def add(machines, name, what, expected, make=None, params=None, **flags):
    for mach in machines.split():
        mk = make
        if mk is None and params is not None:
            def mk(d, s, params=params, mach=mach):
                e = copy.deepcopy(d)
                params(e['manipulator'], e)
                return Hexapod(e)
        elif mk is None:
            def mk(d, s, flags=flags):
                return Hexapod(d, **flags)
        W.append(dict(name=f'{name}@{mach}', machine=mach, what=what, make=mk, expected=expected))


def post(g):
    return lambda d, s: (lambda h: (lambda m: g(h(m), m)))(Hexapod(d))


K = lambda kind, **x: dict(kind=kind, **x)
MT = lambda term, **x: K('missing_term', term=term, **x)
RP = lambda body: [K('reference_point', body=body)]
ALL4 = 'URS UPS RUS PUS'

# outputs
add('URSF UPS', 'sign-all', 'all efforts negated', [K('sign'), ], post(lambda y, m: -y))
def one(k, fac):
    v = np.ones(6); v[k - 1] = fac
    return post(lambda y, m: y * v)
add('RUS PUSF', 'sign-one', 'motor 3 negated', [K('sign', motor=3), K('sign', leg=3)], one(3, -1))
add('UPS RUSF', 'order-swap', 'motors 2 and 5 exchanged', [K('order')], post(lambda y, m: y[:, [0, 4, 2, 3, 1, 5]]))
add('PUS ups', 'order-cycle', 'motors counted from the second', [K('order')], post(lambda y, m: y[:, [1, 2, 3, 4, 5, 0]]))
add('RUS', 'order-reverse', 'motors numbered backwards', [K('order')], post(lambda y, m: y[:, ::-1].copy()))
add('UPSF URS', 'kN', 'efforts in kN', [K('units'), K('scale')], post(lambda y, m: y / 1000))
add('PUS', 'g', 'efforts in kgf', [K('units'), K('scale')], post(lambda y, m: y / 9.80665))
add('RUS UPSF', 'gain', 'gain 1.02 on all', [K('scale')], post(lambda y, m: 1.02 * y))
add('PUSF URS', 'gain-one', 'gain 0.97 on motor 4', [K('scale', motor=4), K('scale', leg=4)], one(4, .97))
add('UPS PUS', 'offset-one', '3 N added to motor 6', [K('offset', motor=6), K('offset', leg=6)],
    post(lambda y, m: y + 3.0 * (np.arange(6) == 5)))
add('RUS', 'offset-all', '0.5 N m added to all', [K('offset')], post(lambda y, m: y + .5))
add('UPS RUS', 'single-out', 'answers rounded to float32', [K('digits')], post(lambda y, m: y.astype(np.float32).astype(float)))
class F32:
    def __init__(s, m):
        for k in ('t', 'p', 'q', 'v', 'w', 'a', 'alpha'):
            setattr(s, k, np.asarray(getattr(m, k)).astype(np.float32).astype(float))
add('PUS UPSF', 'single-in', 'motion rounded to float32 on the way in', [K('digits')], lambda d, s: (lambda h: (lambda m: h(F32(m))))(Hexapod(d)))
add('UPS', 'digits-3', 'rounded to 0.001', [K('digits')], post(lambda y, m: np.round(y, 3)))
def window(a, b, fac):
    return post(lambda y, m: y * np.where((np.asarray(m.t) > a) & (np.asarray(m.t) < b), fac, 1.0)[:, None])
add('UPS RUS', 'window', 'zero between 0.25 and 0.31 s', [K('window')], window(.25, .31, 0.0))
add('PUS', 'window-gain', '5 % too large between 0.15 and 0.25 s', [K('window')], window(.15, .25, 1.05))

# state
def lag(d, s):
    h = Hexapod(d); mem = [None]
    def f(m):
        y = h(m).copy()
        for i in range(len(y)):
            if mem[0] is not None:
                y[i] += .1 * (mem[0] - y[i])
            mem[0] = y[i].copy()
        return y
    return f
add('UPS RUS', 'state-filter', 'low pass over successive answers', [K('state')], lag)
def noise(d, s):
    h = Hexapod(d); r = np.random.default_rng(5)
    return lambda m: (lambda y: y * (1 + 1e-3 * r.standard_normal(y.shape)))(h(m))
add('PUS URSF', 'state-noise', 'noise of 0.1 % that changes at repeat', [K('state')], noise)
def drift(d, s):
    h = Hexapod(d); n = [0]
    def f(m):
        y = h(m); y = y + 1e-2 * (n[0] + np.arange(len(y)))[:, None]; n[0] += len(y); return y
    return f
add('RUS', 'state-count', 'an offset that grows with every instant asked', [K('state')], drift)
def fd(d, s):
    h = Hexapod(d)
    class M: pass
    def f(m):
        x = M(); x.__dict__.update({k: np.asarray(getattr(m, k)) for k in ('t', 'p', 'q', 'v', 'w', 'a', 'alpha')})
        if len(x.t) > 2 and np.all(np.diff(x.t) > 0):
            x.alpha = np.gradient(x.w, x.t, axis=0)
        return h(x)
    return f
add('UPS', 'fd-batch', 'angular acceleration by differences of the rows it gets', [K('state')], fd)

# poses and rates
add('URS UPS PUSF', 'quaternion', 'quaternion order x,y,z,w', [K('frame', term='orientation')], q_order='xyzw')
add(ALL4, 'R-transposed', 'rotation matrix transposed', [K('frame', term='orientation')], R_transposed=True)
add('URS UPS RUSF PUS ups', 'w-body', 'angular velocity taken in the platform frame', [K('frame', term='angular_velocity')], w_frame='M')
add('URS UPSF RUS PUS', 'al-body', 'angular acceleration taken in the platform frame', [K('frame', term='angular_acceleration')], al_frame='M')
add('URS UPS RUS', 'w-al-body', 'both in the platform frame', [K('frame', term=('angular_velocity', 'angular_acceleration'))], w_frame='M', al_frame='M')
add('PUS', 'w-al-body2', 'both rotated the other way', [K('frame', term=('angular_velocity', 'angular_acceleration'))], w_frame='B', al_frame='B')
add('UPS RUSF', 'w-deg', 'angular velocity in degrees per second', [K('units')], w_scale=180 / np.pi)
add('PUS', 'v-mm', 'velocity in mm/s', [K('units')], v_scale=1000.0)

# platform
add('URS UPS RUS PUS', 'tensor-fixed', 'platform tensor not rotated', [K('frame', term='inertia', body='platform')], tensor_unrotated=True)
add('UPSF', 'tensor-back', 'platform tensor rotated the wrong way', [K('frame', term='inertia', body='platform')], tensor_rotated_back=True)
add('URS UPS RUSF PUS', 'tensor-P', 'platform tensor taken as about P', RP('platform'), tensor_about_P=True)
add('UPS ups', 'tensor-steiner', 'parallel axis term added that is not due', RP('platform'), tensor_steiner_twice=True)
add('URS UPSF RUS', 'com-fixed', 'platform mass centre not rotated', [K('frame', body='platform'), K('reference_point', body='platform')], com_unrotated=True)
PC = [K('reference_point', body='platform'), K('parameter', parameter='manipulator.platform.center_of_mass*')]
add('UPS PUSF ups', 'com-zero', 'platform mass centre at P', PC, params=lambda m, d: m['platform'].update(center_of_mass=[0, 0, 0]))
add('RUS', 'com-neg', 'platform mass centre mirrored', PC, params=lambda m, d: m['platform'].update(center_of_mass=[-x for x in m['platform']['center_of_mass']]))
add('URSF UPS RUS PUS', 'grav-platform', 'gravity of the platform left out', [MT('gravity', body='platform')], no_gravity='platform')
add('URS UPSF RUS PUS', 'grav-legs', 'gravity of the legs left out', [MT('gravity', body='legs')], no_gravity='legs')
add('UPS', 'grav-all', 'gravity left out', [MT('gravity', body='all'), MT('gravity', body=None)], no_gravity='all')
add('URS UPS RUSF PUS', 'grav-distal', 'gravity of the distal links left out', [MT('gravity', body='distal')], no_gravity='distal')
add('UPS RUS', 'grav-prox', 'gravity of the proximal links left out', [MT('gravity', body='proximal')], no_gravity='proximal')
add('URS UPS', 'grav-one', 'gravity of the distal link of leg 2 left out', [MT('gravity', body='distal', leg=2)], no_gravity='distal', no_gravity_leg=2)
add('URSF UPS RUS PUS', 'gyro-platform', 'gyroscopic moment of the platform left out', [MT('gyroscopic', body='platform')], no_gyro='platform')
add('UPS', 'gyro-sign', 'gyroscopic moment of the platform with the wrong sign', [MT('gyroscopic', body='platform'), K('sign', term='gyroscopic')], gyro_sign='platform')
add('URS UPS PUS', 'gyro-legs', 'gyroscopic moment of the links left out', [MT('gyroscopic', body=('legs', 'proximal', 'distal'))], no_gyro='legs')
add('RUS', 'gyro-distal', 'gyroscopic moment of the rods left out', [MT('gyroscopic', body=('legs', 'distal'))], no_gyro='legs')
add('URS UPSF RUS PUS', 'centripetal', 'centripetal of the platform mass centre left out', [MT('centripetal', body='platform')], no_platform_centripetal=True)
add('URS UPSF RUS PUS', 'coriolis-legs', 'Coriolis and centripetal of the links left out', [MT(('coriolis', 'centripetal'), body='legs')], no_coriolis='legs')
add('UPS', 'coriolis-rod', '2 w x d-dot of the rods left out', [MT('coriolis', body=('distal', 'legs'))], no_coriolis_P='distal')
add('URS UPS', 'spin', 'spin of the leg about its line left out', [MT('spin', body='legs')], no_spin='legs')
add('RUS PUS', 'spin', 'spin of the rods about their line left out', [MT('spin', body=('legs', 'distal'))], no_spin='distal')
add('URS UPS', 'spin-distal', 'spin of the distal links left out', [MT('spin', body='distal')], no_spin='distal')
add('UPS RUS', 'inertia-platform', 'rotational inertia of the platform left out (gyroscopic kept)', [MT('inertia', body='platform')], no_inertia='platform_tensor')
add('RUS PUS UPSF URS', 'massless-legs', 'mass and inertia of all links left out', [MT(('inertia', 'gravity'), body='legs'), K('missing_term', body='legs')], no_link='legs')
add('UPS', 'massless-distal', 'mass and inertia of the rods left out', [K('missing_term', body='distal')], no_link='distal')
add('RUS UPS', 'inertia-links', 'link tensors left out', [MT('inertia', body='legs')], no_link_tensor='legs')
add('PUS UPS', 'inertia-links-mass', 'inertial forces of the links left out, weight kept', [MT('inertia', body='legs')], no_link_mass_inertia='legs')

# links
add('URS UPSF RUS', 'other-end-distal', 'distal mass centre from the other end', RP('distal'), other_end='distal')
add('URSF UPS RUS', 'other-end-prox', 'proximal mass centre from the other end', RP('proximal'), other_end='proximal')
add('UPS PUS', 'other-end-one', 'distal mass centre of leg 4 from the other end', [K('reference_point', body='distal', leg=4), K('parameter', parameter='manipulator.leg.4.distal.center_of_mass')], other_end='distal', other_end_leg=4)
add('PUS UPS', 'com-mid', 'distal mass centre taken at the middle', RP('distal'), com_mid='distal')
add('RUS', 'link-tensor-end', 'distal tensor taken as about the end', RP('distal'), link_tensor_about_end='distal')
add('UPS', 'link-tensor-fixed', 'link tensors not rotated', [K('frame', term='inertia', body='legs')], link_tensor_unrotated='legs')

# Jacobian, closure
add('URS UPS RUS PUSF', 'jac-T', 'Jacobian instead of its transpose', [K('jacobian')], jac_transposed=True)
add('URS UPS PUS', 'jac-b', 'b not rotated in the Jacobian of the efforts', [K('jacobian'), K('frame', term='orientation')], b_unrotated='jacobian')
add('RUS', 'jac-b2', 'b not rotated in velocities and efforts', [K('jacobian'), K('frame', term='orientation')], b_unrotated='velocity')
add('UPS RUS', 'jac-inv', 'J times wrench', [K('jacobian')], jac_inverse='J')
add('RUS UPS', 'leg-moment', 'reaction of the legs carried to P without its moment', [K('jacobian'), K('closure')], legs_to_P=True)
add('URS UPS RUS PUS', 'open', 'loops left open: each leg alone', [K('closure', term='open')], open='legs')
add('URS UPS RUS PUSF', 'least-squares', 'least squares over all joint efforts', [K('closure', term='least_squares')], least_squares=True)
add('URS UPS RUSF PUS', 'bias', 'J-dot v left out', [K('closure', term='bias')], no_bias='both')
add('URS UPS RUS', 'bias-leg', 'J-dot q-dot of the leg left out', [K('closure', term='bias')], no_bias='leg')
add('PUS UPS', 'bias-platform', 'w x (w x b) left out of the joint accelerations', [K('closure', term='bias')], no_bias='platform')

# friction, load, rotor
add('URSF UPSF RUSF PUSF', 'friction-none', 'friction left out', [MT('friction')], friction='none')
add('URSF UPSF RUSF', 'friction-sign', 'friction with the wrong sign', [MT('friction'), K('sign', term='friction')], friction='sign')
add('URSF PUSF UPSF', 'friction-sharp', 'sign instead of tanh', [MT('friction'), K('parameter', parameter='*smoothing*')], friction='unsmoothed')
add('RUSF PUSF', 'coulomb-none', 'Coulomb friction left out', [MT('friction'), K('parameter', parameter='*coulomb*')], friction='no_coulomb')
add('UPSF', 'viscous-none', 'viscous friction left out', [MT('friction'), K('parameter', parameter='*friction*')], friction='no_viscous')
add('URSF RUSF', 'friction-passive', 'friction of the passive joints left out', [MT('friction')], friction='passive_none')
add('URSF UPSF PUSF', 'load-none', 'load left out', [MT('load')], no_load=True)
add('UPSF RUSF', 'load-frame', 'load in the wrong frame', [K('frame', term='load'), MT('load')], load_frame=True)
add('PUSF', 'load-P', 'load acting at P', [K('reference_point'), MT('load'), K('parameter', parameter='load.point*')], load_at_P=True)
add('RUSF', 'load-sign', 'load with the wrong sign', [MT('load'), K('sign', term='load')], load_sign=True)
add('UPS PUS', 'rotor', 'rotor inertia that the scenario lacks (moving mass 4)', [MT('rotor_inertia'), K('parameter', parameter='*rotor*')], rotor=4.0)
add('RUS', 'rotor', 'rotor inertia that the scenario lacks (0.05)', [MT('rotor_inertia'), K('parameter', parameter='*rotor*')], rotor=.05)

# parameters
def P(path, fac=None, plus=None):
    keys = path.split('.')
    def change(m, d):
        o = m
        for k in keys[:-1]:
            o = o[int(k) - 1] if isinstance(o, list) and o is m['leg'] else (o[int(k)] if isinstance(o, list) else o[k])
        k = keys[-1]
        k = int(k) if isinstance(o, list) else k
        o[k] = o[k] * fac if fac else o[k] + plus
    return change
def par(machines, path, **x):
    name = 'par-' + path + (f'*{x["fac"]}' if 'fac' in x else f'+{x["plus"]}')
    add(machines, name, f'{path} changed', [K('parameter', parameter='manipulator.' + path.split('.inertia')[0] + ('.inertia' if 'inertia' in path else '') + '*')], params=P(path, **x))
par('UPS RUSF', 'platform.mass', fac=1.001)
par('URS', 'platform.mass', fac=1.1)
par('PUS', 'platform.inertia.3', fac=1.1)
par('UPS', 'platform.inertia.1', fac=1.01)
par('RUS', 'platform.center_of_mass.2', plus=.003)
par('UPS PUS RUSF', 'leg.3.distal.mass', fac=1.05)
par('UPS URSF', 'leg.5.proximal.mass', fac=1.01)
par('RUS', 'leg.2.distal.center_of_mass', fac=1.05)
par('UPS', 'leg.2.proximal.inertia.1', fac=1.05)
par('UPS PUSF', 'leg.4.base_point.1', plus=.002)
par('URS RUS', 'leg.6.platform_point.2', plus=.001)
par('URS RUS PUS', 'leg.1.distal.length', fac=1.002)
par('RUS', 'leg.1.proximal.length', fac=1.01)
par('PUS UPSF', 'leg.2.base_axis.0', plus=.03)
par('RUSF', 'leg.4.friction.phi', fac=1.1)
par('UPSF', 'leg.4.coulomb.d', fac=1.1)
def allmass(m, d):
    for l in m['leg']: l['distal']['mass'] = l['distal']['mass'] * 1.1
add('RUS UPS', 'par-all-distal-mass', 'mass of all distal links 10 % up', [K('parameter', parameter='manipulator.leg_defaults.distal.mass')], params=allmass)
add('UPS', 'par-gravity', 'g = 9.81 straight down instead of tilted', [K('parameter', parameter='manipulator.gravity*'), K('frame', term='gravity')], params=lambda m, d: m.update(gravity=[0, 0, -9.81]))
add('RUS', 'par-g-up', 'gravity upwards', [K('parameter', parameter='manipulator.gravity*'), K('sign', term='gravity'), MT('gravity')], params=lambda m, d: m.update(gravity=[-x for x in m['gravity']]))

# right ones
add('URSF UPSF RUSF PUSF mix ups', 'right', 'no mistake', 'pass')
