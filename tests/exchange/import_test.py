#!/usr/bin/env python3
"""What `ursula import` makes of random machines written as SDF, MJCF and URDF, against the machines' own numbers.

    import_test.py PROGRAM
"""

import json
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
import import_files as files  # noqa: E402
import import_machines as machines  # noqa: E402

PROGRAM = "ursula"
COORDINATES = {"UPS": ["phi", "psi", "d"], "URS": ["phi", "psi", "theta"], "RUS": ["phi", "psi", "theta"], "PUS": ["d", "psi", "theta"]}
# A chain of a dozen poses, each with angles of a few ulp, and moved inertias: some hundred roundings.
ROUNDING = 1e-12


def run(*arguments):
    return subprocess.run([PROGRAM, "import", *map(str, arguments)], capture_output=True, text=True, timeout=120)


class Imports(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def imported(self, text, name, *options):
        path = Path(self.folder.name) / name
        path.write_text(text)
        done = run(path, "--json", *options)
        self.assertEqual(done.returncode, 0, done.stderr + f"\n{text[:200]}")
        document = json.loads(done.stdout)
        return tomllib.loads(document["scenario"]), document["assumptions"]

    def near(self, found, expected, scale, what):
        error = np.abs(np.asarray(found, float) - np.asarray(expected, float)).max()
        self.assertLessEqual(error, ROUNDING * scale, f"{what}: {found}, expected {expected}")

    def hold(self, scenario, machine, moved_zero, gravity, rotors):
        m, P = scenario["manipulator"], machine["platform"]
        self.near(m["gravity"], gravity, 10, "gravity")
        self.near(m["platform"]["mass"], P["mass"], P["mass"], "mass")
        self.near(m["platform"]["center_of_mass"], P["rho"], 1, "rho")
        self.near(tensor(m["platform"]["inertia"]), P["I"], 20 + 50, "platform inertia")
        self.assertEqual(len(m["leg"]), 6)
        first = scenario["trajectory"]["points"][0]
        self.near(first["position"], P["p"], 2, "initial position")
        for leg, found in zip(machine["legs"], m["leg"]):
            self.hold_leg(leg, found, moved_zero, rotors)

    def hold_leg(self, leg, found, moved_zero, rotors):
        kind = leg["kind"]
        self.assertEqual(found["kind"], kind)
        self.assertEqual(found["actuated"], [COORDINATES[kind][leg["driven"]]])
        base = leg["A"] + (leg["d0"] * leg["u"] if kind == "PUS" and moved_zero else 0)
        self.near(found["base_point"], base, 10, kind + " base_point")
        self.near(found["base_axis"], leg["u"], 10, kind + " base_axis")
        self.near(found["platform_point"], leg["b"], 10, kind + " platform_point")
        for k, name in enumerate(("proximal", "distal")):
            link, got = leg["links"][k], found[name]
            length = leg["l"] if k == 0 else leg["s"]
            if not (kind == "PUS" and k == 0):
                self.near(got["length"], length, 10, f"{kind} {name}.length")
            com = got["center_of_mass"]
            if not isinstance(com, list):
                com = [0, com, 0] if kind == "PUS" and k == 0 else [0, 0, com]
            self.near(com, link["com"], 10, f"{kind} {name}.center_of_mass")
            self.near(got["mass"], link["mass"], 5, f"{kind} {name}.mass")
            self.near(tensor(got["inertia"]), link["I"], 10, f"{kind} {name}.inertia")
        if kind != "UPS":
            self.assertEqual(found["knee"], "positive" if leg["knee"] else "negative", kind)
        self.assertEqual(found["friction"], dict(zip(COORDINATES[kind], leg["friction"])))
        if rotors and leg["rotor"]:
            self.assertEqual(found["rotor_inertia"], {COORDINATES[kind][leg["driven"]]: leg["rotor"]})
        else:
            self.assertNotIn("rotor_inertia", found)

    def test_sdf_of_every_version(self):
        for seed in range(40):
            with self.subTest(seed=seed):
                rng = np.random.default_rng(seed)
                machine = machines.random_machine(rng)
                bodies, joints = machines.bodies_of(machine, rng)
                text = files.write_sdf(bodies, joints, machine["gravity"], rng)
                driven = ",".join(j.get("name_in_file", j["name"]) for j in joints if j["driven"])
                scenario, _ = self.imported(text, "m.sdf", "--actuated", driven)
                self.hold(scenario, machine, True, machine["gravity"], False)

    def test_mjcf(self):
        for seed in range(40):
            with self.subTest(seed=seed):
                rng = np.random.default_rng(1000 + seed)
                machine = machines.random_machine(rng, rotor=seed % 2 == 1)
                bodies, joints = machines.bodies_of(machine, rng)
                scenario, _ = self.imported(files.write_mjcf(bodies, joints, machine["gravity"], rng), "m.xml")
                self.hold(scenario, machine, False, machine["gravity"], True)

    def test_urdf_by_each_closure(self):
        for seed in range(40):
            with self.subTest(seed=seed):
                rng = np.random.default_rng(2000 + seed)
                closure = ("drake", "isaac", "gazebo", "names", "close", "constraint")[seed % 6]
                machine = machines.random_machine(rng, rotor=seed % 2 == 1)
                bodies, joints = machines.bodies_of(machine, rng)
                options = []
                if closure == "close":
                    for j in joints:
                        if j["kind"] == "S" and j["leg"] is not machine["legs"][0]:
                            options += ["--close", f"{j['name']}_end1:{j['name']}_end2"]
                scenario, _ = self.imported(files.write_urdf(bodies, joints, rng, closure), "m.urdf", *options)
                self.hold(scenario, machine, True, [0, 0, -9.81], True)


def tensor(entries):
    e = list(entries) + [0] * (6 - len(entries))
    return np.array([[e[0], e[3], e[4]], [e[3], e[1], e[5]], [e[4], e[5], e[2]]])


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
