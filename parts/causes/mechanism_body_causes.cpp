#include <algorithm>
#include <cmath>
#include <string>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// One body at one instant, in world axes.
struct BodyView {
  Matrix3d R, own, I;  ///< from the reference pose; of the body's own axes; the tensor
  double mass;
  Vector3d omega, alpha, a, g;
  Vector3d arm;                 ///< to its mass centre from where the motion is known, which is another machine's
  Vector3d alpha_bias, a_bias;  ///< what the motors' accelerations do not make
  Matrix3d at_reference;        ///< the tensor in the reference pose
  Vector3d from_origin;         ///< from the body's own origin to its mass centre

  Vector3d gyroscopic() const { return omega.cross(I * omega); }
};

BodyView viewOf(const Mechanism& mechanism, const Instant& at, std::size_t b) {
  const MechanismBody& body = mechanism.bodies()[b];
  const BodyState& state = at.work.bodies[b];
  BodyView out;
  out.R = state.displacement.linear();
  out.own = out.R * body.frame.linear();
  out.I = out.R * body.inertia * out.R.transpose();
  out.mass = body.mass;
  out.omega = state.twist.head<3>();
  out.alpha = state.twist_rate.head<3>();
  const PointState center = pointOf(state, body.center_of_mass);
  out.a = center.a;
  out.arm = center.x - state.center;
  out.g = body.weightless ? Vector3d(Vector3d::Zero()) : mechanism.gravity();
  const Vector6d bias = at.biasOf(b);
  out.alpha_bias = bias.head<3>();
  out.a_bias = bias.tail<3>() + out.alpha_bias.cross(out.arm) + out.omega.cross(out.omega.cross(out.arm));
  out.at_reference = body.inertia;
  out.from_origin = out.R * (body.center_of_mass - body.frame.translation());
  return out;
}

Vector6d wrench(const Vector3d& moment, const Vector3d& force) {
  Vector6d out;
  out << moment, force;
  return out;
}

/// A part of the wrench that a body's motion needs, or what a mistake makes of it.
struct BodyTerm {
  CauseKind kind;
  const char* term;
  const char* detail;
  Vector6d (*of)(const BodyView&);
};

