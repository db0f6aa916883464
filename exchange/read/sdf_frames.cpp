#include "exchange/read/sdf_parts.h"

#include <fmt/format.h>

#include "base/text.h"

namespace ursula::exchange {

SdfFrames::SdfFrames() : frames_(1), names_(1), done_(1, 1), in_world_(1, Eigen::Isometry3d::Identity()) {
  names_[0].emplace("world", world);
}

std::size_t SdfFrames::add(const std::string& name, Frame frame) {
  const std::size_t index = frames_.size();
  if (!names_[frame.scope].emplace(name, index).second)
    refuse(*frame.element, fmt::format("a second '{}' in one model, expected unique names", shown(name)));
  frames_.push_back(std::move(frame));
  names_.emplace_back();
  done_.push_back(0);
  in_world_.push_back(Eigen::Isometry3d::Identity());
  return index;
}

std::size_t SdfFrames::find(const Element& at, std::size_t scope, const std::string& name, const char* what) const {
  if (name == "__model__") return scope;
  std::size_t from = 0;
  while (true) {
    if (const auto whole = names_[scope].find(name.substr(from)); whole != names_[scope].end()) return whole->second;
    const std::size_t end = name.find("::", from);
    const auto next = names_[scope].find(name.substr(from, end == std::string::npos ? end : end - from));
    if (end == std::string::npos || next == names_[scope].end()) break;
    scope = next->second;
    from = end + 2;
  }
  if (name == "world") return world;
  std::vector<std::string> known;
  for (const auto& [each, index] : names_[scope])
    if (known.size() < 1000) known.push_back(each);
  std::sort(known.begin(), known.end());
  refuse(at, fmt::format("{} '{}': nothing has that name here{}", what, shown(name), didYouMean(name, known)));
}

std::size_t SdfFrames::parentOf(std::size_t i) const {
  const Frame& frame = frames_[i];
  if (frame.relative_to.empty()) return frame.parent;
  return find(*frame.element, frame.scope, frame.relative_to, "relative_to");
}

Eigen::Isometry3d SdfFrames::inWorld(std::size_t frame) {
  std::vector<std::size_t> open;
  for (std::size_t i = frame; done_[i] != 1; i = parentOf(i)) {
    if (done_[i] == 2) refuse(*frames_[i].element, "its pose is relative to itself, in a circle");
    done_[i] = 2;
    open.push_back(i);
  }
  for (auto i = open.rbegin(); i != open.rend(); ++i) {
    in_world_[*i] = in_world_[parentOf(*i)] * frames_[*i].pose;
    done_[*i] = 1;
  }
  return in_world_[frame];
}

void SdfFrames::requireSound() {
  std::vector<std::size_t> state(frames_.size(), none);  // the frame from which each was met
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    static_cast<void>(inWorld(i));
    for (std::size_t at = i; frames_[at].kind == Kind::frame && state[at] == none;) {
      const Frame& here = frames_[at];
      state[at] = i;
      at = find(*here.element, here.scope, here.attached_to.empty() ? "__model__" : here.attached_to, "attached_to");
      if (state[at] == i) refuse(*here.element, "is attached to itself, in a circle");
    }
  }
}

std::size_t SdfFrames::bodyOf(const Element& at, std::size_t frame) const {
  for (std::size_t step = 0; step <= frames_.size(); ++step) {
    const Frame& here = frames_[frame];
    if (here.kind == Kind::world) return none;
    if (here.body != none) return here.body;  // a link, or a model's first link
    if (here.kind == Kind::model) refuse(at, "a model without links, expected a link");
    frame = find(*here.element, here.scope, here.attached_to.empty() ? "__model__" : here.attached_to, "attached_to");
  }
  refuse(at, "its frame is attached to itself, in a circle");
}

}  // namespace ursula::exchange
