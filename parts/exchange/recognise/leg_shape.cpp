#include "parts/exchange/recognise/legs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"

namespace ursula::exchange {
namespace {

using Kind = Primitive::Kind;
using Body = std::optional<std::size_t>;

/// The joints of a kind of leg from the base, a letter for each joint of a file: "RRPS" of U P S.
struct KindOfChain {
  explicit KindOfChain(LegKind of) : kind(of), universal(rowOf(of).joints_of_proximal == 2 ? 0 : 1) {
    for (const Coordinate each : rowOf(of).coordinates) joints += slides(each) ? 'P' : 'R';
    joints += 'S';
    // A ball in place of U leaves the line from it to the other ball free to spin; in U R S the knee is off that line.
    if (universal == 1 || rowOf(of).isTelescopic()) with_free_rod = std::string(joints).replace(universal, 2, "S");
  }

  LegKind kind;
  std::size_t universal;  ///< index of the universal joint's first hinge
  std::string joints, with_free_rod;
};

std::string spaced(const std::string& word) { return fmt::format("{}", fmt::join(word, " ")); }

/// Returns "U R S, U P S, R U S or P U S".
std::string knownChains() {
  std::string out;
  for (std::size_t k = 0; k < leg_kind_count; ++k)
    out += (k == 0 ? "" : k + 1 < leg_kind_count ? ", " : " or ") + spaced(leg_kinds[k].name);
  return out;
}

class Shaper {
 public:
  Shaper(const ModelGraph& graph, const Groups& groups, const Chain& chain, double size, const ImportChoices& choices)
      : graph_(graph),
        groups_(groups),
        line_(graph.joints[chain.primitives[0].joint].line),
        tokens_(chain.primitives),
        size_(size),
        choices_(choices) {
    shape_.place = chain.place(graph);
    for (const Primitive& each : tokens_)
      if (each.behind) leg_moment_ += largestMoment(groups.groups[*each.behind].inertiaAbout(tokens_[0].inner));
  }

  LegShape shape() {
    gatherBalls();
    dropIdleSpin();
    const std::string found = word();
    if (found == "SPRR")
      refuseLeg("is S P U from the base; the legs are U P S, and base and platform cannot be exchanged");
    // Several kinds can have these letters; the one whose universal joint fits best is taken.
    std::optional<KindOfChain> best;
    for (std::size_t k = 0; k < leg_kind_count; ++k) {
      const KindOfChain kind(static_cast<LegKind>(k));
      if (found == kind.with_free_rod) return withFreeRod(kind);
      if (found == kind.joints && (!best || badness(kind.universal) < badness(best->universal))) best = kind;
    }
    if (best) return withUniversal(*best);
    refuseLeg(
        fmt::format("has the joints {} from the base, expected {} (U: two hinges that meet at right angles, S: a ball "
                    "or three hinges through one point){}",
                    spaced(found), knownChains(), no_ball_));
  }

 private:
  [[noreturn]] void refuseLeg(const std::string& what) const {
    throw ImportError(fmt::format("the leg of {} {}", shape_.place, what), line_);
  }

  std::string word() const {
    std::string out;
    for (const Primitive& token : tokens_) out += "RPS"[static_cast<int>(token.kind)];
    return out;
  }

  double tolerance() const { return choices_.tolerance * size_; }

  /// Notes a part of the tolerance that is used, unless it is rounding.
  void use(const char* what, const std::string& where, double by, const char* unit, double scale) {
    if (by > worth_saying * scale) shape_.assumptions.push_back({what, where, by, unit});
  }

  /// Merges three hinges that meet in one point and are not coplanar, from the platform inwards.
  void gatherBalls() {
    for (std::size_t end = tokens_.size(); end >= 3;) {
      const std::optional<Vector3d> centre = centreOf(end - 3);
      if (!centre) {
        --end;
        continue;
      }
      Primitive ball = tokens_[end - 3];
      ball.kind = Kind::S;
      ball.axis.setZero();
      const Primitive& last = tokens_[end - 1];
      const Vector3d from_last = *centre - last.inner;
      ball.inner = *centre;
      ball.outer = last.outer + from_last + from_last.dot(last.axis) * (last.outer_axis - last.axis);
      ball.behind = last.behind;
      requirePlain({end - 3, end - 2, end - 1}, "a ball");
      for (const std::size_t k : {end - 3, end - 2})
        if (tokens_[k].behind) noteCross(*tokens_[k].behind, *centre, end == tokens_.size(), end == 3);
      tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(end) - 3,
                    tokens_.begin() + static_cast<std::ptrdiff_t>(end));
      tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(end) - 3, ball);
      end -= 3;
    }
    for (std::size_t k = 0; k < tokens_.size(); ++k)
      if (tokens_[k].kind == Kind::S) requirePlain({k}, "a ball");
  }

