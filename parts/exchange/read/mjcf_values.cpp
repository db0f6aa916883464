#include "parts/exchange/read/mjcf_parts.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cctype>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"
#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

std::string oneOf(const Element& at, const char* name, std::initializer_list<const char*> words) {
  const std::string value = attribute(at, name);
  if (value.empty()) return value;
  for (const char* word : words)
    if (value == word) return value;
  refuse(at, fmt::format("{} '{}' is unknown, expected one of {}", name, shown(value), fmt::join(words, ", ")));
}

Matrix3d fromEuler(const Vector3d& angles, const std::string& sequence) {
  Matrix3d out = Matrix3d::Identity();
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = std::tolower(static_cast<unsigned char>(sequence[k]));
    const Matrix3d turn(Eigen::AngleAxisd(angles(static_cast<Eigen::Index>(k)), Vector3d::Unit(axis - 'x')));
    out = sequence[k] == axis ? Matrix3d(out * turn) : Matrix3d(turn * out);
  }
  return out;
}

/// Returns the smallest rotation that takes the z axis to a unit vector; half a turn about x if it is opposite.
/// MuJoCo's own formula, as others choose another axis near half a turn.
Matrix3d fromZTo(const Vector3d& z) {
  const Vector3d axis = Vector3d::UnitZ().cross(z);
  const double squared = axis.squaredNorm(), sine = squared < 1e-14 ? 0 : std::sqrt(squared);  // below it MuJoCo has 0
  return Eigen::AngleAxisd(std::atan2(sine, z.z()), sine == 0 ? Vector3d::UnitX() : Vector3d(axis / sine))
      .toRotationMatrix();
}

struct Shape {
  double volume = 0;
  Vector3d moments = Vector3d::Zero();  ///< for unit mass, about the shape's axes
};

