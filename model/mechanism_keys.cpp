#include "model/mechanism_keys.h"

#include <stdexcept>
#include <string>

namespace ursula {
namespace {

ScenarioKey texts(const char* name, const char* meaning) { return {name, KeyType::choices, "", no_default, meaning}; }

ScenarioTable document() {
  return {"",
          "(the top of the file)",
          "A machine with closed loops of any kind, the motion of its motors, and how that is judged. SI units.",
          {{"name", KeyType::string, "", required_key, "results go to results/NAME; a name that a folder can have"},
           tableKey("mechanism", required_key, "the machine, by its model file", "mechanism"),
           tableKey("trajectory", required_key, "the commanded motion of the motors", "trajectory"),
           tableKey("simulation", no_default, "how finely it is looked at and integrated", "simulation"),
           tableKey("acceptance", no_default, "limits of your own", "acceptance")}};
}

ScenarioTable mechanism() {
  return {"mechanism",
          "[mechanism]",
          "",
          {{"file", KeyType::string, "", required_key,
            "a model in MJCF, SDF or URDF; a relative path is taken from the scenario's folder"},
           texts("motors", "joints that motors drive, in the order of efforts; by default those that the file drives"),
           {"output", KeyType::string, "", no_default,
            "the body whose motion is reported; by default the one farthest from the base, counted in joints, that "
            "does not spin alone"},
           texts("close", "`\"A:B\"`: a ball joins the frame origins of these two links"),
           {"base", KeyType::string, "", no_default, "a body that stands still"},
           {"key", KeyType::string, "", no_default, "a keyframe of an MJCF whose pose is the initial one"},
           {"gravity", KeyType::vector, "m/s²", no_default, "instead of the file's"},
           tableKey("numbers", no_default, "numbers in place of the file's: `\"body.NAME.mass\" = 1.2`, as in a sweep",
                    "mechanism.numbers"),
           texts("leave_out",
                 "what of the file is left out: `fluid`, `springs`, `limits`, `ball-friction`, `passive-friction`, "
                 "`passive-armature`")}};
}

ScenarioTable numbers() {
  return {"mechanism.numbers",
          "[mechanism.numbers]",
          "Numbers in place of the model's: `\"body.NAME.mass\"`, `.center_of_mass.0` to `.2`, `.inertia.xx` …, "
          "`\"joint.NAME.damping\"`, `friction`, `armature`, `stiffness`, `springref`, `\"gravity.2\"`.",
          {}};
}

ScenarioKey kind() {
  return choiceKey("kind", required_key, "what the motion is made of", {"fourier", "samples", "hold"});
}

ScenarioKey duration() { return {"duration", KeyType::number, "s", required_key, "t_f", above_zero}; }

std::vector<ScenarioTable> motions() {
  return {
      {"trajectory", "[trajectory]", "Its other keys depend on `kind`, see below.", {kind()}},
      {"trajectory.fourier",
       "[trajectory], kind = \"fourier\"",
       "q_k(t) = offset + Σ sin_j sin(2πj t/period) + cos_j cos(2πj t/period), j from 1.",
       {kind(),
        duration(),
        {"period", KeyType::number, "s", no_default, "by default the duration", above_zero},
        tableKey("motors", required_key, "one for each motor", "trajectory.fourier.motors", KeyType::tables)}},
      {"trajectory.fourier.motors",
       "motors = [{ … }, …]",
       "",
       {{"offset", KeyType::number, "rad or m", "0.0", ""},
        {"sin", KeyType::numbers, "rad or m", "[]", "amplitudes"},
        {"cos", KeyType::numbers, "rad or m", "[]", "amplitudes"}}},
      {"trajectory.samples",
       "[trajectory], kind = \"samples\"",
       "Through the motors' coordinates, sampled densely.",
       {kind(),
        {"file", KeyType::string, "", required_key,
         "a CSV with `t_s` and `q_k_rad` or `q_k_m` for each motor k, also by the joint's name; optional "
         "`qdot_k_rad_s`, "
         "`qddot_k_rad_s2` (`_m_…`)"}}},
      {"trajectory.hold",
       "[trajectory], kind = \"hold\"",
       "At rest.",
       {kind(), duration(), {"motors", KeyType::numbers, "rad or m", required_key, "one coordinate for each motor"}}}};
}

}  // namespace

const std::vector<ScenarioTable>& mechanismTables() {
  static const std::vector<ScenarioTable> tables = [] {
    std::vector<ScenarioTable> all = {document(), mechanism(), numbers()};
    for (ScenarioTable& each : motions()) all.push_back(std::move(each));
    return all;
  }();
  return tables;
}

const ScenarioTable& mechanismTable(std::string_view name) {
  for (const ScenarioTable& each : mechanismTables())
    if (name == each.name) return each;
  throw std::out_of_range("no table '" + std::string(name) + "' in the scenario of a mechanism");
}

}  // namespace ursula
