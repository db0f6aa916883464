"""The machines of the bench, as dicts. Lower case: the tool's own starting file (equal legs); upper case: nothing equal."""
from pathlib import Path

import numpy as np


ROOT = Path(__file__).resolve().parents[3]


def load(ursula, kind):
    return ursula.read_scenario(ROOT / f'apps/starting/{kind}.toml').to_dict()


def build(ursula, name):
    base = name.rstrip('F').upper()
    if base == 'MIX':
        d = ursula.read_scenario(ROOT / 'scenarios/mixture.toml').to_dict()
    else:
        d = load(ursula, base)
    d = {k: v for k, v in d.items() if k in ('name', 'manipulator', 'trajectory', 'load')}
    d['name'] = name
    m = d['manipulator']
    pts = d['trajectory']['points'] if d['trajectory']['kind'] == 'waypoints' else None
    p0 = np.array(pts[0]['position']) if pts else np.array([0.0, 0.0, 1.0])
    span = {'URS': 0.05, 'UPS': 0.08, 'RUS': 0.07, 'PUS': 0.08, 'MIX': 0.05}[base]
    P = [([0, 0, 0], [0, 0, 0]), ([1, -.7, .6], [7, -5, 8]), ([-.8, .9, .2], [-5, 8, -6]), ([.3, .4, -.5], [3, -2, 5])]
    d['trajectory'] = dict(kind='waypoints', points=[
        dict(time=0.2 * i, position=[float(x) for x in p0 + span * np.array(a)], rpy_deg=[float(x) for x in r])
        for i, (a, r) in enumerate(P)])
    d['simulation'] = dict(samples=61)
    if name.isupper() and base != 'MIX':
        rng = np.random.default_rng({'URS': 1, 'UPS': 2, 'RUS': 3, 'PUS': 4}[base])
        defaults = m.pop('leg_defaults', {})
        import copy
        from hexapod import merged
        legs = []
        def full(t):
            t = list(t)[:3]
            t = [max(x, 0.15 * max(t)) * rng.uniform(.85, 1.15) for x in t]
            t = [max(x, .5 * max(t)) for x in t]
            t[t.index(max(t))] *= .85
            o = [float(x) for x in rng.uniform(-.08, .08, 3) * max(t)]
            return [float(x) for x in t] + o
        for leg in m['leg']:
            L = merged(copy.deepcopy(defaults), leg)
            for k in ('base_point', 'platform_point'):
                L[k] = [float(x) for x in np.array(L[k]) + rng.uniform(-.04, .04, 3)]
            L['base_axis'] = [float(x) for x in np.array(L['base_axis']) + rng.uniform(-.08, .08, 3)]
            for k in ('proximal', 'distal'):
                b = L[k]
                b['mass'] = float(b['mass'] * rng.uniform(.8, 1.25))
                b['center_of_mass'] = float(b['center_of_mass'] * rng.uniform(.6, .9))
                if 'length' in b:
                    b['length'] = float(b['length'] * rng.uniform(.98, 1.02))
                b['inertia'] = full(b['inertia'])
            if base == 'PUS':
                L['proximal']['center_of_mass'] = float(rng.uniform(.02, .06))
            L.pop('friction', None)
            if name.endswith('F'):
                n = {'URS': 'actuated universal knee', 'UPS': 'phi psi d', 'RUS': 'phi psi theta', 'PUS': 'd psi theta'}[base].split()
                wt = m['platform']['mass'] / 50
                L['friction'] = {k: float(wt * rng.uniform(.5, 2) * (8 if k == 'd' else 1)) for k in n}
                L['coulomb'] = {k: float(wt * rng.uniform(.5, 2)) for k in n} | {'smoothing_speed': float(rng.uniform(.04, .09))}
            legs.append(L)
        m['leg'] = legs
        m['gravity'] = [0.4, -0.7, -9.78]
        s = 0.1 if base != 'RUS' else .05
        m['platform']['center_of_mass'] = [float(x) for x in np.array(m['platform']['center_of_mass']) * .8 + [s, -.7 * s, .1 * s]]
        m['platform']['inertia'] = full(m['platform']['inertia'])
        if name.endswith('F'):
            W = m['platform']['mass']
            d['load'] = dict(force=[.9 * W, -.5 * W, -1.4 * W], moment=[.12 * W, .2 * W, -.15 * W], point=[.1, -.15, .2], frame='platform')
    return d
