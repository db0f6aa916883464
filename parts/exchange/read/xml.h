#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/scalar.h"
#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

using Element = tinyxml2::XMLElement;

/// The largest file; a model without its meshes is a thousand times smaller.
constexpr std::size_t most_model_bytes = std::size_t{8} << 20;
/// No list of numbers in a model is longer.
constexpr std::size_t most_numbers = 100;
/// No length, angle, mass or moment is larger; limits may be.
constexpr double most_value = 1e12;
constexpr std::size_t most_tags = 25'000, most_attributes = 100'000, most_attributes_of_one = 100;

/// Refuses a text beyond these bounds, and one that declares an entity. Throws ImportError.
void requireModest(const std::string& text);
/// Parses a text that requireModest() accepted. It expands no entity. Throws ImportError.
void parseXml(const std::string& text, tinyxml2::XMLDocument& document);

/// Returns the element for messages: "<joint name='a'>".
std::string named(const Element& element);
[[noreturn]] void refuse(const Element& element, const std::string& what);

/// Ends the refusal of what couples or pulls: what would help.
constexpr const char* without_it = "without it, in the file and in your engine, the machine can be taken";

/// Returns an attribute without surrounding white space; "" if it is missing.
std::string attribute(const Element& element, const char* name);
std::string requiredAttribute(const Element& element, const char* name);
/// Returns the text of a child or of the element itself in the same way. Throws for a text in pieces, as a comment or
/// an element cuts it: readers differ in which piece they take.
std::string textOf(const Element& element);
std::string childText(const Element& element, const char* name);
/// Returns the only child of that name, or null. Throws for a second one, as readers differ in which they take.
const Element* onlyChild(const Element& element, const char* name);

/// Reads finite decimal numbers separated by white space; `what` names them in the error. Throws unless there are
/// `count` of them, up to `most` in size; 0 allows any number.
std::vector<double> numbersOf(const Element& at, std::string_view text, std::size_t count, const std::string& what,
                              double most = most_value);
double numberOf(const Element& at, std::string_view text, const std::string& what, double most = most_value);
Vector3d vectorOf(const Element& at, std::string_view text, const std::string& what);
/// Reads "true", "1", "false" or "0". Throws for other words.
bool truthOf(const Element& at, const std::string& text, const std::string& what);
/// Returns half a unit of the last written digit, the largest over the numbers: "0.25 1.5" gives 0.05. Whole numbers do
/// not count.
double halfLastDigit(std::string_view text);

/// Visits child elements of a name, or all of them if `name` is null.
template <class Visit>
void eachChild(const Element& element, const char* name, const Visit& visit) {
  for (const Element* e = element.FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) visit(*e);
}

/// Splits "pose parent child" at its blanks.
std::set<std::string> wordsOf(const std::string& text);
/// Lists unknown child elements or attributes, so that misspelt words are noticed. Names of other name spaces ("gz:…")
/// are ignored.
void listUnknown(const Element& element, const std::set<std::string>& children, Assumptions& assumptions);
void listUnknownAttributes(const Element& element, const std::set<std::string>& attributes, Assumptions& assumptions);

/// Refuses an unknown child element that names two links or joints, or more, in its attributes or texts: it may couple
/// them. Words of SRDF, and of collisions, do not.
void refuseCouplings(const Element& element, const std::set<std::string>& children,
                     const std::function<bool(const std::string&)>& is_machines);

/// Returns the element's name, or "KIND of line N" if it has none; in an included file "KIND of BODY".
std::string nameOr(const Element& element, const std::string& kind);
/// Returns a joint of that name at the element's line.
GraphJoint jointAt(const Element& element, const std::string& name, JointKind kind = JointKind::fixed);

/// Lets a closure hold where two frames are one: `a` of its parent and `b` of its child, in the world.
void joinFrames(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, GraphJoint& joint);

/// Returns a value's text: that of a child in SDF (`childText`), of an attribute in URDF (`attribute`).
using TextOfWord = std::string (*)(const Element&, const char*);
/// Takes ixx, iyy, izz, ixy, ixz and iyz of `inertia` in the frame `at`, whose origin is the mass centre. If the file
/// lacks the k-th, `missing(k, name)` is taken.
void takeInertia(const Element& inertia, TextOfWord text, const Eigen::Isometry3d& at,
                 const std::function<double(std::size_t, const char*)>& missing, GraphBody& body);

/// Returns a unit vector. Throws if it is zero.
Vector3d directionOf(const Element& at, const Vector3d& vector, const std::string& what);
/// Returns Rz(yaw) Ry(pitch) Rx(roll) for [roll, pitch, yaw], rad.
Matrix3d rollPitchYaw(const Vector3d& angles);
Eigen::Isometry3d placed(const Vector3d& position, const Matrix3d& rotation);
/// Returns the tensor of the diagonal [xx, yy, zz] and the products [xy, xz, yz].
Matrix3d tensorOf(const Vector3d& diagonal, const Vector3d& products);

/// One reader per format returns the graph of a parsed file. Readers throw ImportError for unknown elements and for
/// elements that a scenario cannot express.
ModelGraph readSdf(const Element& root);
ModelGraph readMjcf(const Element& root);
/// Puts the content of the files that <include>s of an MJCF name in their place. They lie in the folder of `file`,
/// which is the model, or below it. Throws ImportError.
void takeIncludes(tinyxml2::XMLDocument& document, const std::filesystem::path& file);
/// Throws ImportError if a file beside the model is a link that leads out of the model's folder.
void requireInFolder(const std::filesystem::path& file, const std::filesystem::path& folder);
/// Looks for robot.yaml next to `file`.
ModelGraph readUrdf(const Element& root, const std::filesystem::path& file);

}  // namespace ursula::exchange