Matrix3d pointTensor(const BodyView& b) {
  const Vector3d& r = b.from_origin;
  return b.mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

Vector6d momentOf(const Matrix3d& I, const Vector3d& omega, const Vector3d& alpha) {
  return wrench(I * alpha + omega.cross(I * omega), Vector3d::Zero());
}

const Vector3d none = Vector3d::Zero();

/// Terms that a solver may leave out, scale or take with the wrong sign.
const BodyTerm terms[] = {
    {CauseKind::missing_term, "gravity", "", [](const BodyView& b) { return wrench(none, -b.mass * b.g); }},
    {CauseKind::missing_term, "gyroscopic", "", [](const BodyView& b) { return wrench(b.gyroscopic(), none); }},
    {CauseKind::missing_term, "coriolis", "every product of velocities",
     [](const BodyView& b) { return wrench(b.I * b.alpha_bias + b.gyroscopic(), b.mass * b.a_bias); }},
    {CauseKind::missing_term, "centripetal", "what velocities make of the accelerations",
     [](const BodyView& b) { return wrench(b.I * b.alpha_bias, b.mass * b.a_bias); }},
    {CauseKind::missing_term, "centripetal", "what velocities make of the mass centres' accelerations",
     [](const BodyView& b) { return wrench(none, b.mass * b.a_bias); }},
    {CauseKind::missing_term, "centripetal", "what velocities make of the angular accelerations",
     [](const BodyView& b) { return wrench(b.I * b.alpha_bias, none); }},
    {CauseKind::missing_term, "centripetal", "that of the mass centres about the bodies' origins",
     [](const BodyView& b) { return wrench(none, b.mass * b.omega.cross(b.omega.cross(b.from_origin))); }},
    {CauseKind::missing_term, "inertia", "mass, inertia and weight",
     [](const BodyView& b) { return wrench(b.I * b.alpha + b.gyroscopic(), b.mass * (b.a - b.g)); }},
    {CauseKind::missing_term, "inertia", "forces and moments of inertia, without the weight",
     [](const BodyView& b) { return wrench(b.I * b.alpha + b.gyroscopic(), b.mass * b.a); }},
    {CauseKind::missing_term, "inertia", "the moments of inertia",
     [](const BodyView& b) { return wrench(b.I * b.alpha + b.gyroscopic(), none); }},
    {CauseKind::missing_term, "inertia", "the force of inertia of the mass",
     [](const BodyView& b) { return wrench(none, b.mass * b.a); }},
};

/// What a mistake puts in place of a body's moment.
const BodyTerm mistakes[] = {
    {CauseKind::frame, "orientation", "the tensor in the axes of the file's pose",
     [](const BodyView& b) { return momentOf(b.at_reference, b.omega, b.alpha); }},
    {CauseKind::frame, "orientation", "the tensor in the body's axes",
     [](const BodyView& b) { return momentOf(b.own.transpose() * b.I * b.own, b.omega, b.alpha); }},
    {CauseKind::frame, "angular_velocity", "in the body's axes, with a tensor in the world's",
     [](const BodyView& b) {
       const Vector3d omega = b.own.transpose() * b.omega;
       return wrench(b.I * b.alpha + omega.cross(b.I * omega), none);
     }},
    {CauseKind::frame, "angular_velocity", "in the axes of the file's pose, with a tensor in the world's",
     [](const BodyView& b) {
       const Vector3d omega = b.R.transpose() * b.omega;
       return wrench(b.I * b.alpha + omega.cross(b.I * omega), none);
     }},
    {CauseKind::frame, "angular_velocity", "the gyroscopic moment in the body's axes, not turned back",
     [](const BodyView& b) { return wrench(b.I * b.alpha + b.own.transpose() * b.gyroscopic(), none); }},
    {CauseKind::frame, "angular_velocity", "of the world, with a tensor in the body's axes",
     [](const BodyView& b) {
       return wrench(b.I * b.alpha + b.omega.cross(b.own.transpose() * b.I * b.own * b.omega), none);
     }},
    {CauseKind::frame, "angular_acceleration", "in the body's axes, with a tensor in the world's",
     [](const BodyView& b) { return wrench(b.I * (b.own.transpose() * b.alpha) + b.gyroscopic(), none); }},
    {CauseKind::frame, "angular_acceleration", "in the axes of the file's pose, with a tensor in the world's",
     [](const BodyView& b) { return wrench(b.I * (b.R.transpose() * b.alpha) + b.gyroscopic(), none); }},
    {CauseKind::reference_point, "gravity", "at the body's origin instead of its mass centre",
     [](const BodyView& b) {
       return Vector6d(momentOf(b.I, b.omega, b.alpha) + wrench(b.from_origin.cross(b.mass * b.g), none));
     }},
    {CauseKind::reference_point, "inertia", "about the body's origin instead of its mass centre",
     [](const BodyView& b) { return momentOf(b.I + pointTensor(b), b.omega, b.alpha); }},
    {CauseKind::reference_point, "inertia", "moved to the mass centre twice",
     [](const BodyView& b) { return momentOf(b.I - pointTensor(b), b.omega, b.alpha); }},
};

VectorXd effortsOf(const EffortResidual& data, std::size_t b, Vector6d (*of)(const BodyView&)) {
  return data.each([&](const Instant& at) -> VectorXd {
    const BodyView view = viewOf(*data.mechanism, at, b);
    Vector6d w = of(view);
    w.head<3>() += view.arm.cross(Vector3d(w.tail<3>()));
    return at.work.T[b].transpose() * w;
  });
}

std::vector<std::size_t> heavyBodies(const Mechanism& mechanism) {
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b) {
    const MechanismBody& body = mechanism.bodies()[b];
    if (!body.fixed && (body.mass != 0 || !body.inertia.isZero(0))) out.push_back(b);
  }
  return out;
}

/// What velocities make of the rotors' accelerations, as the motors feel it.
VectorXd velocityProductsOfRotors(const EffortResidual& data) {
  return data.each([&](const Instant& at) -> VectorXd {
    VectorXd out = VectorXd::Zero(data.motors);
    for (const Coordinate& c : at.coordinates)
      out += c.row.transpose() * data.mechanism->joints()[c.joint].rotor_inertia *
             (c.acceleration - c.row.dot(at.motion.qddot));
    return out;
  });
}

