"""Writes bodies and joints (import_machines.py) as SDF of any version, MJCF and URDF, with the conventions chosen at random."""

import numpy as np

from import_machines import random_rotation


def num(values):
    return " ".join(repr(float(v)) for v in np.atleast_1d(values))


def rpy(R):
    """R = Rz Ry Rx; two roads of arcs, as one loses digits at right angles."""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


def quat(R):
    """Of the largest of four forms."""
    K = np.array([[R[0, 0] - R[1, 1] - R[2, 2], R[1, 0] + R[0, 1], R[2, 0] + R[0, 2], R[2, 1] - R[1, 2]],
                  [R[1, 0] + R[0, 1], R[1, 1] - R[0, 0] - R[2, 2], R[2, 1] + R[1, 2], R[0, 2] - R[2, 0]],
                  [R[2, 0] + R[0, 2], R[2, 1] + R[1, 2], R[2, 2] - R[0, 0] - R[1, 1], R[1, 0] - R[0, 1]],
                  [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], R.trace()]]) / 3
    x, y, z, w = np.linalg.eigh(K)[1][:, -1]
    return np.array([w, x, y, z])


def inverse(T):
    return -T[1].T @ T[0], T[1].T


def times(T, U):
    return T[0] + T[1] @ U[0], T[1] @ U[1]


def relative(T, U):
    """U as T has it."""
    return times(inverse(T), U)


WORLD = (np.zeros(3), np.eye(3))
ENTRIES = [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)]


# --- SDF ---------------------------------------------------------------------------------------------------------------

def sdf_pose(T, rng, version, attributes=""):
    if version >= 9 and rng.uniform() < 0.3:
        q = quat(T[1])
        return f'<pose rotation_format="quat_xyzw"{attributes}>{num(T[0])} {num(q[1:])} {num(q[0])}</pose>'
    angles = rpy(T[1])
    if version >= 9 and rng.uniform() < 0.5:
        return f'<pose degrees="true"{attributes}>{num(T[0])} {num(np.degrees(angles))}</pose>'
    return f"<pose{attributes}>{num(T[0])} {num(angles)}</pose>"


def sdf_joint(rng, version, name, kind, parent, child, T_parent_model, T_child, centre, axes, properties):
    """`T_…` in the world. The joint's own frame is turned at random within the child's."""
    T_joint = (centre, random_rotation(rng))
    model_axes = T_parent_model[1].T
    out = f'<joint name="{name}" type="{kind}"><parent>{parent}</parent><child>{child}</child>'
    if version >= 7 and rng.uniform() < 0.5:
        out += sdf_pose(relative(T_parent_model, T_joint), rng, version, ' relative_to="__model__"')
    else:
        out += sdf_pose(relative(T_child, T_joint), rng, version)
    for tag, axis, extra in zip(("axis", "axis2"), axes, properties):
        flag, attributes = "", ""
        in_joint = T_joint[1].T @ axis
        if version <= 4:
            xyz = model_axes @ axis
        elif version <= 6 and rng.uniform() < 0.5:
            xyz, flag = model_axes @ axis, "<use_parent_model_frame>true</use_parent_model_frame>"
        elif version >= 7 and rng.uniform() < 0.5:
            xyz, attributes = T_child[1].T @ axis, f' expressed_in="{child}"'
        else:
            xyz = in_joint
        out += f"<{tag}><xyz{attributes}>{num(xyz * rng.uniform(0.5, 2))}</xyz>{flag}{extra}</{tag}>"
    return out + "</joint>"


def axis_extra(joint, rng):
    lower, upper = joint.get("limits", (-1e16, 1e16))
    return (f"<limit><lower>{num(lower)}</lower><upper>{num(upper)}</upper></limit>"
            f"<dynamics><damping>{num(joint['friction'])}</damping></dynamics>")


