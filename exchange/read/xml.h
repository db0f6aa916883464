#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/scalar.h"
#include "exchange/import_error.h"

#include "exchange/model_graph.h"

namespace ursula::exchange {

using Element = tinyxml2::XMLElement;

/// How much of a file is read: a model without its meshes is a thousand times smaller.
constexpr std::size_t most_model_bytes = std::size_t{8} << 20;
/// No list of numbers in a model is longer.
constexpr std::size_t most_numbers = 100;
constexpr std::size_t most_unknown = 200;  ///< that are listed
constexpr std::size_t most_tags = 100'000, most_attributes = 100'000, most_attributes_of_one = 100;

/// Parses what is within these bounds; entities of the text's own are refused, none is expanded. Throws ImportError.
void parseXml(const std::string& text, tinyxml2::XMLDocument& document);

/// "<joint name='a'>", for messages.
std::string named(const Element& element);
[[noreturn]] void refuse(const Element& element, const std::string& what);

/// An attribute without white space around it; "" where it is not there.
std::string attribute(const Element& element, const char* name);
std::string requiredAttribute(const Element& element, const char* name);
/// The text of a child or of the element itself, likewise.
std::string textOf(const Element& element);
std::string childText(const Element& element, const char* name);

/// Finite decimal numbers apart by white space; `what` names them in the refusal. Throws where there are not `count`,
/// or for 0 whatever number of them.
std::vector<double> numbersOf(const Element& at, std::string_view text, std::size_t count, const std::string& what);
double numberOf(const Element& at, std::string_view text, const std::string& what);
Vector3d vectorOf(const Element& at, std::string_view text, const std::string& what);
/// "true", "1", "false" or "0". Throws for other words.
bool truthOf(const Element& at, const std::string& text, const std::string& what);
/// Half a unit of the last digit that is written, for each of the numbers the largest: "0.25 1" has 0.5.
double halfLastDigit(std::string_view text);

/// Child elements of a name, or all: for (const Element* e = first; e; e = next).
template <class Visit>
void eachChild(const Element& element, const char* name, const Visit& visit) {
  for (const Element* e = element.FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) visit(*e);
}

/// Lists child elements, or attributes, that are none of those known: a misspelt word is not to be lost in silence.
/// Those of other name spaces ("gz:…") are their owners'.
void listUnknown(const Element& element, const std::set<std::string>& children, std::vector<Assumption>& assumptions);
void listUnknownAttributes(const Element& element, const std::set<std::string>& attributes,
                           std::vector<Assumption>& assumptions);

/// A unit vector. Throws where it is zero.
Vector3d directionOf(const Element& at, const Vector3d& vector, const std::string& what);
/// Rz(yaw) Ry(pitch) Rx(roll), rad.
Matrix3d rollPitchYaw(const Vector3d& angles);
Eigen::Isometry3d placed(const Vector3d& position, const Matrix3d& rotation);
/// [xx, yy, zz, xy, xz, yz] as a tensor.
Matrix3d tensorOf(const Vector3d& diagonal, const Vector3d& products);

}  // namespace ursula::exchange
