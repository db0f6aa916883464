#include "model/mechanism_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/errors.h"
#include "base/text.h"

namespace ursula {
namespace {

/// One number of a machine that outlives it.
struct NamedNumber {
  std::string name;
  std::function<double()> get;
  std::function<void(double)> set;
};

NamedNumber plain(std::string name, double& number) {
  return {std::move(name), [&number] { return number; }, [&number](double value) { number = value; }};
}

/// The body's numbers in its own frame.
void addBody(MechanismBody& body, std::vector<NamedNumber>& out) {
  const std::string prefix = "body." + body.name;
  out.push_back(plain(prefix + ".mass", body.mass));
  for (int k = 0; k < 3; ++k)
    out.push_back({fmt::format("{}.center_of_mass.{}", prefix, k),
                   [&body, k] { return (body.frame.inverse() * body.center_of_mass)(k); },
                   [&body, k](double value) {
                     Vector3d own = body.frame.inverse() * body.center_of_mass;
                     own(k) = value;
                     body.center_of_mass = body.frame * own;
                   }});
  const auto own_inertia = [&body] {
    return Matrix3d(body.frame.linear().transpose() * body.inertia * body.frame.linear());
  };
  for (const char* entry : {"xx", "yy", "zz", "xy", "xz", "yz"}) {
    const int i = entry[0] - 'x', j = entry[1] - 'x';
    out.push_back({fmt::format("{}.inertia.{}", prefix, entry), [own_inertia, i, j] { return own_inertia()(i, j); },
                   [own_inertia, i, j, &body](double value) {
                     Matrix3d own = own_inertia();
                     own(i, j) = own(j, i) = value;
                     body.inertia = body.frame.linear() * own * body.frame.linear().transpose();
                   }});
  }
}

void addJoint(MechanismJoint& joint, std::vector<NamedNumber>& out) {
  const std::string prefix = "joint." + joint.name;
  for (const auto& [name, member] : {std::pair("damping", &MechanismJoint::damping),
                                     {"friction", &MechanismJoint::friction},
                                     {"armature", &MechanismJoint::rotor_inertia},
                                     {"stiffness", &MechanismJoint::stiffness},
                                     {"springref", &MechanismJoint::spring_reference}})
    out.push_back(plain(fmt::format("{}.{}", prefix, name), joint.*member));
}

std::vector<NamedNumber> numbersOf(MechanismParameters& machine) {
  std::vector<NamedNumber> out;
  for (int k = 0; k < 3; ++k) out.push_back(plain(fmt::format("gravity.{}", k), machine.gravity(k)));
  for (MechanismBody& body : machine.bodies)
    if (!body.fixed) addBody(body, out);
  for (MechanismJoint& joint : machine.joints)
    if (freedomsOf(joint.kind) > 0) addJoint(joint, out);
  return out;
}

NamedNumber find(MechanismParameters& machine, const std::string& name) {
  std::vector<NamedNumber> all = numbersOf(machine);
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const NamedNumber& each : all) names.push_back(each.name);
  throw InvalidParameter("mechanism.numbers", fmt::format("'{}', the model has no such number", shown(name)),
                         "such as body.NAME.mass, joint.NAME.damping, gravity.2" + didYouMean(name, names));
}

}  // namespace

std::vector<std::string> mechanismNumbers(const MechanismParameters& machine) {
  MechanismParameters copy = machine;
  std::vector<std::string> out;
  for (const NamedNumber& each : numbersOf(copy)) out.push_back(each.name);
  return out;
}

double mechanismNumber(const MechanismParameters& machine, const std::string& name) {
  MechanismParameters copy = machine;
  return find(copy, name).get();
}

void setMechanismNumber(const std::string& name, double value, MechanismParameters& machine) {
  find(machine, name).set(value);
}

}  // namespace ursula
