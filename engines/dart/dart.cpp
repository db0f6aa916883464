// The module is loaded on first use, because DART's many libraries slow every start.

#include <dlfcn.h>

#include <stdexcept>

#include "engines/dart/dart_module.h"

namespace ursula {
namespace {

/// Returns null if the module is not beside the program, or if DART is not installed.
const DartModule* module() {
  static const DartModule* const found = [] {
    void* library = ::dlopen("ursula_dart.so", RTLD_NOW | RTLD_LOCAL);
    return library == nullptr ? nullptr : static_cast<const DartModule*>(::dlsym(library, "ursula_dart_module"));
  }();
  return found;
}

}  // namespace

bool dartCallsAvailable() { return module() != nullptr; }

std::string dartVersion() { return dartCallsAvailable() ? module()->version : "none"; }

std::unique_ptr<LoopEngine> makeDartCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  if (!dartCallsAvailable()) throw std::runtime_error("DART is not there");
  return module()->make(manipulator, std::move(load));
}

}  // namespace ursula