def write_sdf(bodies, joints, gravity, rng):
    minor = int(rng.choice([4, 5, 6, 7, 8, 9, 10]))
    T_model = (rng.normal(size=3), random_rotation(rng))  # the model stands anywhere; the scenario's B is the world
    links, out, rest = {}, "", ""
    for b in bodies.values():
        name = b["name"]
        T_inertial = (b["com"], random_rotation(rng))
        I = T_inertial[1].T @ b["I"] @ T_inertial[1]
        out += f'<link name="{name}">'
        if minor >= 7 and links and rng.uniform() < 0.3:
            other = list(links)[rng.integers(len(links))]
            out += sdf_pose(relative(links[other], b["T"]), rng, minor, f' relative_to="{other}"')
        else:
            out += sdf_pose(relative(T_model, b["T"]), rng, minor)
        links[name] = b["T"]
        out += f"<inertial>{sdf_pose(relative(b['T'], T_inertial), rng, minor)}<mass>{num(b['mass'])}</mass><inertia>"
        out += "".join(f"<i{n}>{num(I[i, j])}</i{n}>" for n, i, j in ENTRIES) + "</inertia></inertial></link>\n"
        if "fixed_to" in b:
            rest += f'<joint name="{name}_fixed" type="fixed"><parent>{b["fixed_to"]}</parent><child>{name}</child></joint>\n'
    rest += '<joint name="ground" type="fixed"><parent>world</parent><child>base</child></joint>\n'
    k = 0
    while k < len(joints):
        j = joints[k]
        two = joints[k + 1] if k + 1 < len(joints) and j["to"] is None else None
        a, b = j["from"], (two or j)["to"]
        sign = 1
        if rng.uniform() < 0.3:  # the child may be the one towards the base
            a, b, sign = b, a, -1
        kind = {"R": "revolute", "P": "prismatic", "S": "ball"}[j["kind"]]
        axes = [] if j["kind"] == "S" else [sign * j["axis"]]
        extras = [axis_extra(j, rng)]
        if two:
            kind = str(rng.choice(["universal", "revolute2"]))
            axes, extras = [sign * j["axis"], sign * two["axis"]], [axis_extra(j, rng), axis_extra(two, rng)]
            if sign < 0:
                axes, extras = axes[::-1], extras[::-1]
            j["name_in_file"] = j["name"] + ("/axis" if sign > 0 else "/axis2")
        rest += sdf_joint(rng, minor, j["name"], kind, a, b, T_model, links[b], j["centre"], axes, extras) + "\n"
        k += 2 if two else 1
    model = f'<model name="machine">{sdf_pose(T_model, rng, minor)}\n{out}{rest}</model>'
    return f'<?xml version="1.0"?>\n<sdf version="1.{minor}"><world name="w"><gravity>{num(gravity)}</gravity>{model}</world></sdf>\n'


# --- MJCF --------------------------------------------------------------------------------------------------------------

class Mjcf:
    def __init__(self, rng):
        self.rng = rng
        self.degrees = bool(rng.integers(2))
        self.sequence = "".join(rng.choice(list("xyz"), 3)) if rng.uniform() < 0.5 else "XYZ"
        if len(set(self.sequence.lower())) < 3:
            self.sequence = "zyx"

    def angle(self, a):
        return np.degrees(a) if self.degrees else a

    def euler(self, R):
        s = self.sequence
        if s == "XYZ":  # about fixed axes: R = Rz Ry Rx
            return rpy(R)
        if s == "zyx":
            return rpy(R)[::-1]
        return None

    def orientation(self, R):
        way = self.rng.integers(4)
        if way == 0 and (angles := self.euler(R)) is not None:
            return f'euler="{num(self.angle(angles))}"'
        if way == 1:
            return f'xyaxes="{num(R[:, 0] * 2)} {num(R[:, 1] + 0.3 * R[:, 0])}"'
        if way == 2:
            w, *v = quat(R)
            n = np.linalg.norm(v)
            if n > 1e-3:
                return f'axisangle="{num(np.array(v) / n)} {num(self.angle(2 * np.arctan2(n, w)))}"'
        return f'quat="{num(quat(R) * 3)}"'

    def place(self, T):
        return f'pos="{num(T[0])}" {self.orientation(T[1])}'

    def inertial(self, b):
        c = relative(b["T"], (b["com"], np.eye(3)))[0]
        local = b["T"][1].T @ b["I"] @ b["T"][1]
        if self.rng.uniform() < 0.5:
            return f'<inertial pos="{num(c)}" mass="{num(b["mass"])}" fullinertia="{num([local[i, j] for _, i, j in ENTRIES])}"/>'
        w, V = np.linalg.eigh(local)
        if np.linalg.det(V) < 0:
            V[:, 0] *= -1
        return f'<inertial pos="{num(c)}" mass="{num(b["mass"])}" diaginertia="{num(w)}" {self.orientation(V)}/>'

    def joint(self, j, T, sign=1):
        pos, axis = T[1].T @ (j["centre"] - T[0]), T[1].T @ j["axis"] * sign
        kind = {"R": "hinge", "P": "slide"}[j["kind"]]
        out = f'<joint name="{j["name"]}" type="{kind}" pos="{num(pos)}" axis="{num(axis * 2)}" '
        own = j["friction"]
        out += 'class="rub"' if own == 0.5 else f'damping="{num(own)}"'
        if j["rotor"]:
            out += f' armature="{num(j["rotor"])}"'
        if j["position"]:
            out += f' ref="{num(j["position"])}"'
        if "limits" in j:
            out += f' limited="true" range="{num(j["limits"])}"'
        return out + "/>"


