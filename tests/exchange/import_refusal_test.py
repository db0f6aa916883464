#!/usr/bin/env python3
"""What `ursula import` refuses, with what its messages name, and that nothing is written then.

    import_refusal_test.py PROGRAM
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
import import_files as files  # noqa: E402
import import_machines as machines  # noqa: E402

PROGRAM = "ursula"
CASES = Path(__file__).with_name("cases")


def machine_of(seed=7, kinds=("UPS",), split=False, **more):
    rng = np.random.default_rng(seed)
    machine = machines.random_machine(rng, kinds=kinds, **more)
    return (*machines.bodies_of(machine, rng, split=split), machine, rng)


def mjcf(**more):
    bodies, joints, machine, rng = machine_of(**more)
    return files.write_mjcf(bodies, joints, machine["gravity"], rng)


def sdf(**more):
    bodies, joints, machine, rng = machine_of(**more)
    return files.write_sdf(bodies, joints, machine["gravity"], rng)


def urdf(closure="drake", **more):
    bodies, joints, machine, rng = machine_of(**more)
    return files.write_urdf(bodies, joints, rng, closure)


class Refusals(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def call(self, text, name, *options):
        path = Path(self.folder.name) / name
        path.write_text(text)
        out = Path(self.folder.name) / "out.toml"
        done = subprocess.run([PROGRAM, "import", str(path), "--out", str(out), *options], capture_output=True, text=True, timeout=120)
        return done, out

    def refused(self, text, name, words, *options):
        done, out = self.call(text, name, *options)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertFalse(out.exists())
        self.assertIn(name, done.stderr)
        self.assertEqual(done.stderr.count("error:"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(done.stdout, "")

    def changed(self, text, pattern, to, count=1):
        result = re.sub(pattern, to, text, count=count)
        self.assertNotEqual(result, text, pattern)
        return result

    def test_what_is_whole_is_taken(self):
        """The files below are refused for what was changed in them, not for what they are."""
        for text, name, options in ((mjcf(), "m.xml", []), (urdf(), "m.urdf", []),
                                    (sdf(), "m.sdf", ["--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7))])):
            done, out = self.call(text, name, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(out.exists())
            out.unlink()

    def test_mjcf(self):
        whole = mjcf()
        hinge = r'(<joint name="leg2_j0" type="hinge")'
        for pattern, to, words in (
                (hinge, r'\1 stiffness="3.5"', ["leg2_j0", "spring", "3.5"]),
                (hinge, r'\1 armature="0.25"', ["leg2_j0", "rotor", "0.25"]),
                (hinge, r'\1 class="none"', ["leg2_j0", "none"]),
                (hinge, '<joint name="leg2_j1" type="hinge"', ["leg2_j1", "second joint"]),
                (r'(<body name="leg3_first")', r'\1 gravcomp="1"', ["leg3_first", "gravcomp"]),
                (r'(<body name="leg3_first")', r'\1 mocap="true"', ["leg3_first", "mocap"]),
                (r'(<body name="platform")', r'\1 mocap="true"', ["platform", "mocap"]),
                (r"<compiler ", '<compiler coordinate="global" ', ["global"]),
                (r"<compiler ", '<include file="x.xml"/><compiler ', ["x.xml", "mj_saveLastXML"]),
                (r"<worldbody>", '<tendon><fixed name="t"/></tendon><worldbody>', ["t", "tendon"]),
                (r"<equality>", '<equality><joint name="g" joint1="leg1_j0" joint2="leg2_j0"/>', ['name="g"', "gear"]),
                (r'<inertial [^>]*>(</body>)', r'<geom name="g" type="mesh" mesh="rod"/>\1', ["rod", "mesh", "<inertial>"]),
                (r'anchor="\S+', 'anchor="nan', ["nan"]),
                (r'anchor="\S+', 'anchor="0x10', ["0x10"]),
                (r'body1="\w+"', 'body1="platfrom"', ["platfrom", "did you mean 'platform'"]),
                (r'<motor joint="leg6_j2"/>', "", ["5 driven joints", "leg6_j2", "--actuated"]),
                (r'<actuator>', '<actuator><muscle name="m" joint="leg1_j0"/>', ["muscle", "leg1_j0"]),
                (r"<freejoint/>", '<joint name="f" type="free" armature="0.5"/>', ["joint f", "free joint", "0.5"]),
                (r"<worldbody>", '<worldbody><joint name="w"/>', ['name="w"', "of the world"]),
                (r"<equality>", '<equality><weld name="g" body1="leg1_first" body2="leg1_second" relpose="0 0 0 0 1 0 0"/>', ["both of its sides", "leg1_"]),
                (r"<equality>", '<equality><weld name="g" site1="a" body1="leg1_first" relpose="0 0 0 1 0 0 0"/>', ["sites and relpose"]),
                (r"(<freejoint/>)", r'\1<frame><inertial pos="0 0 0" mass="1"/></frame>', ["<inertial>", "<frame>"]),
                (r'<motor joint="leg6_j2"/>', '<motor joint="leg6_j2" armature="2"/>', ["armature 2", "actuator"]),
                (r'pos="\S+', 'pos="1e200', ["pos has 1e200", "1e+12"]),
                (r"<option ", '<option viscosity="0.1" ', ["viscosity"])):
            with self.subTest(words=words):
                self.refused(self.changed(whole, pattern, to), "m.xml", words)

    def test_sdf(self):
        whole = sdf()
        drives = ("--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))
        self.refused(whole, "m.sdf", ["0 driven joints", "leg1_j2,leg2_j2,leg3_j2,leg4_j2,leg5_j2,leg6_j2"])
        for pattern, to, words in (
                (r'(<link name="leg1_first">)', r"\1<gravity>false</gravity>", ["leg1_first", "gravity"]),
                (r"<dynamics>", "<dynamics><spring_stiffness>2.5</spring_stiffness>", ["spring", "2.5"]),
                (r'name="leg2_j2" type="prismatic"', 'name="leg2_j2" type="screw"', ["leg2_j2", "screw"]),
                (r"<model ", "<include><uri>model://legs</uri></include><model ", ["model://legs"]),
                (r'<sdf version="1\.\d+"', '<sdf version="2.0"', ["2.0"]),
                (r"<axis2>.*?</axis2>", "", ["axis2", "unfinished"]),
                (r"<parent>platform</parent>|<child>platform</child>", "", ["expected a link's name"]),
                (r"<gravity>", "<gravity>1 2 3</gravity><gravity>", ["second <gravity>"]),
                (r"<gravity>", "<physics><gravity>1 2 3</gravity></physics><gravity>", ["second <gravity>"]),
                (r"</world>", "<state><model name='machine'><pose>1 0 0 0 0 0</pose></model></state></world>", ["<state>", "pose"]),
                (r"</model>", "<gearbox><a>leg1_first</a><b>leg2_first</b></gearbox></model>", ["<gearbox>", "leg1_first", "leg2_first"]),
                (r"<limit>.*?</limit>", "<limit><lower>1</lower><upper>-1</upper></limit>", ["lower limit, 1,", "upper one, -1"]),
                (r"(<pose[^>]*>)\S+", r"\1 1e200", ["<pose> has 1e200"]),
                (r'<joint name="ground"', '<joint name="leg1_j2"', ["leg1_j2", "second"])):
            with self.subTest(words=words):
                self.refused(self.changed(whole, pattern, to), "m.sdf", words, *drives)
        self.refused(whole, "m.sdf", ["leg1_j9", "did you mean"], "--actuated", "leg1_j9")
        self.refused(whole.replace("<world ", "<%= 1 %><world "), "m.sdf", ["ERB", "erb m.sdf"])

    def test_urdf(self):
        whole = urdf()
        for pattern, to, words in (
                (r'(<joint name="leg2_j2".*?)</joint>', r'\1<mimic joint="leg1_j2"/></joint>', ["leg2_j2", "mimic"]),
                (r'type="prismatic"', 'type="planar"', ["planar"]),
                (r"<robot ", '<robot xmlns:xacro="http://x"><xacro:x/><robot ', ["xacro m.urdf"]),
                (r"<drake:ball_constraint>.*?</drake:ball_constraint>", "", ["ends at body", "--close"]),
                (r"</robot>", '<gazebo reference="leg2_first"><turnGravityOff>true</turnGravityOff></gazebo></robot>', ["leg2_first", "gravity"]),
                (r'<parent link="base"/>', '<parent link="bse"/>', ["bse", "did you mean 'base'"])):
            with self.subTest(words=words):
                self.refused(self.changed(whole, pattern, to), "m.urdf", words)

    def test_texts_in_pieces(self):
        """Readers differ in which piece they take; a comment beside a whole text, and CDATA, are none."""
        whole, drives = sdf(), ("--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))
        mass = re.search("<mass>(.)(.*?)</mass>", whole)
        for between in ("<!-- x -->", "<x/>", "<![CDATA[1]]>"):
            with self.subTest(between=between):
                text = whole.replace(mass[0], f"<mass>{mass[1]}{between}{mass[2]}</mass>", 1)
                self.refused(text, "m.sdf", ["<mass>", "in pieces", f":{text[:text.index(between)].count(chr(10)) + 1}:"], *drives)
        plain = self.call(whole, "m.sdf", *drives)[1].read_text()
        for one in ("<!-- kg -->{}<!-- x -->", "<![CDATA[{}]]>"):
            text = whole.replace(mass[0], "<mass>" + one.format(mass[1] + mass[2]) + "</mass>", 1)
            self.assertEqual(self.call(text, "m.sdf", *drives)[1].read_text(), plain)

    def test_what_couples_links_in_urdf(self):
        """An unknown element is refused if it names two links or joints, and listed if it names one; so are texts."""
        ends = '<a link="{}"/><b joint="{}"/>'
        for name in ("coupling", "loop", "other:gear"):
            text = urdf().replace("</robot>", f'<{name} name="g">{ends.format("leg1_first", "leg2_j2")}</{name}></robot>')
            line = text[:text.index('name="g"')].count("\n") + 1
            self.refused(text, "m.urdf", [f'<{name} name="g">', "leg1_first", "leg2_j2", f":{line}:"])
        self.refused(urdf().replace("</robot>", "<gear><a>leg1_first</a><b>leg2_first</b></gear></robot>"), "m.urdf", ["<gear>", "leg2_first"])
        for more in (ends.format("leg1_first", "none"), ends.format("leg1_first", "leg1_first")):
            done, out = self.call(urdf().replace("</robot>", f"<coupling>{more}</coupling></robot>"), "m.urdf")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("<coupling>, which is left out", done.stderr)
            out.unlink()
        done, out = self.call(urdf().replace("</robot>", f"<disable_collisions>{ends.format('leg1_first', 'leg2_j2')}</disable_collisions></robot>"), "m.urdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        out.unlink()
        closed = urdf("constraint")
        done, out = self.call(closed, "m.urdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        out.unlink()
        self.refused(closed.replace('type="spherical"', 'type="gear"', 1), "m.urdf", ["a gear constraint", "spherical"])
        self.refused(self.changed(urdf(), r"(<transmission .*?<actuator)", r'\1 name="other"/><actuator'), "m.urdf", ["second <actuator>", "couples"])

    def test_a_link_that_leads_out_of_the_folder(self):
        """Nothing of its target is printed; one within the folder is read."""
        folder = Path(self.folder.name)
        (folder / "model").mkdir()
        (folder / "secret.txt").write_text("root:x:0:0\n")
        link = folder / "model" / "robot.yaml"
        link.symlink_to(folder / "secret.txt")
        done, out = self.call(urdf("close"), "model/m.urdf")
        self.assertEqual((done.returncode, out.exists()), (2, False))
        self.assertIn("robot.yaml beside it is a link that leads out of its folder", done.stderr)
        self.assertNotIn("root", done.stderr)
        link.unlink()
        pairs = re.findall(r'<link name="(\w+_end1)"', urdf("close"))
        (folder / "model" / "own.yaml").write_text(f"closed_loop: [{', '.join(f'[{a}, {a[:-1]}2]' for a in pairs)}]\ntype: [3d]\n")
        link.symlink_to("own.yaml")
        done, _ = self.call(urdf("close"), "model/m.urdf")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_frames_of_joints_in_gazebo(self):
        """Where the joint is in another frame than its child's, it is not read."""
        whole = urdf("gazebo")
        self.assertEqual(self.call(whole, "m.urdf")[0].returncode, 0)
        Path(self.folder.name, "out.toml").unlink()
        self.refused(self.changed(whole, "<pose>", '<pose relative_to="base">'), "m.urdf", ["relative_to='base'"])
        hinge = '</pose><axis><xyz expressed_in="base">0 0 1</xyz></axis>'
        self.refused(self.changed(whole, "</pose>", hinge), "m.urdf", ["expressed_in='base'"])

    def test_an_axis_of_zero(self):
        """CAD writes it for fixed joints, which have none; a hinge needs one."""
        fixed = self.changed(urdf(), r'(<joint name="platform_mount".*?)</joint>', r'\1<axis xyz="0 0 0"/></joint>')
        self.assertEqual(self.call(fixed, "m.urdf")[0].returncode, 0)
        Path(self.folder.name, "out.toml").unlink()
        self.refused(self.changed(urdf(), r'<axis xyz="[^"]*"', '<axis xyz="0 0 0"'), "m.urdf", ["axis is zero"])

    def test_limits_of_urdf(self):
        """A missing one is zero, as urdfdom has it; a lower one above the upper one is refused."""
        limited = lambda text: self.changed(re.sub(r"<limit[^>]*/>", "", urdf()), r'(<joint name="leg2_j2".*?)</joint>', rf"\1<limit {text}/></joint>")
        self.refused(limited('lower="1" upper="-1"'), "m.urdf", ["leg2_j2", "lower limit, 1", "upper one, -1"])
        self.refused(limited('upper="-1"'), "m.urdf", ["leg2_j2", "lower limit, 0", "upper one, -1"])
        self.assertEqual(self.call(limited('lower="-1" upper="1"'), "m.urdf")[0].returncode, 0)

    def test_messages_are_bounded(self):
        """20,000 motors on one joint are said in one line; long names and numbers are cut."""
        many = self.changed(mjcf(), "</actuator>", '<motor joint="leg1_j2"/>' * 20000 + "</actuator>")
        done, _ = self.call(many, "m.xml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("Several actuators"), 1)
        self.assertIn("20000", done.stderr)
        self.assertLess(len(done.stderr), 20000)
        for text in (self.changed(mjcf(), r'<joint name="leg1_j2"', '<joint stiffness="1' + "0" * 100000 + '" name="leg1_j2"'),
                     self.changed(mjcf(), r'<joint name="leg1_j2"', f'<joint springdamper="1 0.{"0" * 100000}1" name="leg1_j2"')):
            done, _ = self.call(text, "m.xml")
            self.assertEqual(done.returncode, 2)
            self.assertLess(len(done.stderr), 6000)

    def test_other_machines_than_six_motors_on_legs(self):
        """Motors and freedoms are counted first; a rod that turns with the platform's joint is no cross of a ball."""
        case = lambda name: (CASES / name).read_text()
        self.refused(case("fivebar.xml"), "m.xml", ["2 motors (lm, rm) and 2 freedoms", "six motors"])
        self.refused(case("delta.xml"), "m.xml", ["3 motors (m0, m1, m2) and 3 freedoms", "six motors"])
        self.refused(case("no-inertial.urdf"), "m.urdf", ["has a mass", "<inertial>"])
        for options in ((), ("--lump", "1")):
            self.refused(case("ucu.xml"), "m.xml", ["R R P R R R", "w0, p0 and r0", "up0", "no cross", "U C U"], *options)
        self.refused(case("ball-of-hinges-that-miss.xml"), "m.xml", ["p0, r0 and w0", "no ball", "0.04 m"])
        self.refused(self.changed(mjcf(), r'<motor joint="leg6_j2"/>', ""), "m.xml", ["5 driven joints"])

    def test_names_of_base_and_platform(self):
        whole = mjcf()
        self.refused(whole, "m.xml", ["--base", "bass", "did you mean 'base'"], "--base", "bass")
        self.refused(whole, "m.xml", ["--platform", "is the base"], "--platform", "base")

    def test_geometry(self):
        """A skew universal joint, a slide off its line: the distance and the angle are said."""
        bodies, joints, machine, rng = machine_of()
        joints[1]["centre"] = joints[1]["centre"] + 0.075 * np.cross(joints[0]["axis"], joints[1]["axis"])
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        self.refused(text, "m.xml", ["leg1_j0", "leg1_j1", "0.075 m", "90°", "--tolerance"])
        bodies, joints, machine, rng = machine_of()
        joints[1]["axis"] = machines.rotation(np.cross(joints[0]["axis"], joints[1]["axis"]), np.radians(40)) @ joints[1]["axis"]
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        self.refused(text, "m.xml", ["leg1_j0", "leg1_j1", "50°"])
        bodies, joints, machine, rng = machine_of()
        joints[2]["axis"] = machines.rotation(joints[1]["axis"], np.radians(3)) @ joints[2]["axis"]
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        self.refused(text, "m.xml", ["leg1_j2", "3°"])

    def test_a_tolerance_that_is_used_is_said(self):
        bodies, joints, machine, rng = machine_of()
        joints[1]["axis"] = machines.rotation(np.cross(joints[0]["axis"], joints[1]["axis"]), 1e-3) @ joints[1]["axis"]
        text = files.write_mjcf(bodies, joints, machine["gravity"], rng)
        self.refused(text, "m.xml", ["leg1_j0", "--tolerance"])
        done, out = self.call(text, "m.xml", "--tolerance", "0.01")
        self.assertEqual((done.returncode, out.exists()), (0, True), done.stderr)
        self.assertRegex(done.stderr, r"leg1_j0, leg1_j1: .* square \(0\.00[0-9]+ rad\)")

    def test_loops_in_a_second_tools_words(self):
        """The same loops are listed as left out; one more is refused."""
        whole = urdf()
        loop = '<loop_joint name="more" type="spherical"><link1 link="{}"/><link2 link="{}"/></loop_joint></robot>'
        ends = re.search(r'ball_constraint_body_A name="(.*?)"/><drake:ball_constraint_body_B name="(.*?)"/>', whole)
        self.assertIsNotNone(ends, whole[-2000:])
        done, out = self.call(whole.replace("</robot>", loop.format(*ends.groups())), "m.urdf")
        self.assertIn("another tool's words", done.stderr)
        out.unlink()
        self.refused(whole.replace("</robot>", loop.format("leg1_first", "leg2_first")), "m.urdf", ["more", "leg1_first", "leg2_first"])

    def test_unknown_words_are_listed(self):
        for text, name, words in ((self.changed(mjcf(), '<joint name="leg1_j2"', '<joint dmaping="3" name="leg1_j2"'), "m.xml", "dmaping"),
                                  (self.changed(sdf(), "<inertial>", "<inertial><maas>3</maas>"), "m.sdf", "<maas>")):
            drive = re.findall(r'<joint name="(leg\d_j\d)" type="prismatic"', text) if name == "m.sdf" else []
            done, _ = self.call(text, name, *(("--actuated", ",".join(drive)) if drive else ()))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(words, done.stderr)

    def test_springs_and_old_files(self):
        self.refused(self.changed(mjcf(), '<joint name="leg1_j2"', '<joint springdamper="1 1" name="leg1_j2"'), "m.xml",
                     ["leg1_j2", "springdamper"])
        self.refused(re.sub(r'<sdf version="[0-9.]+"', '<sdf version="1.0"', sdf()), "m.sdf", ["1.0", "gz sdf"])
        self.refused(re.sub(r'<sdf version="[0-9.]+"', '<sdf version="1.99"', sdf()), "m.sdf", ["1.99", "1.12"])

    def test_frames_of_sdf_before_1_7(self):
        """Readers differ in what they make of a frame's name there."""
        model = ('<sdf version="{}"><model name="m"><link name="a"/><link name="b"><pose {}>0 0 0 0 0 0</pose></link><joint name="j" type="revolute">'
                 "<parent>a</parent><child>b</child><axis><xyz {}>0 0 1</xyz></axis></joint></model></sdf>")
        for pose, xyz, word in (('relative_to="a"', "", "relative_to"), ('frame="a"', "", "frame"), ("", 'expressed_in="a"', "expressed_in")):
            with self.subTest(word=word):
                self.refused(model.format("1.6", pose, xyz), "m.sdf", [f"{word}='a'", "1.7"])
                self.refused(model.format("1.7", pose, xyz), "m.sdf", ["--base"])  # not for the frame's name
        self.refused(model.format("1.6", 'frame=""', ""), "m.sdf", ["--base"])

    def test_what_would_change_torques_in_urdf(self):
        """MuJoCo's settings as MuJoCo reads them; forces and bodies that <gazebo> adds."""
        whole = urdf()
        shape = "<collision><geometry><sphere radius='1'/></geometry></collision>"
        box = f'<link name="box">{shape}</link><joint name="j" type="fixed"><parent link="leg1_first"/><child link="box"/></joint>'
        on = '<gazebo reference="leg2_{}">{}</gazebo>'
        for more, words in (("<mujoco/><mujoco/>", ["second <mujoco>"]), ('<mujoco><compiler settotalmass="7"/></mujoco>', ["settotalmass 7"]),
                            ('<mujoco><option viscosity="1"/></mujoco>', ["viscosity"]), (box + "<mujoco/>", ["box", "<collision>"]),
                            ('<mujoco><compiler boundinertia="40"/></mujoco>', ["--lump"]),
                            (on.format("j2", "<axis><dynamics><damping>1</damping></dynamics></axis>"), ["leg2_j2", "<axis>"]),
                            (on.format("first", "<dampingFactor>0.25</dampingFactor>"), ["decay", "0.25"]),
                            (on.format("first", "<velocity_decay><linear>0.25</linear></velocity_decay>"), ["decay", "0.25"]),
                            ('<gazebo><plugin filename="libmimic_joint.so"/></gazebo>', ["libmimic_joint.so", "follow"]),
                            ('<gazebo><plugin filename="libjoint_spring.so"/></gazebo>', ["libjoint_spring.so", "pulls"]),
                            ('<gazebo><link name="extra"/></gazebo>', ["extra", "<gazebo>"]),
                            ('<ros2_control><joint name="leg2_j2"><param name="mimic">leg1_j2</param></joint></ros2_control>', ["leg2_j2", "mimic"])):
            with self.subTest(words=words):
                self.refused(whole.replace("</robot>", more + "</robot>"), "m.urdf", words)
        for more in ('<mujoco><compiler discardvisual="false" angle="degree" boundmass="1e-9"/></mujoco>', box,
                     box + '<mujoco><compiler inertiafromgeom="false"/></mujoco>', on.format("first", "<dampingFactor>0</dampingFactor>")):
            with self.subTest(more=more):
                done, _ = self.call(whole.replace("</robot>", more + "</robot>"), "m.urdf")
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_unknown_words_of_urdf_are_listed(self):
        whole = urdf()
        for pattern, to, words in ((r'(<link name="leg1_first">)', r"\1<inertal/>", "<inertal>"), (r"</robot>", "<property/></robot>", "<property>"),
                                   (r"</robot>", '<gazebo><plugin filename="libwind.so"/></gazebo></robot>', "libwind.so"),
                                   (r'<dynamics damping', "<dynamics dmaping", "dmaping")):
            done, _ = self.call(self.changed(whole, pattern, to), "m.urdf")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(words, done.stderr)

    def test_ends_that_coincide_are_offered(self):
        open_loops = urdf("close")
        pair = re.findall(r'<link name="(\w+_end1)"', open_loops)
        self.assertEqual(len(pair), 5)
        self.refused(open_loops, "m.urdf", [f"--close {pair[0]}:{pair[0][:-1]}2"])

    def test_sdf_as_libsdformat_refuses_it(self):
        """Frames that nothing uses; a ball that rubs; a decay of velocity. Blanks between names are none of these."""
        names = [f"leg{i}_j2" for i in range(1, 7)]
        whole = sdf()
        for pattern, to, words in ((r"</model>", '<frame name="f" attached_to="none"/></model>', ["none"]),
                                   (r"</model>", '<frame name="f" attached_to="g"/><frame name="g" attached_to="f"/></model>', ["circle"]),
                                   (r"<model ", '<model canonical_link="none" ', ["canonical_link", "none"]),
                                   (r'(<joint name="\w+" type="ball">)', r"\1<axis><dynamics><damping>2</damping></dynamics></axis>", ["rubs", "2"]),
                                   (r'(<link name="leg1_first">)', r"\1<velocity_decay><angular>2</angular></velocity_decay>", ["decay", "2"])):
            with self.subTest(words=words):
                self.refused(self.changed(whole, pattern, to), "m.sdf", words, "--actuated", ",".join(names))
        done, _ = self.call(whole, "m.sdf", "--actuated", ", ".join(names))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_is_given_twice(self):
        drives = ("--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))
        for pattern, word in ((r"(<mass>.*?</mass>)", "mass"), (r"(<inertial>.*?</inertial>)", "inertial"), (r"(<axis>.*?</axis>)", "axis"),
                              (r"(<parent>.*?</parent>)", "parent")):
            with self.subTest(word=word):
                self.refused(self.changed(sdf(), f"(?s){pattern}", r"\1\1"), "m.sdf", [f"second <{word}>"], *drives)
        for pattern, word in ((r"(<inertial>.*?</inertial>)", "inertial"), (r"(<origin [^>]*/>)", "origin"), (r"(<axis [^>]*/>)", "axis"),
                              (r"(<parent [^>]*/>)", "parent")):
            with self.subTest(word=word):
                self.refused(self.changed(urdf(), f"(?s){pattern}", r"\1\1"), "m.urdf", [f"second <{word}>"])

    def test_a_joint_that_cannot_move(self):
        drives = ("--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))
        still = "<limit><lower>0.5</lower><upper>0.5</upper></limit>"
        whole = re.sub(r"(?s)<limit>.*?</limit>", "", sdf())
        self.refused(self.changed(whole, "</axis>", still + "</axis>"), "m.sdf", ["cannot move", "0.5", "fixed"], *drives)
        text = self.changed(re.sub(r"<limit[^>]*/>", "", urdf()), r'(<joint name="leg2_j2".*?)</joint>',
                            r'\1<limit lower="0" upper="0" effort="1" velocity="1"/></joint>')
        done, _ = self.call(text, "m.urdf")
        self.assertRegex(done.stderr, "leg2_j2: The file's limits hold this joint")

    def test_numbers_that_urdf_needs(self):
        whole = urdf()
        for pattern, to, words in (
                (r"<inertia [^>]*/>", "", ["no <inertia>"]),
                (r' ixx="[^"]*"', "", ["ixx"]),
                (r'<origin [^>]*rpy="[^"]*"', '<origin rpy=""', ["rpy has 0 numbers"]),
                (r"<origin ", '<origin quat_xyzw="0 0 0 1" ', ["quat_xyzw", "xyz and rpy"]),
                (r"</robot>", "<drake:coupler_constraint/></robot>", ["drake:coupler_constraint"]),
                (r"</robot>", "<gazebo><static>true</static></gazebo></robot>", ["static", "moves"]),
                (r"</robot>", '<gazebo reference="leg1_first"><kinematic>1</kinematic></gazebo></robot>', ["kinematic", "leg1_first"])):
            with self.subTest(words=words):
                self.refused(self.changed(whole, pattern, to), "m.urdf", words)
        done, out = self.call(self.changed(whole, r' ixy="[^"]*"', ""), "m.urdf")
        self.assertIn("gives no ixy", done.stderr)

    def test_what_no_scenario_may_have(self):
        """Nothing is written that the program would not read."""
        rotor = r'\1<drake:rotor_inertia value="-0.5"/>'
        self.refused(self.changed(urdf(), r"(<actuator [^>]*>)", rotor), "m.urdf", ["rotor", "-0.5"])
        self.refused(self.changed(mjcf(), r'<joint name="leg1_j2"', '<joint armature="-0.5" name="leg1_j2"'), "m.xml", ["-0.5"])

    def test_what_mjcf_files_have_beside_the_machine(self):
        """A marker that the mouse moves, words of other tools, and inertiafromgeom with bodies that have no geoms."""
        whole = mjcf()
        done, out = self.call(whole, "m.xml")
        plain = out.read_text().split("\nname =")[1]
        for pattern, to, words in ((r"<worldbody>", '<worldbody><body name="target" mocap="true"><site/></body>', "target: .*mocap"),
                                   (r"<worldbody>", "<wurst/><worldbody>", "<wurst>"),
                                   (r"<compiler ", '<compiler inertiafromgeom="true" ', "^")):
            with self.subTest(words=words):
                done, out = self.call(self.changed(whole, pattern, to), "m.xml")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stderr, words)
                self.assertEqual(out.read_text().split("\nname =")[1], plain)

    def test_worlds(self):
        """Light, floor and plugins of a world are listed; other models are not fetched."""
        drives = ("--actuated", ",".join(f"leg{i}_j2" for i in range(1, 7)))
        include = "<include><uri>model://{}</uri></include><model "
        text = self.changed(sdf(), "<model ", include.format("sun") + '')
        self.assertIn("<world", text)
        done, _ = self.call(self.changed(text, "</model>(?!.*</model>)", '<plugin name="p" filename="libBuoyancy.so"/></model>'), "m.sdf", *drives)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("model://sun is left out", done.stderr)
        self.assertIn("libBuoyancy.so", done.stderr)

    def test_a_platform_that_stands_still(self):
        whole = self.changed(mjcf(), "<freejoint/>", "")
        self.refused(whole, "m.xml", ["no platform", "base, platform, has", "three joints", "a joint of its own"])

    def test_closures_and_actuators_of_mjcf(self):
        """Unknown words of a closure and a second actuator of a joint are said; a range that ends before it begins is refused."""
        whole = mjcf()
        bad = self.changed(whole, r'<joint name="leg1_j0"', '<joint limited="true" range="0.3 0.2" name="leg1_j0"')
        self.refused(bad, "m.xml", ["range"])
        done, _ = self.call(self.changed(whole, "<connect ", '<connect relpose="0 0 0 1 0 0 0" '), "m.xml")
        self.assertIn("attribute relpose", done.stderr)
        done, _ = self.call(self.changed(whole, "</actuator>", '<motor joint="leg1_j2"/></actuator>'), "m.xml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("leg1_j2: Several actuators", done.stderr)
        plain, _ = self.call(whole, "m.xml")
        for words in ("attribute relpose", "Several actuators"):
            self.assertNotIn(words, plain.stderr)

    def test_files(self):
        bomb = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">' + "".join(
            f'<!ENTITY {chr(98 + k)} "{("&" + chr(97 + k) + ";") * 10}">' for k in range(9)) + "]><sdf version='1.7'>&j;</sdf>"
        deep = "<sdf version='1.7'>" + "<model name='m'>" * 5000 + "</model>" * 5000 + "</sdf>"
        crowd = "<mujoco><worldbody>" + "<body><joint/></body>" * 100000 + "</worldbody></mujoco>"
        circle = ('<sdf version="1.7"><model name="m"><link name="a"><pose relative_to="b">0 0 0 0 0 0</pose></link>'
                  '<link name="b"><pose relative_to="a">0 0 0 0 0 0</pose></link></model></sdf>')
        for text, words in ((bomb, ["entity"]), (deep, ["nested deeper"]), (crowd, []), (circle, ["circle"]), ("", []), ("<a", ["XML"]),
                            ("<html/>", ["<html>", "<sdf>"]), ("<sdf version='1.7'/>", ["no <model>"]), ("x" * (9 << 20), ["bytes"])):
            with self.subTest(text=text[:40]):
                self.refused(text, "m.sdf", words)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
