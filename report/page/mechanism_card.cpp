#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/page/html_template.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"

namespace ursula::report {

extern const std::string_view mechanism_html;  // of web/

namespace {

HtmlValue factOf(const std::string& what, const std::string& value) { return {{"what", what}, {"value", value}}; }

std::string kindOf(const MechanismPicture::Joint& joint) {
  constexpr const char* kinds[] = {"fixed", "hinge", "slide", "universal joint", "ball", "free"};
  return kinds[static_cast<std::size_t>(joint.kind)];
}

/// "the ground" for what stands still, else the body's name.
std::string nameOf(const MechanismPicture& picture, std::size_t body) {
  const MechanismPicture::Body& of = picture.bodies[body];
  return of.fixed ? of.name + " (fixed)" : of.name;
}

std::vector<HtmlValue> motorsOf(const MechanismPicture& picture) {
  std::vector<HtmlValue> out;
  for (std::size_t k = 0; k < picture.motors.size(); ++k)
    for (const MechanismPicture::Joint& joint : picture.joints)
      if (joint.motor == static_cast<int>(k))
        out.push_back(
            {{"number", k + 1},
             {"motor", joint.name},
             {"kind", kindOf(joint)},
             {"between", fmt::format("{} and {}", nameOf(picture, joint.parent), nameOf(picture, joint.child))},
             {"coordinate", joint.kind == JointKind::prismatic ? "m" : "rad"},
             {"effort", prettyUnit(picture.motors[k].unit)},
             {"column", fmt::format("tau_{}_{}", k + 1, picture.motors[k].unit)}});
  return out;
}

/// "12 balls, 3 hinges".
std::string jointsText(const MechanismPicture& picture, bool closures) {
  std::vector<std::pair<std::string, int>> kinds;
  for (const MechanismPicture::Joint& joint : picture.joints) {
    if (closures && !joint.closure) continue;
    const std::string kind = kindOf(joint);
    const auto same =
        std::find_if(kinds.begin(), kinds.end(), [&kind](const auto& each) { return each.first == kind; });
    if (same == kinds.end())
      kinds.emplace_back(kind, 1);
    else
      ++same->second;
  }
  std::string out;
  for (const auto& [kind, number] : kinds)
    out += fmt::format("{}{} {}{}", out.empty() ? "" : ", ", number, kind,
                       number == 1 || kind == "fixed" || kind == "free" ? "" : "s");
  return out;
}

}  // namespace

std::string inputCard(const MechanismPicture& picture) {
  std::vector<HtmlValue> facts;
  for (const std::string& text : picture.warnings) facts.push_back(factOf("Warning on reading", text));
  facts.push_back(factOf("Model", picture.model_file));
  facts.push_back(factOf("Freedoms", fmt::format("{}, one for each motor", picture.freedoms)));
  facts.push_back(factOf("Output body", picture.bodies[picture.output].name));
  const auto moving =
      std::count_if(picture.bodies.begin(), picture.bodies.end(), [](const auto& body) { return !body.fixed; });
  facts.push_back(factOf("Bodies", fmt::format("{} that move, {:.6g} kg in all", moving, picture.mass)));
  facts.push_back(factOf("Joints", jointsText(picture, false)));
  const std::string closing = jointsText(picture, true);
  facts.push_back(factOf("Loops closed by", closing.empty() ? "none: the tree is open" : closing));
  if (!picture.idle.empty())
    facts.push_back(
        factOf("Held at rest", fmt::format("{}: a spin about the body's own line has no effect on any torque",
                                           fmt::join(picture.idle, ", "))));
  const Vector3d& g = picture.gravity;
  facts.push_back(factOf("Gravity", fmt::format("[{:.6g}, {:.6g}, {:.6g}] m/s²", g.x(), g.y(), g.z())));
  facts.push_back(factOf("Motion", fmt::format("{} of the motors, {:.6g} s, judged at {} instants", picture.motion,
                                               picture.duration, picture.samples)));
  for (const std::string& text : picture.assumptions) facts.push_back(factOf("Assumed on reading", text));
  return rendered(mechanism_html, {{"facts", facts}, {"motors", motorsOf(picture)}});
}

}  // namespace ursula::report
