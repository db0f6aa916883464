#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A scenario's right efforts at some instants, and the mistakes that leave them within their limits.
class BlindSpots {
 public:
  /// Rows are instants in order of time; `rounding` bounds that of each effort, N·m or N.
  BlindSpots(std::vector<Eigen::VectorXd> right, std::vector<Eigen::VectorXd> rounding,
             const std::optional<EffortTolerance>& tolerance, double duration);

  std::size_t instants() const { return right_.size(); }
  const Eigen::VectorXd& right(std::size_t k) const { return right_[k]; }
  /// Whether changes of the efforts at an instant are within the limits of the verdict.
  bool hides(std::size_t k, const Eigen::VectorXd& change) const;

  /// Adds a mistake whose largest change of an effort is known.
  void add(const std::string& mistake, const NamedCause& cause, double change);
  /// Adds a mistake if `wrong` gives efforts of every instant within their limits; it is asked no further once one is
  /// not. What it throws shows the mistake.
  template <class Wrong>
  void tryOut(const std::string& mistake, const NamedCause& cause, const Wrong& wrong) {
    double largest = 0;
    for (std::size_t i = 0; i < right_.size(); ++i) {
      const std::size_t k = i * stride % right_.size();  // early and late ones by turns: a difference shows soon
      const Eigen::VectorXd change = wrong(k) - right_[k];
      if (!hides(k, change)) return shows(cause);
      largest = std::max(largest, change.cwiseAbs().maxCoeff());
    }
    add(mistake, cause, largest);
  }
  /// Notes that a mistake shows. Signs, factors, closures and Jacobians of the same name are then left out; of other
  /// kinds the sentence says which.
  void shows(const NamedCause& cause);
  /// Adds mistakes in efforts alone: signs, factors, order, delay. `motor` is a motor's name, by its 0-based number.
  void addOfEfforts(const std::function<std::string(int motor)>& motor);

  /// Returns all, without those of one leg where all legs and each of them are alike.
  std::vector<BlindSpot> list(int legs) const;

 private:
  static constexpr std::size_t stride = 23;

  std::vector<Eigen::VectorXd> right_, limit_;
  double duration_, largest_ = 0;
  std::vector<std::pair<std::string, BlindSpot>> found_;  ///< with their causes' names, without numbers
  std::set<std::string> shown_;
};

/// Instants at which mistakes are tried; a prime, so that a stride reaches all of them.
constexpr std::size_t blind_instants = 61;
/// A number is wrong by this share of its size.
constexpr double wrong_by = 0.1;

}  // namespace ursula