  std::string nameOf(std::size_t token) const { return shown(graph_.joints[tokens_[token].joint].name); }

  /// Returns the centre of a ball of three hinges. If they are none, keeps for a refusal why.
  std::optional<Vector3d> centreOf(std::size_t first) {
    const std::optional<HingePoint> met = hingePoint(&tokens_[first]);
    if (!met) return {};
    const std::string hinges =
        fmt::format("; the axes of the hinges {}, {} and {}", nameOf(first), nameOf(first + 1), nameOf(first + 2));
    if (met->off > tolerance() && no_ball_.empty())
      no_ball_ = fmt::format(
          "{} are no ball: they pass each other at up to {:.6g} m, {:.3g} of the machine's size, "
          "expected within {:g} (--tolerance)",
          hinges, met->apart, met->apart / size_, choices_.tolerance);
    return met->off <= tolerance() && !hasLinkWithin(first, met->at, hinges) ? std::optional(met->at) : std::nullopt;
  }

  /// Returns whether a body between three hinges through one point is a link of the leg, and no cross: it is heavy, or
  /// the body before it has no mass.
  bool hasLinkWithin(std::size_t first, const Vector3d& centre, const std::string& hinges) {
    const bool bare = first > 0 && tokens_[first - 1].behind && groups_.groups[*tokens_[first - 1].behind].isFrame();
    for (const std::size_t k : {first, first + 1}) {
      if (!tokens_[k].behind) continue;
      const Group& body = groups_.groups[*tokens_[k].behind];
      const double share = largestMoment(body.inertiaAbout(centre)) / leg_moment_;
      if (body.isFrame() || !(bare || share > std::max(heavy, choices_.lump))) continue;
      no_ball_ = fmt::format(
          "{} meet in one point, but body {} between them has {:.3g} of the leg's moments: it is a link, no cross{}",
          hinges, shown(body.name), share, bare ? "" : " (--lump)");
      if (word() == "RRPRRR")
        no_ball_ += ". The leg is U C U: its rod turns about its own line with the platform's joint";
      return true;
    }
    return false;
  }

  void noteCross(std::size_t group, const Vector3d& centre, bool at_platform, bool at_base) {
    shape_.crosses.push_back({group,
                              at_platform ? Cross::Rides::platform
                              : at_base   ? Cross::Rides::base
                                          : Cross::Rides::proximal,
                              centre});
  }

  /// Requires that no motor drives the joints and no friction acts, because a scenario cannot express that.
  void requirePlain(const std::vector<std::size_t>& tokens, const char* what) const {
    for (const std::size_t k : tokens) {
      const GraphJoint& joint = graph_.joints[tokens_[k].joint];
      const auto complain = [&](const std::string& why) {
        refuseJoint(joint, fmt::format(", {} of the leg of {}, {}", what, shape_.place, why));
      };
      if (joint.driven) complain("is driven, expected a motor on a coordinate of the leg");
      if (joint.damping != 0 || joint.friction != 0)
        complain(fmt::format("rubs (damping {}, friction {}), which a scenario has no key for", joint.damping,
                             joint.friction));
      if (joint.rotor_inertia != 0)
        complain(
            fmt::format("has a rotor's inertia of {} (armature) and is not driven, which a scenario has no key for",
                        joint.rotor_inertia));
    }
  }