def write_mjcf(bodies, joints, gravity, rng, actuators=True):
    m = Mjcf(rng)
    children = {}
    for b in bodies.values():
        if "fixed_to" in b:
            children.setdefault(b["fixed_to"], []).append((b["name"], []))
    pending, chain = [], {}
    for j in joints:
        pending.append(j)
        if j["kind"] == "S":
            pending = []
        elif j["to"] is not None:
            children.setdefault(j["from"] if len(pending) == 1 else pending[0]["from"], []).append((j["to"], pending))
            pending = []

    def body(name, parent_T, own):
        b = bodies[name]
        out = f'<body name="{name}" {m.place(relative(parent_T, b["T"]))}>'
        out += "".join(m.joint(j, b["T"]) for j in own) + m.inertial(b)
        return out + "".join(body(n, b["T"], js) for n, js in children.get(name, [])) + "</body>\n"

    world = body("base", WORLD, []) + body("platform", WORLD, []).replace("<inertial", "<freejoint/><inertial", 1)
    equality = ""
    for j in joints:
        if j["kind"] != "S":
            continue
        first, second = (j["from"], "platform") if rng.uniform() < 0.5 else ("platform", j["from"])
        T = bodies[first]["T"]
        equality += f'<connect name="{j["name"]}" body1="{first}" body2="{second}" anchor="{num(T[1].T @ (j["centre"] - T[0]))}"/>\n'
    motors = "".join(f'<motor joint="{j["name"]}"/>' for j in joints if j["driven"]) if actuators else ""
    return (f'<mujoco model="machine"><compiler angle="{"degree" if m.degrees else "radian"}" eulerseq="{m.sequence}"/>'
            f'<option gravity="{num(gravity)}"/>'
            f'<default><joint damping="0"/><default class="rub"><joint damping="0.5"/></default></default>\n'
            f"<worldbody>{world}</worldbody><equality>{equality}</equality><actuator>{motors}</actuator></mujoco>\n")


# --- URDF --------------------------------------------------------------------------------------------------------------

def origin(T):
    return f'<origin xyz="{num(T[0])}" rpy="{num(rpy(T[1]))}"/>'


