"""Two and three mistakes at once, written from the contract alone. Adds to `wrong.W`: `expected` is {"together": a list of alternatives
for each mistake}."""
import copy

import numpy as np

from hexapod import Hexapod
from wrong import K, MT, P, W


def PAR(path):
    return [K('parameter', parameter='manipulator.' + path)]


def gain(k, f):
    return lambda y: y * np.where(np.arange(6) == k - 1, f, 1.0)


def order(columns):
    return lambda y: y[:, [k - 1 for k in columns]]


def of(kind, k):
    return [K(kind, motor=k), K(kind, leg=k)]


LATE = 0.004  # s

# name: what is wrong (flags of Hexapod, a change of the scenario, or one of the efforts), and what it should be called
MISTAKES = {
    'gyro': (dict(no_gyro='all'), [MT('gyroscopic', body=('all', None))]),
    'gyroP': (dict(no_gyro='platform'), [MT('gyroscopic', body=('platform', None))]),
    'gyroL': (dict(no_gyro='legs'), [MT('gyroscopic', body=('legs', 'proximal', 'distal', None))]),
    'corL': (dict(no_coriolis='legs'), [MT(('coriolis', 'centripetal'), body=('legs', None))]),
    'centP': (dict(no_platform_centripetal=True), [MT('centripetal', body=('platform', None))]),
    'grav': (dict(no_gravity='all'), [MT('gravity', body=('all', None))]),
    'gravL': (dict(no_gravity='legs'), [MT('gravity', body=('legs', None))]),
    'gravP': (dict(no_gravity='platform'), [MT('gravity', body=('platform', None))]),
    'gravD': (dict(no_gravity='distal'), [MT('gravity', body=('distal', None))]),
    'fric': (dict(friction='none'), [MT('friction')]),
    'fricsign': (dict(friction='sign'), [K('sign', term='friction')]),
    'load': (dict(no_load=True), [MT('load')]),
    'tensor': (dict(tensor_unrotated=True), [K('frame', term='inertia', body='platform')]),
    'tensorP': (dict(tensor_about_P=True), [K('reference_point', body='platform')]),
    'inertP': (dict(no_inertia='platform_tensor'), [MT('inertia', body='platform')]),
    'tensorL': (dict(no_link_tensor='legs'), [MT('inertia', body='legs')]),
    'rotor': (dict(rotor=.05), [MT('rotor_inertia')]),
    'rotor3': (dict(rotor=3.0), [MT('rotor_inertia')]),
    'bias': (dict(no_bias='both'), [K('closure', term='bias')]),
    'wbody': (dict(w_frame='M'), [K('frame', term='angular_velocity')]),
    'albody': (dict(al_frame='M'), [K('frame', term='angular_acceleration')]),
    'otherD': (dict(other_end='distal'), [K('reference_point', body='distal')]),
    'massP': (P('platform.mass', fac=1.03), PAR('platform.mass')),
    'massP4': (P('platform.mass', fac=1.0004), PAR('platform.mass')),
    'comP': (P('platform.center_of_mass.2', plus=.004), PAR('platform.center_of_mass*')),
    'inertiaP': (P('platform.inertia.0', fac=1.08), PAR('platform.inertia*')),
    'massD3': (P('leg.3.distal.mass', fac=1.1), PAR('leg.3.distal.mass')),
    'comD2': (P('leg.2.distal.center_of_mass', fac=1.06), PAR('leg.2.distal.center_of_mass')),
    'massX5': (P('leg.5.proximal.mass', fac=.9), PAR('leg.5.proximal.mass')),
    'base4': (P('leg.4.base_point.1', plus=.002), PAR('leg.4.base_point*')),
    'plat6': (P('leg.6.platform_point.0', plus=.0015), PAR('leg.6.platform_point*')),
    'len1': (P('leg.1.distal.length', fac=1.002), PAR('leg.1.distal.length')),
    'g980': (lambda m, d: m.update(gravity=[x * 9.8 / 9.81 for x in m['gravity']]), PAR('gravity*') + [K('scale', term='gravity')]),
    'gain3': (gain(3, 1.1), of('scale', 3)),
    'gain5': (gain(5, .5), of('scale', 5)),
    'off2': (lambda y: y + 4.0 * (np.arange(6) == 1), of('offset', 2)),
    'swap25': (order([1, 5, 3, 4, 2, 6]), [K('order')]),
    'cyc2': (order([3, 4, 5, 6, 1, 2]), [K('order')]),
    'sign4': (gain(4, -1), of('sign', 4)),
    'neg': (lambda y: -y, [K('sign', body='all')]),
    'kN': (lambda y: y / 1000, [K('units')]),
    'late': (LATE, [K('delay')]),
}

PAIRS = """gyro+corL@URS gyroP+fric@URSF gravL+fric@UPSF gyroP+gain3@RUS gravL+swap25@PUS massP+comP@UPS gyroL+massP@UPS
gravP+load@URSF massP+massD3@RUS centP+gain5@PUS tensor+massP@URS fric+rotor3@PUSF bias+gravD@RUS fric+bias@UPSF
gravP+kN@UPS gravL+sign4@RUS gyroP+late@URS massP+late@PUS comP+off2@RUS fricsign+massP@RUSF wbody+massD3@UPS albody+fric@URSF
tensorP+gyroL@PUS inertP+gravL@UPS otherD+massP@URS base4+massP@UPS plat6+gyroP@RUS len1+gravL@PUS g980+fric@UPSF massD3+massX5@URS
comD2+massP@RUS inertiaP+gyroL@URS gravL+neg@UPS swap25+off2@URS gain3+off2@PUS late+gain3@RUS massP+swap25@UPS corL+fric@PUSF
gravD+tensor@UPS massP4+gyroP@PUS load+gain3@UPSF rotor+gyroP@RUS grav+fric@URSF tensorL+gravP@RUS"""
TRIPLES = """gyro+corL+fric@UPSF gravL+fric+load@URSF massP+comP+massD3@RUS gyroP+corL+gravD@PUS gravL+swap25+fric@UPSF
gyroP+fric+gain3@RUSF massP+gravL+off2@URS tensor+fric+bias@PUSF gravP+corL+sign4@UPS centP+gravD+massP@URS fric+load+massX5@UPSF
gyroP+gravL+comP@RUS"""


def solver(names):
    def make(document, scenario):
        changed, flags, of_efforts, late = copy.deepcopy(document), {}, [], 0.0
        for name in names:
            what = MISTAKES[name][0]
            if isinstance(what, dict):
                flags.update(what)
            elif isinstance(what, float):
                late = what
            elif what.__code__.co_argcount == 2:
                what(changed['manipulator'], changed)
            else:
                of_efforts.append(what)
        hexapod = Hexapod(changed, **flags)

        def efforts(m):
            if late:
                m = scenario.motion(np.clip(np.asarray(m.t) - late, 0, scenario.duration))
            y = hexapod(m)
            for change in of_efforts:
                y = change(y)
            return y
        return efforts
    return make


for case in (PAIRS + ' ' + TRIPLES).split():
    together, machine = case.split('@')
    names = together.split('+')
    W.append(dict(name=case, machine=machine, what=together, make=solver(names),
                  expected={'together': [MISTAKES[name][1] for name in names]}))