  /// Drops a hinge along the leg's own line beside a ball, because it only lets the rod spin.
  void dropIdleSpin() {
    const std::string found = word();
    std::size_t at = 0;
    if (found == "RRPRS" || found == "SPRS" || found == "RRRRS" || found == "PRRRS") at = found.size() - 2;
    if (found == "RRRPS" || found == "SRPS") at = found.size() - 3;
    if (at == 0) return;
    const std::size_t last = tokens_.size() - 1;
    const Primitive& hinge = tokens_[at];
    // The line ends at the ball; it begins at the previous joint, or at the base.
    const Vector3d ball = tokens_[last].inner;
    const bool telescopic = found.find('P') != std::string::npos && found[0] != 'P';
    const Vector3d from = telescopic ? tokens_[found[0] == 'S' ? 0 : 1].outer : tokens_[at - 1].outer;
    const double off = (ball - hinge.inner).cross(hinge.axis).norm();
    const double angle = std::asin(std::min(1.0, (ball - from).normalized().cross(hinge.axis).norm()));
    if (!(off <= tolerance() && angle <= choices_.tolerance)) return;
    requirePlain({at}, "idle spin");
    const std::string& name = graph_.joints[hinge.joint].name;
    use("This hinge is taken to lie on the leg's line; it is beside it", name, off, "m", size_);
    use("This hinge is taken to lie on the leg's line; it is turned from it", name, angle, "rad", 1);
    if (tokens_[at].behind) shape_.spinning.push_back(*tokens_[at].behind);
    if (at + 2 < tokens_.size() && tokens_[at + 1].behind) shape_.spinning.push_back(*tokens_[at + 1].behind);
    // A spinning body before a slide belongs to the cylinder, one before the ball to the rod.
    Primitive& before = tokens_[at - 1];
    (found[at + 1] == 'P' ? extra_proximal_ : extra_distal_) = tokens_[at].behind;
    if (!before.behind) {
      before.behind = tokens_[at].behind;
      (found[at + 1] == 'P' ? extra_proximal_ : extra_distal_).reset();
    }
    tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  std::size_t link(std::size_t token) const {
    if (tokens_[token].behind) return *tokens_[token].behind;
    refuseLeg(fmt::format("has no body between joints {} and {}, expected a link", nameOf(token), nameOf(token + 1)));
  }

  LegShape finish(std::size_t proximal, std::size_t distal) {
    shape_.joints = tokens_;
    shape_.proximal.push_back(proximal);
    shape_.distal.push_back(distal);
    if (extra_proximal_) shape_.proximal.push_back(*extra_proximal_);
    if (extra_distal_) shape_.distal.push_back(*extra_distal_);
    return shape_;
  }

  LegShape withFreeRod(const KindOfChain& kind) {
    shape_.kind = kind.kind;
    shape_.inner_ball = kind.universal;
    return finish(link(0), link(1));
  }

  LegShape withUniversal(const KindOfChain& kind) {
    const std::size_t first = kind.universal;
    shape_.kind = kind.kind;
    requireUniversal(first);
    if (tokens_[first].behind) noteCross(*tokens_[first].behind, meeting(first).at, false, first == 0);
    return first == 0 ? finish(link(1), link(2)) : finish(link(0), link(2));
  }

  CommonPerpendicular meeting(std::size_t k) const {
    const Primitive &a = tokens_[k], &b = tokens_[k + 1];
    return commonPerpendicular(a.outer, a.axis, b.inner, b.axis);
  }

  /// Returns how much two hinges differ from a universal joint.
  double badness(std::size_t k) const { return std::abs(std::cos(meeting(k).angle)) + meeting(k).apart / size_; }

  void requireUniversal(std::size_t k) {
    const CommonPerpendicular met = meeting(k);
    const double off_square = std::abs(std::asin(std::min(1.0, std::cos(met.angle))));
    if (met.apart <= tolerance() && off_square <= choices_.tolerance) {
      const std::string hinges =
          fmt::format("{}, {}", graph_.joints[tokens_[k].joint].name, graph_.joints[tokens_[k + 1].joint].name);
      use("These hinges' axes are taken to meet; they pass each other", hinges, met.apart, "m", size_);
      use("These hinges' axes are taken to be square", hinges, off_square, "rad", 1);
      return;
    }
    refuseLeg(fmt::format(
        "has hinges {} and {} whose axes pass each other at {:.6g} m ({:.3g} of the machine's size) and have an angle "
        "of {:.6g}° between them, expected a universal joint: axes that meet at 90°, within {:g} (--tolerance)",
        nameOf(k), nameOf(k + 1), met.apart, met.apart / size_, met.angle * degrees_per_radian, choices_.tolerance));
  }

  static constexpr double heavy = 0.1;  ///< of the leg's moments; a cross has less

  const ModelGraph& graph_;
  const Groups& groups_;
  int line_;
  std::vector<Primitive> tokens_;  ///< single-axis joints, and balls of one joint or three hinges
  double size_;
  const ImportChoices& choices_;
  double leg_moment_ = 0;
  std::string no_ball_;  ///< why three hinges are no ball
  Body extra_proximal_, extra_distal_;
  LegShape shape_;
};

}  // namespace

std::optional<std::size_t> LegShape::jointOf(std::size_t coordinate) const {
  if (!inner_ball || coordinate < *inner_ball) return coordinate;
  if (coordinate < *inner_ball + 2) return {};
  return coordinate - 1;
}

LegShape shapeOf(const ModelGraph& graph, const Groups& groups, const Chain& chain, double size,
                 const ImportChoices& choices) {
  return Shaper(graph, groups, chain, size, choices).shape();
}

}  // namespace ursula::exchange
