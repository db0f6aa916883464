#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "parts/exchange/mechanism_reader.h"
#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

inline std::filesystem::path written(const std::string& name, const std::string& text) {
  // Suites run at the same time, each in a process of its own.
  const std::string suite = testing::UnitTest::GetInstance()->current_test_info()->test_suite_name();
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("read_mechanism_" + suite);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return folder / name;
}

inline ModelRead mechanismOf(const std::string& name, const std::string& text, const MechanismChoices& choices = {}) {
  return readMechanismModel(written(name, text), choices);
}

inline std::string refusal(const std::string& name, const std::string& text, const MechanismChoices& choices = {}) {
  try {
    static_cast<void>(mechanismOf(name, text, choices));
  } catch (const InputError& error) {
    return error.what();
  } catch (const InvalidParameter& error) {
    return error.what();
  }
  return "none";
}

inline std::string together(const std::vector<std::string>& sentences) {
  std::string out;
  for (const std::string& each : sentences) out += each + "\n";
  return out;
}

inline const MechanismJoint& jointOf(const ModelRead& model, const std::string& name) {
  for (const MechanismJoint& joint : model.machine.joints)
    if (joint.name == name) return joint;
  throw std::out_of_range("no joint " + name);
}

inline const MechanismBody& bodyOf(const ModelRead& model, const std::string& name) {
  for (const MechanismBody& body : model.machine.bodies)
    if (body.name == name) return body;
  throw std::out_of_range("no body " + name);
}

}  // namespace ursula::exchange
