#include "exchange/read/mjcf_parts.h"

#include <fmt/format.h>

#include <cctype>

#include "base/text.h"

namespace ursula::exchange {
namespace {

std::string oneOf(const Element& at, const char* name, std::initializer_list<const char*> words) {
  const std::string value = attribute(at, name);
  if (value.empty()) return value;
  for (const char* word : words)
    if (value == word) return value;
  refuse(at, fmt::format("{} '{}' is unknown, expected one of {}", name, shown(value), fmt::join(words, ", ")));
}

}  // namespace

void MjcfCompiler::read(const Element& compiler) {
  if (attribute(compiler, "coordinate") == "global")
    refuse(compiler,
           "coordinate=\"global\", which MuJoCo itself gave up; save the model with MuJoCo 2.3.2 or older "
           "(mj_saveLastXML), which writes local ones");
  if (const std::string angle = oneOf(compiler, "angle", {"degree", "radian"}); !angle.empty())
    degrees = angle == "degree";
  if (const std::string sequence = attribute(compiler, "eulerseq"); !sequence.empty()) {
    if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos)
      refuse(compiler, fmt::format("eulerseq '{}', expected three of x, y, z, X, Y, Z", shown(sequence)));
    euler = sequence;
  }
  const auto flag = [&](const char* name, bool& to) {
    if (const std::string value = attribute(compiler, name); !value.empty()) to = truthOf(compiler, value, name);
  };
  flag("autolimits", auto_limits);
  flag("balanceinertia", balance_inertia);
  if (const std::string from = oneOf(compiler, "inertiafromgeom", {"false", "true", "auto"}); !from.empty())
    from_geom = from == "true" ? FromGeom::yes : from == "false" ? FromGeom::no : FromGeom::automatic;
  if (const std::string range = attribute(compiler, "inertiagrouprange"); !range.empty()) {
    const std::vector<double> groups = numbersOf(compiler, range, 2, "inertiagrouprange");
    least_group = static_cast<int>(groups[0]);
    most_group = static_cast<int>(groups[1]);
  }
  const auto number = [&](const char* name, double& to) {
    if (const std::string value = attribute(compiler, name); !value.empty()) to = numberOf(compiler, value, name);
  };
  number("boundmass", least_mass);
  number("boundinertia", least_inertia);
  number("settotalmass", total_mass);
}

void MjcfDefaults::read(const Element& root) {
  classes_[main_];
  eachChild(root, "default", [this](const Element& e) { read(e, classes_[main_], true); });
}

void MjcfDefaults::read(const Element& element, const Class& inherited, bool top) {
  std::string name = attribute(element, "class");
  if (name.empty() && !top) refuse(element, "a class without a name, expected one");
  if (name.empty() || (top && name == "main")) name = main_;
  if (top && name != main_) {
    main_ = name;  // the top class may have another name
  }
  Class own = inherited;
  eachChild(element, nullptr, [&](const Element& e) {
    if (std::string(e.Name()) == "default") return;
    Attributes& attributes = own[e.Name()];
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
      attributes[a->Name()] = attribute(e, a->Name());
  });
  classes_[name] = own;
  for (const auto& [kind, attributes] : own) inherited_ += 1 + attributes.size();
  if (inherited_ > 100'000) refuse(element, "more than 100,000 inherited defaults, expected a model of one machine");
  eachChild(element, "default", [&](const Element& e) { read(e, own, false); });
}

void MjcfDefaults::requireClass(const Element& at, const std::string& name) const {
  if (classes_.count(name) != 0) return;
  std::vector<std::string> names;
  for (const auto& [each, attributes] : classes_) names.push_back(each);
  refuse(at, fmt::format("class '{}': no <default> has that name{}", shown(name), didYouMean(name, names)));
}

std::string MjcfDefaults::get(const Element& element, const std::string& childclass, const char* name,
                              const std::string& kind) const {
  if (const char* own = element.Attribute(name); own != nullptr) return attribute(element, name);
  std::string of = attribute(element, "class");
  if (of.empty()) of = childclass.empty() ? main_ : childclass;
  requireClass(element, of);
  const Class& from = classes_.at(of);
  const auto attributes = from.find(kind.empty() ? element.Name() : kind);
  if (attributes == from.end()) return "";
  const auto value = attributes->second.find(name);
  return value == attributes->second.end() ? "" : value->second;
}

namespace {

Matrix3d aboutAxis(char axis, double angle) {
  const int k = std::tolower(static_cast<unsigned char>(axis)) - 'x';
  return Eigen::AngleAxisd(angle, Vector3d::Unit(k)).toRotationMatrix();
}

Matrix3d fromEuler(const Vector3d& angles, const std::string& sequence) {
  Matrix3d out = Matrix3d::Identity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Matrix3d turn = aboutAxis(sequence[k], angles(static_cast<Eigen::Index>(k)));
    out = std::islower(static_cast<unsigned char>(sequence[k])) != 0 ? Matrix3d(out * turn) : Matrix3d(turn * out);
  }
  return out;
}

}  // namespace