/// Bodies of one mass, as the rods of a delta: at least two, and not all.
std::vector<std::vector<std::size_t>> alikeAmong(const Mechanism& mechanism, const std::vector<std::size_t>& bodies) {
  constexpr double same = 1e-9;
  const auto areAlike = [&](std::size_t a, std::size_t b) {
    const double mass = mechanism.bodies()[a].mass;
    return std::abs(mechanism.bodies()[b].mass - mass) <= same * mass;
  };
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t b : bodies) {
    const auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return areAlike(g.front(), b); });
    if (group == groups.end())
      groups.push_back({b});
    else
      group->push_back(b);
  }
  groups.erase(std::remove_if(groups.begin(), groups.end(),
                              [&](const auto& g) { return g.size() < 2 || g.size() == bodies.size(); }),
               groups.end());
  return groups;
}

std::string namesOf(const Mechanism& mechanism, const std::vector<std::size_t>& bodies) {
  std::string out;
  for (const std::size_t b : bodies) out += (out.empty() ? "" : ", ") + mechanism.bodies()[b].name;
  return out;
}

Vector6d rightMoment(const BodyView& b) { return momentOf(b.I, b.omega, b.alpha); }

}  // namespace

bool isUnit(double factor) {
  constexpr double degrees = 57.29577951308232;
  for (const double known : {degrees, 1 / degrees, 1e3, 1e-3, 1e6, 1e-6, degrees * degrees, 1e9, 1e-9})
    if (std::abs(factor / known - 1) < 1e-6) return true;
  return false;
}

void addScaledTerm(const NamedCause& term, const ChangeOf& part, const std::string& detail, std::vector<Tried>& out) {
  const auto times = [part](double factor) {
    return [part, factor](const EffortResidual& data) { return VectorXd(factor * part(data)); };
  };
  addFixed(out, term, times(-1), detail);
  NamedCause sign = term, scale = term;
  sign.kind = CauseKind::sign;
  addFixed(out, sign, times(-2), detail);
  if (term.term == "gravity") return;  // gravity has a number of its own
  scale.kind = CauseKind::scale;
  scale.expected = 1;
  Tried fitted{scale, [part](const EffortResidual& data, const VectorXd& x) { return VectorXd(x(0) * part(data)); },
               VectorXd::Ones(1)};
  fitted.detail = detail;
  fitted.finish = [](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
    named.found = 1 + x(0);
    named.uncertainty = uncertainty(0);
    if (isUnit(*named.found)) named.kind = CauseKind::units;
    return true;
  };
  out.push_back(fitted);
}

void addBodyCauses(const EffortResidual& data, std::vector<Tried>& out) {
  const std::vector<std::size_t> bodies = heavyBodies(*data.mechanism);
  const auto addAll = [&](const BodyTerm& term, bool is_mistake) {
    const auto partOf = [of = term.of, is_mistake](const std::vector<std::size_t>& some, double factor) {
      return [some, of, is_mistake, factor](const EffortResidual& at) {
        VectorXd sum = VectorXd::Zero(at.noc.size());
        for (const std::size_t b : some) {
          sum += factor * effortsOf(at, b, of);
          if (is_mistake) sum -= factor * effortsOf(at, b, rightMoment);
        }
        return sum;
      };
    };
    NamedCause named{term.kind, term.term, "all"};
    if (is_mistake)
      addFixed(out, named, partOf(bodies, 1), term.detail);
    else
      addScaledTerm(named, partOf(bodies, 1), term.detail, out);
    for (const std::size_t b : bodies) {
      if (bodies.size() == 1) break;
      named.body = data.mechanism->bodies()[b].name;
      addFixed(out, named, partOf({b}, is_mistake ? 1 : -1), term.detail);
      if (std::string(term.term) != "gyroscopic") continue;
      NamedCause sign = named;
      sign.kind = CauseKind::sign;
      addFixed(out, sign, partOf({b}, -2), term.detail);
    }
    for (const std::vector<std::size_t>& group : alikeAmong(*data.mechanism, bodies)) {
      named.body = namesOf(*data.mechanism, group);
      addFixed(out, named, partOf(group, is_mistake ? 1 : -1), term.detail);
    }
    if (std::string(term.term) != "coriolis" || velocityProductsOfRotors(data).isZero(0)) return;
    named.body = "all";
    const auto of_bodies = partOf(bodies, 1);
    addScaledTerm(
        named, [of_bodies](const EffortResidual& at) { return VectorXd(of_bodies(at) + velocityProductsOfRotors(at)); },
        "every product of velocities, those of the rotors too", out);
  };
  for (const BodyTerm& term : terms) addAll(term, false);
  for (const BodyTerm& mistake : mistakes) addAll(mistake, true);
}

}  // namespace ursula::mechanisms