def write_urdf(bodies, joints, rng, closure="drake", transmissions=True):
    """The platform hangs on the first leg by three hinges; the other legs are closed."""
    out, frames = "", {}

    def link(name, b=None):
        if b is None:
            return f'<link name="{name}"/>\n'
        T = (b["com"], random_rotation(rng))
        I = T[1].T @ b["I"] @ T[1]
        entries = " ".join(f'i{n}="{num(I[i, j])}"' for n, i, j in ENTRIES)
        return (f'<link name="{name}"><inertial>{origin(relative(frames[name], T))}<mass value="{num(b["mass"])}"/>'
                f"<inertia {entries}/></inertial></link>\n")

    def joint(name, kind, parent, child, axis=None, extra=""):
        xyz = "" if axis is None else f'<axis xyz="{num(frames[child][1].T @ axis)}"/>'
        return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
                f"{origin(relative(frames[parent], frames[child]))}{xyz}{extra}</joint>\n")

    # A link's frame is at its joint: bodies are given frames anew, but for base and platform.
    frames["base"] = bodies["base"]["T"]
    tail = ""
    last = {}
    hung = False
    for j in joints:
        parent = last.get(j["leg"]["name"], "base")
        if j["kind"] != "S":
            child = j["to"] or j["name"] + "_cross"
            frames[child] = (j["centre"], random_rotation(rng))
            kind = {"R": "continuous", "P": "prismatic"}[j["kind"]]
            extra = f'<dynamics damping="{num(j["friction"])}"/>'
            if "limits" in j:
                extra += f'<limit lower="{num(j["limits"][0])}" upper="{num(j["limits"][1])}" effort="100" velocity="1"/>'
            tail += joint(j["name"], kind, parent, child, j["axis"], extra)
            if child not in bodies:
                out += link(child)
            last[j["leg"]["name"]] = child
        elif not hung:
            hung = True
            R = random_rotation(rng)
            for k, name in enumerate(("ball_a", "ball_b", "ball_c")):
                frames[name] = (j["centre"], R if k < 2 else random_rotation(rng))
                tail += joint(f"{j['name']}_{k}", "continuous", parent, name, R[:, k])
                out += link(name)
                parent = name
            frames["platform"] = bodies["platform"]["T"]
            tail += joint("platform_mount", "fixed", "ball_c", "platform")
        else:
            tail += close(closure, j, parent, frames)
            if closure in ("names", "close"):
                for side, of in (("1", parent), ("2", "platform")):
                    name = f"closing_{j['name']}_{side}" if closure == "names" else f"{j['name']}_end{side}"
                    frames[name] = (j["centre"], random_rotation(rng))
                    out += link(name)
                    tail += joint(name + "_mount", "fixed", of, name)
    for b in bodies.values():
        if "fixed_to" in b:
            frames[b["name"]] = b["T"]
            tail += joint(b["name"] + "_fixed", "fixed", b["fixed_to"], b["name"])
        out += link(b["name"], b)
    if transmissions:
        for j in joints:
            if j["driven"]:
                rotor = f'<drake:rotor_inertia value="{num(j["rotor"] / 4)}"/><drake:gear_ratio value="2"/>' if j["rotor"] else ""
                tail += (f'<transmission name="t_{j["name"]}"><type>transmission_interface/SimpleTransmission</type>'
                         f'<joint name="{j["name"]}"/><actuator name="m_{j["name"]}">{rotor}</actuator></transmission>\n')
    return f'<?xml version="1.0"?>\n<robot xmlns:drake="http://drake.mit.edu" name="machine">\n{out}{tail}</robot>\n'


def close(closure, j, link, frames):
    points = [frames[b][1].T @ (j["centre"] - frames[b][0]) for b in (link, "platform")]
    if closure == "drake":
        return (f'<drake:ball_constraint><drake:ball_constraint_body_A name="{link}"/><drake:ball_constraint_body_B name="platform"/>'
                f'<drake:ball_constraint_p_AP value="{num(points[0])}"/><drake:ball_constraint_p_BQ value="{num(points[1])}"/>'
                "</drake:ball_constraint>\n")
    if closure == "isaac":
        return (f'<loop_joint name="{j["name"]}" type="spherical"><link1 link="{link}" xyz="{num(points[0])}" rpy="0 0 0"/>'
                f'<link2 link="platform" xyz="{num(points[1])}" rpy="0 0 0"/></loop_joint>\n')
    if closure == "constraint":
        return (f'<constraint name="{j["name"]}" type="spherical"><parent link="{link}"/><parent_origin xyz="{num(points[0])}" rpy="1 2 3"/>'
                f'<child link="platform"/><child_origin xyz="{num(points[1])}"/></constraint>\n')
    if closure == "gazebo":
        return (f'<gazebo><joint name="{j["name"]}" type="ball"><parent>{link}</parent><child>platform</child>'
                f"<pose>{num(points[1])} 0 0 0</pose></joint></gazebo>\n")
    return ""