/// Returns volume and moments according to MuJoCo's reference, in which sizes are half lengths and radii.
Shape shapeOf(const Element& geom, const std::string& type, const std::vector<double>& size) {
  const auto needed = type == "sphere" ? 1U : type == "box" || type == "ellipsoid" ? 3U : 2U;
  if (size.size() < needed)
    refuse(geom, fmt::format("size has {} numbers, expected {} of a {}", size.size(), needed, type));
  for (std::size_t k = 0; k < needed; ++k)
    if (!(size[k] > 0)) refuse(geom, fmt::format("size {}, expected lengths above zero", size[k]));
  const double a = size[0], b = needed > 1 ? size[1] : a, c = needed > 2 ? size[2] : a;
  if (type == "sphere") return {4 * pi * a * a * a / 3, Vector3d::Constant(0.4 * a * a)};
  if (type == "box") return {8 * a * b * c, Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / 3};
  if (type == "ellipsoid") return {4 * pi * a * b * c / 3, Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / 5};
  const double height = 2 * b, cylinder = pi * a * a * height;
  const Vector3d round((3 * a * a + height * height) / 12, (3 * a * a + height * height) / 12, a * a / 2);
  if (type == "cylinder") return {cylinder, round};
  const double ball = 4 * pi * a * a * a / 3, share = ball / (ball + cylinder);
  const double along = 0.4 * a * a, across = along + height * (3 * a + 2 * height) / 8;
  return {ball + cylinder, (1 - share) * round + share * Vector3d(across, across, along)};
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

Matrix3d mjcfOrientation(const Element& element, const MjcfCompiler& compiler, const MjcfGet& get) {
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
  if (what == "zaxis") return fromZTo(directionOf(element, vectorOf(element, text, what), what));
  const std::vector<double> v = numbersOf(element, text, 6, what);
  const Vector3d x = directionOf(element, Vector3d(v[0], v[1], v[2]), what), y_given(v[3], v[4], v[5]);
  const Vector3d y = directionOf(element, y_given - x * x.dot(y_given), what);
  Matrix3d out;
  out << x, y, x.cross(y);
  return out;
}

MjcfFromTo mjcfFromTo(const Element& element, const std::string& points) {
  const std::vector<double> v = numbersOf(element, points, 6, "fromto");
  const Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
  // MuJoCo points the shape's z axis from the second point to the first.
  const Vector3d z = directionOf(element, from - to, "fromto");
  return {placed((from + to) / 2, fromZTo(z)), (to - from).norm() / 2};
}

bool addGeom(const Element& geom, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, const MjcfGet& get,
             GraphBody& body) {
  const std::string group = get("group"), mass_text = get("mass"), density = get("density"), from_to = get("fromto");
  const double of_group = group.empty() ? 0 : numberOf(geom, group, "group");
  if (of_group < compiler.least_group || of_group > compiler.most_group) return false;
  const std::string type = get("type").empty() ? "sphere" : get("type");
  const double given = mass_text.empty() ? -1 : numberOf(geom, mass_text, "mass");
  if (given == 0 || type == "plane" || type == "hfield") return true;
  const double per_volume = density.empty() ? 1000 : numberOf(geom, density, "density");
  if (mass_text.empty() && per_volume == 0) return true;
  if (!get("mesh").empty() || type == "mesh" || type == "sdf")
    refuse(geom, fmt::format("a mass that follows from a mesh ({}), which is not read; body {} needs an <inertial>",
                             shown(get("mesh")), shown(body.name)));
  if (get("shellinertia") == "true") refuse(geom, "shellinertia, which is not read; its body needs an <inertial>");
  if (type != "sphere" && type != "box" && type != "ellipsoid" && type != "cylinder" && type != "capsule")
    refuse(geom, fmt::format("type '{}', expected sphere, box, ellipsoid, cylinder or capsule", shown(type)));
  const std::string pos = get("pos");
  Vector3d center = pos.empty() ? Vector3d::Zero() : vectorOf(geom, pos, "pos");
  std::vector<double> size = numbersOf(geom, get("size"), 0, "size");
  Matrix3d turn = Matrix3d::Identity();
  if (from_to.empty()) {
    turn = mjcfOrientation(geom, compiler, get);
  } else {
    const MjcfFromTo between = mjcfFromTo(geom, from_to);
    center = between.frame.translation();
    turn = between.frame.linear();
    if (size.empty()) refuse(geom, "no size, expected a radius");
    size = type == "box" || type == "ellipsoid" ? std::vector<double>{size[0], size[0], between.half}
                                                : std::vector<double>{size[0], between.half};
  }
  const Shape shape = shapeOf(geom, type, size);
  const double mass = mass_text.empty() ? per_volume * shape.volume : given;
  if (!(mass > 0)) refuse(geom, fmt::format("a mass of {}, expected none below zero", mass));
  const Matrix3d axes = at.linear() * turn;
  Group sum;
  sum.add(body.mass, body.center_of_mass, body.inertia);
  sum.add(mass, at * center, axes * (mass * shape.moments).asDiagonal() * axes.transpose());
  body.mass = sum.mass;
  body.center_of_mass = sum.center_of_mass;
  body.inertia = sum.inertia;
  return true;
}

void takeInertial(const Element& inertial, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, GraphBody& body) {
  const auto get = [&](const char* name) { return attribute(inertial, name); };
  body.mass = numberOf(inertial, requiredAttribute(inertial, "mass"), "mass");
  if (body.mass < 0) refuse(inertial, fmt::format("a mass of {}, expected none below zero", body.mass));
  const std::string pos = get("pos"), full = get("fullinertia"), diagonal = get("diaginertia");
  if (pos.empty()) refuse(inertial, "no pos, expected the mass centre; MuJoCo assumes none");
  body.center_of_mass = at * vectorOf(inertial, pos, "pos");
  Matrix3d turn = at.linear() * mjcfOrientation(inertial, compiler, get), local = Matrix3d::Zero();
  if (!full.empty()) {
    for (const char* name : {"quat", "axisangle", "euler", "xyaxes", "zaxis"})
      if (!get(name).empty()) refuse(inertial, fmt::format("both fullinertia and {}, expected one", name));
    const std::vector<double> v = numbersOf(inertial, full, 6, "fullinertia");
    local = tensorOf({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    body.inertia_rounding = halfLastDigit(full);
  } else if (!diagonal.empty()) {
    local = vectorOf(inertial, diagonal, "diaginertia").asDiagonal();
    body.inertia_rounding = halfLastDigit(diagonal);
  }
  body.inertia = turn * local * turn.transpose();
}

void boundInertia(const Element& element, const MjcfCompiler& compiler, GraphBody& body, Assumptions& assumptions) {
  if (compiler.least_mass <= 0 && compiler.least_inertia <= 0 && !compiler.balance_inertia) return;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal((body.inertia + body.inertia.transpose()) / 2);
  Vector3d moments = principal.eigenvalues();
  if (body.mass < compiler.least_mass) {
    assumptions.push_back(
        {"The mass was raised to boundmass, by this", body.name, compiler.least_mass - body.mass, "kg"});
    body.mass = compiler.least_mass;
  }
  if (moments(0) < compiler.least_inertia) {
    assumptions.push_back({"Principal moments were raised to boundinertia, by up to this", body.name,
                           compiler.least_inertia - moments(0), "kg·m²"});
    moments = moments.cwiseMax(compiler.least_inertia);
  }
  if (!(moments(0) >= -1e-12 * moments(2))) refuse(element, "a principal moment below zero, expected none");
  if (compiler.balance_inertia && moments(2) > moments(0) + moments(1)) {
    assumptions.push_back(
        {"Moments that break the triangle inequality were set to their mean (balanceinertia), changed by up to this",
         body.name, (moments.array() - moments.mean()).abs().maxCoeff(), "kg·m²"});
    moments.setConstant(moments.mean());
  }
  body.inertia = principal.eigenvectors() * moments.asDiagonal() * principal.eigenvectors().transpose();
}

}  // namespace ursula::exchange
