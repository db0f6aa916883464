#!/usr/bin/env python3
"""Machines that files describe in roundabout ways: free rods, crosses with a mass, bodies cut in two, closures of two balls.

    import_cases_test.py PROGRAM
"""

import re
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
import import_files as files  # noqa: E402
import import_machines as machines  # noqa: E402
import import_test  # noqa: E402
from import_test import COORDINATES, tensor  # noqa: E402


def made(seed, kinds=("UPS",), **more):
    rng = np.random.default_rng(seed)
    machine = machines.random_machine(rng, kinds=kinds, **more)
    bodies, joints = machines.bodies_of(machine, rng, split=False)
    return machine, bodies, joints, rng


class Cases(import_test.Imports):
    # The random machines are import_test's own.
    test_sdf_of_every_version = test_mjcf = test_urdf_by_each_closure = None

    def said(self, assumptions, words):
        found = [a for a in assumptions if words in a["what"]]
        self.assertTrue(found, f"'{words}' in {assumptions}")
        return found

    def with_balls(self, machine, joints):
        """The universal joint of each leg becomes a ball."""
        out = []
        for j in joints:
            k, kind = int(j["name"][-1]), j["leg"]["kind"]
            if k == {"UPS": 0, "RUS": 1, "PUS": 1}[kind]:
                out.append({**j, "kind": "S", "to": joints[joints.index(j) + 1]["to"], "friction": 0})
            elif k != {"UPS": 1, "RUS": 2, "PUS": 2}[kind]:
                out.append(j)
        return out

    def test_rods_that_spin_freely(self):
        for seed, kind in enumerate(("UPS", "RUS", "PUS") * 4):
            with self.subTest(seed=seed, kind=kind):
                machine, bodies, joints, rng = made(seed, (kind,), free=True)
                text = files.write_sdf(bodies, self.with_balls(machine, joints), machine["gravity"], rng)
                driven = ",".join(j["name"] for j in joints if j["driven"])
                scenario, assumptions = self.imported(text, "m.sdf", "--actuated", driven)
                self.said(assumptions, "spin freely")
                self.assertEqual(self.checked(text, "m.sdf", "--actuated", driven).returncode, 0)
                for leg, found in zip(machine["legs"], scenario["manipulator"]["leg"]):
                    self.assertEqual((found["kind"], found["spin"], found["actuated"]), (kind, "free", [COORDINATES[kind][leg["driven"]]]))
                    self.near(found["distal"]["center_of_mass"], leg["links"][1]["com"][2], 10, "mass centre")
                    self.near(tensor(found["distal"]["inertia"]), leg["links"][1]["I"], 1, "inertia")
                    self.near(tensor(found["distal"]["inertia"]), leg["links"][1]["I"], 1, "inertia")
                    if kind == "UPS":  # the axis is free, but across the leg's line
                        line = machine["platform"]["p"] + machine["platform"]["Q"] @ leg["b"] - leg["A"]
                        self.near(np.dot(found["base_axis"], line), 0, 10, "base_axis")

    def checked(self, text, name, *options):
        """`ursula check` on the scenario as it is written."""
        path, out = Path(self.folder.name) / name, Path(self.folder.name) / "out.toml"
        path.write_text(text)
        done = import_test.run(path, "--out", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return subprocess.run([import_test.PROGRAM, "check", str(out)], capture_output=True, text=True, timeout=120)

    def test_a_free_rod_that_is_nearly_round(self):
        """What the tolerance lets pass is written round."""
        machine, bodies, joints, rng = made(3, ("UPS",), free=True)
        rod = bodies["leg1_second"]
        rod["I"] = rod["I"] + 1e-3 * np.abs(rod["I"]).max() * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0.5]])
        text = files.write_sdf(bodies, self.with_balls(machine, joints), machine["gravity"], rng)
        driven = ",".join(f"leg{i}_j2" for i in range(1, 7))
        self.refused(text, "m.sdf", ["leg1_second", "transverse"], "--actuated", driven)
        done = self.checked(text, "m.sdf", "--actuated", driven, "--tolerance", "0.01")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_free_rod_that_is_not_round_is_refused(self):
        machine, bodies, joints, rng = made(3, ("UPS",))
        text = files.write_sdf(bodies, self.with_balls(machine, joints), machine["gravity"], rng)
        self.refused(text, "m.sdf", ["leg1_", "spins freely", "transverse"], "--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))

    def refused(self, text, name, words, *options):
        path = Path(self.folder.name) / name
        path.write_text(text)
        done = import_test.run(path, *options)
        self.assertEqual(done.returncode, 2, done.stdout)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_cross_with_a_mass(self):
        for kind in ("UPS", "RUS"):
            machine, bodies, joints, rng = made(11, (kind,))
            first = next(j for j in joints if j["to"] is None)
            second = joints[joints.index(first) + 1]
            cross = {"name": "cross", "T": (first["centre"], machines.random_rotation(rng)), "mass": 1e-3, "com": first["centre"],
                     "I": np.eye(3) * 1e-6}
            bodies["cross"] = cross
            first["to"] = second["from"] = "cross"
            text = files.write_sdf(bodies, joints, machine["gravity"], rng)
            driven = ",".join(j["name"] for j in joints if j["driven"])
            scenario, assumptions = self.imported(text, "m.sdf", "--actuated", driven)
            lost = self.said(assumptions, "tensor is left out")[0]
            self.assertEqual(lost["where"], "cross")
            self.assertLess(0, lost["size"])
            self.assertLess(lost["size"], 1e-4)
            mass = scenario["manipulator"]["leg"][0]["proximal"]["mass"]
            self.near(mass, machine["legs"][0]["links"][0]["mass"] + (1e-3 if kind == "RUS" else 0), 5, "mass")
            self.refused(text, "m.sdf", ["cross", "--lump"], "--actuated", driven, "--lump", "1e-9")

    def test_order_and_sign_of_efforts(self):
        """Legs take the order of the motors; the comment names the joints of the efforts; what differs is said."""
        machine, bodies, joints, rng = made(18, ("URS",))
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        path = Path(self.folder.name) / "m.xml"

        def order_of(*options):
            done = import_test.run(path, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout.split("# Effort columns 1, 2, …: ")[1].split(".\n")[0].split(", "), done.stderr

        path.write_text(text)
        start, end = text.index("<actuator>") + len("<actuator>"), text.index("</actuator>")
        motors = re.findall(r"<\w+ [^>]*/>", text[start:end])
        self.assertEqual(len(motors), 6)
        for order in (motors, motors[::-1], motors[3:] + motors[:3]):
            path.write_text(text[:start] + "".join(order) + text[end:])
            names, words = order_of()
            self.assertEqual(names, [re.search(r'joint="(\w+)"', motor)[1] for motor in order])
            self.assertNotIn("Efforts go leg by leg", words)
        chosen = [f"leg{i}_j0" for i in (4, 2, 6, 1, 3, 5)]
        self.assertEqual(order_of("--actuated", ",".join(chosen))[0], chosen)
        # Two motors of one leg stand together.
        driven = [f"leg{i}_j0" for i in range(1, 6)] + ["leg1_j1"]
        names, words = order_of("--actuated", ",".join(driven))
        self.assertEqual(names, ["leg1_j0", "leg1_j1"] + driven[1:5])
        self.assertIn("Efforts go leg by leg", words)
        hinge = next(j for j in joints if j["name"] == "leg1_j1")
        grows = "leg1_j1: The file's coordinate of this hinge grows against the scenario's psi"
        hinge["axis"] = -hinge["axis"]
        path.write_text(files.write_mjcf(bodies, joints, machine["gravity"], rng))
        self.assertNotEqual(grows in order_of("--actuated", ",".join(driven))[1], grows in words)

    def test_two_motors_on_one_leg_and_none_on_another(self):
        """Six motors in all are as good as one for each leg: the efforts bear the same power."""
        machine, bodies, joints, rng = made(18, ("UPS",))
        text = files.write_sdf(bodies, joints, machine["gravity"], rng)
        in_file = {j["name"]: j.get("name_in_file", j["name"]) for j in joints}
        one = [in_file[f"leg{i}_j2"] for i in range(1, 7)]
        two = one[:5] + [in_file["leg1_j0"]]
        path, out = Path(self.folder.name) / "m.sdf", Path(self.folder.name) / "out.toml"
        path.write_text(text)
        power, motion = [], None
        for driven in (one, two):
            done = import_test.run(path, "--actuated", ",".join(driven), "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            machine_text, _, own = out.read_text().partition("[trajectory]")
            motion = motion or own  # that of the first, for both
            out.write_text(machine_text + "[trajectory]" + motion)
            legs = tomllib.loads(out.read_text())["manipulator"]["leg"]
            self.assertEqual(sum(len(leg["actuated"]) for leg in legs), 6)
            power.append(self.power(out, legs))
        self.assertEqual([len(leg["actuated"]) for leg in legs], [2, 1, 1, 1, 1, 0])
        self.assertGreater(np.abs(power[0]).max(), 1e-3)
        self.near(power[1], power[0], 1e3 * np.abs(power[0]).max(), "power")

    def power(self, path, legs):
        done = subprocess.run([import_test.PROGRAM, "inverse", str(path), "--samples", "9"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        names, *rows = (line.split(",") for line in done.stdout.splitlines())
        table = dict(zip(names, np.array(rows, float).T))
        motors = [(i, c) for i, leg in enumerate(legs, 1) for c in leg["actuated"]]
        rates = [table[f"{c}dot_{i}_" + ("m_s" if c == "d" else "rad_s")] for i, c in motors]
        efforts = [column for name, column in table.items() if name.startswith("tau_")]
        return sum(e * r for e, r in zip(efforts, rates))

    def efforts(self, text):
        path = Path(self.folder.name) / "efforts.toml"
        path.write_text(text)
        done = subprocess.run([import_test.PROGRAM, "inverse", str(path), "--samples", "9"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        names, *rows = (line.split(",") for line in done.stdout.splitlines())
        return np.array([[float(x) for n, x in zip(names, row) if n.startswith("tau_")] for row in rows])

    def test_an_export_comes_back(self):
        """Rotors, free rods, gravity aside and smoothed friction, in every format; and what is carried is what makes it so."""
        rotors = "rotor_inertia = { phi = 0.5, d = 3.0 }\ncoulomb = { phi = 4.0, d = 6.0, smoothing_speed = 0.03 }\n"
        for name in ("free-rods", "coulomb-friction", "gravity-sideways", "three-legs"):
            whole = (Path(__file__).parents[2] / f"scenarios/{name}.toml").read_text()
            if name == "three-legs":
                whole = whole.replace('actuated = ["phi", "d"]\n', 'actuated = ["phi", "d"]\n' + rotors)
            scenario, motion = Path(self.folder.name) / "whole.toml", whole[whole.index("[trajectory]"):]
            scenario.write_text(whole)
            right = self.efforts(whole)
            for form, key in (("sdf", 'ursula:smoothing_speed="'), ("mjcf", '_smoothing_speed" data="'), ("urdf", 'ursula:smoothing_speed="')):
                with self.subTest(name=name, form=form):
                    model = Path(self.folder.name) / f"m.{form}"
                    model.unlink(missing_ok=True)
                    done = subprocess.run([import_test.PROGRAM, "export", str(scenario), "--format", form, "--out", str(model)],
                                          capture_output=True, text=True, timeout=120)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    back = lambda: re.sub(r"(?s)\n\[trajectory\].*", "\n" + motion, import_test.run(model).stdout)
                    self.assertLessEqual(np.abs(self.efforts(back()) - right).max(), 1e-9 * np.abs(right).max())
                    if name == "free-rods":
                        legs = tomllib.loads(back())["manipulator"]["leg"]
                        self.assertEqual({leg["spin"] for leg in legs}, {"free"})
                        self.near(legs[1]["distal"]["inertia"], [0.095, 0.095, 0.0006], 1, "moment about the line")
                    if "coulomb" in whole:
                        self.assertIn(key, model.read_text())
                        model.write_text(model.read_text().replace(key, key + "9"))
                        self.assertGreater(np.abs(self.efforts(back()) - right).max(), 1e-9 * np.abs(right).max())

    def test_a_base_with_a_frame_of_its_own(self):
        machine, bodies, joints, rng = made(12, ("URS", "UPS"))
        T = (np.array([0.5, -1, 2]), machines.random_rotation(rng))
        for b in bodies.values():
            b["T"], b["com"], b["I"] = files.times(T, b["T"]), T[0] + T[1] @ b["com"], T[1] @ b["I"] @ T[1].T
        for j in joints:
            j["centre"] = T[0] + T[1] @ j["centre"]
            if j["axis"] is not None:
                j["axis"] = T[1] @ j["axis"]
        text = files.write_mjcf(bodies, joints, T[1] @ machine["gravity"], rng)
        scenario, _ = self.imported(text, "m.xml", "--base", "base")
        self.hold(scenario, machine, False, machine["gravity"], True)

    def test_a_body_cut_in_two(self):
        """Half a rod of one's own at either side of a weld."""
        machine, bodies, joints, rng = made(13)
        whole = bodies["leg2_second"]
        half = {**whole, "name": "half", "T": (whole["com"], machines.random_rotation(rng)), "mass": whole["mass"] / 2, "I": whole["I"] / 2}
        whole.update(mass=whole["mass"] / 2, I=whole["I"] / 2)
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        m = files.Mjcf(rng)
        m.degrees, m.sequence = 'angle="degree"' in text, "none"
        body = f'<body name="half" {m.place(half["T"])}><freejoint/>{m.inertial(half)}</body>'
        text = text.replace("</worldbody>", body + "</worldbody>")
        text = text.replace("</equality>", '<weld name="glue" body1="leg2_second" body2="half"/></equality>')
        scenario, _ = self.imported(text, "m.xml")
        self.hold(scenario, machine, False, machine["gravity"], True)

    def test_a_platform_left_free_by_six_joints(self):
        machine, bodies, joints, rng = made(14)
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        free = "".join(f'<joint name="free{k}" type="slide" axis="{a}"/>' for k, a in enumerate(("1 0 0", "0 1 0", "0 0 1")))
        text = text.replace("<freejoint/>", free + '<joint name="free3" type="ball"/>')
        scenario, assumptions = self.imported(text, "m.xml")
        self.said(assumptions, "leave the platform free")
        self.hold(scenario, machine, False, machine["gravity"], True)

    def test_a_hinge_closed_by_two_balls(self):
        """The platform's side of a leg hangs on the platform; its knee is closed by two connects."""
        machine, bodies, joints, rng = made(15, ("URS",))
        knee = next(j for j in joints if j["name"] == "leg1_j2")
        ball = next(j for j in joints if j["name"] == "leg1_j3")
        text = files.write_mjcf(bodies, [j for j in joints if j not in (knee, ball)], machine["gravity"], rng)
        m = files.Mjcf(rng)
        m.degrees, m.sequence = 'angle="degree"' in text, "none"
        rod, platform, crank = bodies["leg1_second"], bodies["platform"], bodies["leg1_first"]
        local = rod["T"][1].T @ (ball["centre"] - rod["T"][0])
        body = (f'<body name="leg1_second" {m.place(files.relative(platform["T"], rod["T"]))}>'
                f'<joint name="leg1_j3" type="ball" pos="{files.num(local)}"/>{m.inertial(rod)}</body>')
        start = text.index('<body name="platform"')
        end = text.index("</body>", start)
        text = text[:end] + body + text[end:]
        connects = ""
        for k in (0, 1):
            point = knee["centre"] + (0.05 + 0.1 * k) * knee["axis"]
            connects += f'<connect body1="leg1_first" body2="leg1_second" anchor="{files.num(crank["T"][1].T @ (point - crank["T"][0]))}"/>'
        text = text.replace("</equality>", connects + "</equality>")
        machine["legs"][0]["friction"][2] = None
        scenario, assumptions = self.imported(text, "m.xml")
        self.said(assumptions, "read as a hinge")
        found = scenario["manipulator"]["leg"][0]
        self.near(found["proximal"]["length"], machine["legs"][0]["l"], 10, "l")
        self.near(found["distal"]["length"], machine["legs"][0]["s"], 10, "s")

    def test_a_gap_is_said(self):
        machine, bodies, joints, rng = made(16)
        text = files.write_urdf(bodies, joints, rng)
        text = text.replace('p_BQ value="', 'p_BQ value="1e-3+', 1)
        number = text.split('p_BQ value="1e-3+', 1)[1].split(" ", 1)[0]
        text = text.replace("1e-3+" + number, repr(float(number) + 1e-3), 1)
        _, assumptions = self.imported(text, "m.urdf")
        gap = self.said(assumptions, "open at the file's initial pose")[0]
        self.assertAlmostEqual(gap["size"], 1e-3, delta=1e-12)
        self.assertEqual((gap["unit"], gap["warning"]), ("m", False))  # below 1e-3 of the machine's size
        text = text.replace(repr(float(number) + 1e-3), repr(float(number) + 0.03), 1)
        _, assumptions = self.imported(text, "m.urdf")
        self.assertEqual([a["warning"] for a in assumptions], [True] + [False] * (len(assumptions) - 1))
        self.assertAlmostEqual(assumptions[0]["size"], 0.03, delta=1e-12)
        said = import_test.run(Path(self.folder.name) / "m.urdf")
        self.assertTrue(said.stderr.startswith("warning: "), said.stderr[:200])

    def displaced(self, way, angle):
        """A machine whose file has leg 1's ball on a tip that is not at its place on the platform, and the closure that says it."""
        machine, bodies, joints, rng = made(21, ("UPS", "URS"))
        ball = next(j for j in joints if j["kind"] == "S" and j["leg"] is machine["legs"][0])
        text = files.write_mjcf(bodies, [j for j in joints if j is not ball], machine["gravity"], rng)
        platform, rod = bodies["platform"]["T"], bodies["leg1_second"]["T"]
        machine["legs"][0]["b"] = machine["legs"][0]["b"] + [0.011, -0.007, 0.004]
        c = np.array([0.03, -0.02, 0.05])  # of the ball, in the tip
        R = machines.random_rotation(rng)
        tip = (ball["centre"] - R @ c, R)  # in the file
        Q = machines.rotation([1, 2, 3], angle) @ platform[1].T @ R
        on_platform = (machine["legs"][0]["b"] - Q @ c, Q)  # where the closure has it
        m = files.Mjcf(rng)
        m.degrees, m.sequence = 'angle="degree"' in text, "none"
        site = lambda name, T: f'<site name="{name}" pos="{files.num(T[0])}" quat="{files.num(files.quat(T[1]))}"/>'
        body = (f'<body name="tip" {m.place(files.relative(rod, tip))}><joint name="leg1_j3" type="ball" pos="{files.num(c)}"/>'
                f"{site('a', (np.ones(3), np.eye(3)))}</body>")
        start = text.index('<body name="leg1_second"')
        end = start + re.search("</body>", text[start:]).start()
        text = text[:end] + body + text[end:]
        at = text.index("<freejoint/>")
        text = text[:at] + site("b", files.times(on_platform, (np.ones(3), np.eye(3)))) + text[at:]
        anchor = np.array([0.1, 0.2, -0.3])
        pose = lambda T, t: f'{files.num(t)} {files.num(2 * files.quat(T[1]))}'
        to_platform = files.inverse(on_platform)
        weld = {"tip": f'<weld name="w" body1="tip" body2="platform" relpose="{pose(to_platform, to_platform[0])}"/>',
                "platform": f'<weld name="w" body1="platform" body2="tip" relpose="{pose(on_platform, on_platform[0])}"/>',
                "anchor": f'<weld name="w" body1="tip" body2="platform" anchor="{files.num(anchor)}" torquescale="2" '
                          f'relpose="{pose(to_platform, to_platform[0] + to_platform[1] @ anchor)}"/>',
                "sites": '<weld name="w" site1="b" site2="a"/>',
                "none": '<weld name="w" body1="tip" body2="platform"/>',
                "zero": '<weld name="w" body1="tip" body2="platform" relpose="1 2 3 0 0 0 0"/>'}[way]
        return machine, text.replace("</equality>", weld + "</equality>")

    def test_a_weld_is_believed_where_it_says_it_holds(self):
        for way in ("tip", "platform", "anchor", "sites"):
            for angle in (0, 0.05, 2):
                with self.subTest(way=way, angle=angle):
                    machine, text = self.displaced(way, angle)
                    scenario, assumptions = self.imported(text, "m.xml")
                    self.hold(scenario, machine, False, machine["gravity"], True)
                    warned = [a for a in assumptions if a["warning"]]
                    self.assertEqual(warned, assumptions[:len(warned)])
                    self.assertEqual({a["where"] for a in warned}, {"w"})
                    self.assertEqual(len(warned), 1 + (angle > 0))
                    self.assertIn("#   warning: w: ", scenario_of(self.folder, text))
        for way in ("none", "zero"):  # the file's pose holds: the ball is elsewhere
            machine, text = self.displaced(way, 2)
            scenario, assumptions = self.imported(text, "m.xml")
            off = np.array(scenario["manipulator"]["leg"][0]["platform_point"]) - machine["legs"][0]["b"]
            self.near(off, [-0.011, 0.007, -0.004], 10, "point")
            self.assertFalse(any(a["warning"] for a in assumptions))

    def test_a_weld_of_no_torque_is_a_ball(self):
        machine, bodies, joints, rng = made(22)
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        connect = re.search('<connect name="(.*?)" body1="(.*?)" body2="(.*?)" anchor="(.*?)"/>', text)
        _, first, second, anchor = connect.groups()
        world = files.times(bodies[first]["T"], (np.array(anchor.split(), float), np.eye(3)))
        other = files.relative(bodies[second]["T"], world)[0]
        weld = f'<weld body1="{first}" body2="{second}" anchor="{files.num(other)}" relpose="{anchor} 0.1 0.2 0.3 0.4" torquescale="{{}}"/>'
        scenario, assumptions = self.imported(text.replace(connect[0], weld.format(0)), "m.xml")
        self.hold(scenario, machine, False, machine["gravity"], True)
        self.assertFalse(any(a["warning"] for a in assumptions))
        self.refused(text.replace(connect[0], weld.format(1)), "m.xml", ["6 motors", "3 freedoms", connect[1].split("_")[0]])

    def test_a_foot_that_a_weld_puts_in_its_place(self):
        """The leg on it comes along: its first axis is the base's."""
        for kind in ("UPS", "URS", "RUS", "PUS"):
            with self.subTest(kind=kind):
                machine, bodies, joints, rng = made(23, (kind,))
                text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
                ball = next(j for j in joints if j["name"] == "leg1_j3")
                start = text.index('<body name="leg1_first"')
                end, depth = start, 0
                for tag in re.finditer("<body|</body>", text[start:]):
                    depth += 1 if tag[0] == "<body" else -1
                    if depth == 0:
                        end = start + tag.end()
                        break
                leg = text[start:end]
                text = text[:start] + text[end:]
                off = (np.array([0.02, -0.01, 0.03]), machines.rotation([3, 1, 2], 0.2))
                m = files.Mjcf(rng)
                m.degrees, m.sequence = 'angle="degree"' in text, "none"
                foot = f'<body name="foot" {m.place(files.times(off, bodies["base"]["T"]))}><freejoint/>{leg}</body>'
                text = text.replace("</worldbody>", foot + "</worldbody>")
                point = lambda b: files.num(files.relative(bodies[b]["T"], (ball["centre"], np.eye(3)))[0])
                for body, name in (("leg1_second", "a"), ("platform", "b")):
                    tag = re.search(f'<body name="{body}"[^>]*>', text)
                    text = text[:tag.end()] + f'<site name="{name}" pos="{point(body)}"/>' + text[tag.end():]
                text = re.sub('<connect name="leg1_j3"[^>]*/>', '<connect name="leg1_j3" site1="a" site2="b"/>', text)
                weld = '<weld name="w" body1="foot" body2="base" relpose="0 0 0 1 0 0 0"/>'
                scenario, _ = self.imported(text.replace("</equality>", weld + "</equality>"), "m.xml")
                self.hold(scenario, machine, False, machine["gravity"], True)

    def test_six_dimensional_pairs_of_robot_yaml(self):
        """Frames that are one, whatever the file's pose is; the first column is the leg's ball on its tip."""
        machine, bodies, joints, rng = made(24)
        text = files.write_urdf(bodies, joints, rng, "close")
        ends = re.findall(r'<link name="(\w+)_end1"', text)
        Path(self.folder.name, "robot.yaml").write_text(
            f"closed_loop: [{', '.join(f'[{e}_end1, {e}_end2]' for e in ends)}]\ntype: [{', '.join('3d' for _ in ends)}]\n")
        scenario, _ = self.imported(text, "m.urdf")
        self.hold(scenario, machine, True, [0, 0, -9.81], True)

    def test_digits_of_the_file_may_break_the_triangle(self):
        """[0.33, 0.33, 0.67] is a rod of 1 %; its digits allow for the rest."""
        machine, bodies, joints, rng = made(17)
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        start = text.index("<inertial", text.index('name="platform"'))
        rest = text[text.index("/>", start):]
        thin = text[:start] + '<inertial pos="0 0 0" mass="5" diaginertia="{}"' + rest
        _, assumptions = self.imported(thin.format("0.33 0.33 0.67"), "m.xml")
        self.assertAlmostEqual(self.said(assumptions, "exceeded")[0]["size"], 0.01, delta=1e-12)
        self.refused(thin.format("0.33 0.33 0.70"), "m.xml", ["platform", "exceeds"])
        self.refused(thin.format("0.3300 0.3300 0.6700"), "m.xml", ["platform", "exceeds"])
        self.refused(thin.format("0.33 0.33 1e2"), "m.xml", ["platform", "exceeds"])  # not a number of one digit


def scenario_of(folder, text):
    path = Path(folder.name) / "text.xml"
    path.write_text(text)
    return import_test.run(path).stdout


if __name__ == "__main__":
    import_test.PROGRAM = sys.argv.pop(1)
    unittest.main()