void readMjcfOptions(const Element& root, ModelGraph& graph) {
  bool is_off = false;
  eachChild(root, "option", [&](const Element& option) {
    if (const std::string gravity = attribute(option, "gravity"); !gravity.empty())
      graph.gravity = vectorOf(option, gravity, "gravity");
    for (const char* name : {"density", "viscosity"})
      if (const std::string value = attribute(option, name); !value.empty() && numberOf(option, value, name) != 0)
        refuse(option, fmt::format("{} {}: forces of a fluid, which a scenario has no words for", name, value));
    const Element* flag = option.FirstChildElement("flag");
    if (flag == nullptr) return;
    is_off = is_off || attribute(*flag, "gravity") == "disable";
    for (const char* name : {"equality", "constraint", "passive", "spring", "damper", "frictionloss", "actuation"})
      if (attribute(*flag, name) == "disable")
        refuse(*flag, fmt::format("{}=\"disable\", which switches off what the file says elsewhere; expected a file "
                                  "without it",
                                  name));
  });
  if (!is_off) return;
  graph.assumptions.push_back({"Gravity is switched off by the file's flag; without it it would be this", "<flag>",
                               graph.gravity.norm(), "m/s²"});
  graph.gravity.setZero();
}

Matrix3d mjcfOrientation(const Element& element, const MjcfCompiler& compiler,
                         const std::function<std::string(const char*)>& get) {
  const char* given = nullptr;
  for (const char* name : {"quat", "axisangle", "euler", "xyaxes", "zaxis"}) {
    if (get(name).empty()) continue;
    if (given != nullptr) refuse(element, fmt::format("both {} and {}, expected one orientation", given, name));
    given = name;
  }
  if (given == nullptr) return Matrix3d::Identity();
  const std::string text = get(given), what = given;
  if (what == "quat") {
    const std::vector<double> q = numbersOf(element, text, 4, what);
    const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
    if (!(quaternion.norm() > 1e-12)) refuse(element, "a quaternion of zero, expected an orientation");
    return quaternion.normalized().toRotationMatrix();
  }
  if (what == "axisangle") {
    const std::vector<double> v = numbersOf(element, text, 4, what);
    return Eigen::AngleAxisd(compiler.angle(v[3]), directionOf(element, Vector3d(v[0], v[1], v[2]), what))
        .toRotationMatrix();
  }
  if (what == "euler") {
    const Vector3d angles = vectorOf(element, text, what);
    return fromEuler({compiler.angle(angles.x()), compiler.angle(angles.y()), compiler.angle(angles.z())},
                     compiler.euler);
  }
  if (what == "zaxis") {
    const Vector3d z = directionOf(element, vectorOf(element, text, what), what);
    // Uses the smallest rotation that takes z there; half a turn about x if it is opposite.
    return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), z).toRotationMatrix();
  }
  const std::vector<double> v = numbersOf(element, text, 6, what);
  const Vector3d x = directionOf(element, Vector3d(v[0], v[1], v[2]), what), y_given(v[3], v[4], v[5]);
  const Vector3d y = directionOf(element, y_given - x * x.dot(y_given), what);
  Matrix3d out;
  out << x, y, x.cross(y);
  return out;
}

}  // namespace ursula::exchange
