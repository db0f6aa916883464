#include "parts/engines/mujoco/mujoco_text_internal.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <functional>
#include <mutex>
#include <stdexcept>

namespace ursula::mujoco {
namespace {

[[noreturn]] void throwWords(const char* message) { throw std::runtime_error(fmt::format("MuJoCo: {}", message)); }

Model parse(const std::function<mjModel*(char* error, int size)>& load) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  mju_user_error = mju_user_warning = throwWords;  // by default it exits, prints and writes a log
  std::array<char, 1000> error{};
  Model model(load(error.data(), static_cast<int>(error.size())));
  if (!model) throwWords(error.data());
  return model;
}

}  // namespace

Model parseText(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const char* name = "machine.xml";
  if (mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size())) != 0) throwWords("no room for the text");
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], text.data(), text.size());
  struct Release {
    mjVFS* files;
    ~Release() { mj_deleteVFS(files); }
  } release{files.get()};
  return parse([&](char* error, int size) { return mj_loadXML(name, files.get(), error, size); });
}

Model parseFile(const std::filesystem::path& file) {
  return parse([&](char* error, int size) { return mj_loadXML(file.c_str(), nullptr, error, size); });
}

Data dataOf(const mjModel& model) {
  Data out(mj_makeData(&model));
  if (!out) throwWords("no memory for its data");
  return out;
}

}  // namespace ursula::mujoco
