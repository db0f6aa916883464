#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Frames of an SDF file: what stands where relative to what, by the names of each model.
class SdfFrames {
 public:
  static constexpr std::size_t world = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  enum class Kind { world, model, link, joint, frame };

  struct Frame {
    Kind kind = Kind::world;
    const Element* element = nullptr;
    std::size_t scope = 0;  ///< the model frame whose names it sees
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string relative_to;    ///< resolved in `scope`; empty: `parent`
    std::size_t parent = none;  ///< where nothing is said
    std::size_t body = none;    ///< of a link
    std::string attached_to;    ///< of a frame: whose body it is of
  };

  SdfFrames();
  /// Adds a frame under its name to a scope. Throws ImportError where the name is there already.
  std::size_t add(const std::string& name, Frame frame);
  /// "a::b", "__model__", "world". Throws ImportError where there is no such frame.
  std::size_t find(const Element& at, std::size_t scope, const std::string& name, const char* what) const;
  bool has(std::size_t scope, const std::string& name) const { return names_[scope].count(name) != 0; }

  /// In the world. Throws ImportError for a circle.
  Eigen::Isometry3d inWorld(std::size_t frame);
  /// The body that a link, a frame, a joint's child or a model's first link is; `none` for the world.
  std::size_t bodyOf(const Element& at, std::size_t frame) const;

  Frame& operator[](std::size_t i) { return frames_[i]; }

 private:
  std::size_t parentOf(std::size_t i) const;

  std::vector<Frame> frames_;
  std::vector<std::unordered_map<std::string, std::size_t>> names_;  ///< of each frame that is a scope
  std::vector<char> done_;
  std::vector<Eigen::Isometry3d> in_world_;
};

}  // namespace ursula::exchange
