#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/verdict/result.h"

// Two or three mistakes that together make a deviation which none makes alone, for machines of every kind.

namespace ursula {

/// A mistake that a solver may have made before its last step. Efforts are of all instants, one after the other, N·m
/// or N.
struct Suspect {
  NamedCause named;
  Eigen::VectorXd effect;  ///< what it adds to the right efforts; by its number, if it has one, to first order
  bool has_number = false;
  double step = 1e-5;  ///< of its number, for differences
};

/// A mistake in the efforts of one instant: their order, signs and units, or a factor or an offset with a number x.
struct OutputMistake {
  std::vector<Eigen::Index> from = {};     ///< whose effort each motor's is; empty for its own
  Eigen::VectorXd factor = {};             ///< of each motor; empty for 1
  Eigen::VectorXd gain = {}, offset = {};  ///< of each motor, times x; empty for none

  bool hasNumber() const { return gain.size() + offset.size() > 0; }
  /// The wrong efforts of all instants.
  Eigen::VectorXd of(const Eigen::VectorXd& efforts, double x) const;
  /// The efforts of which these were made; of mistakes without a number.
  Eigen::VectorXd undone(const Eigen::VectorXd& efforts) const;
};

/// Signs, units, and orders; of many motors those that exchange two. Then, from `discrete` on, factors and offsets.
std::vector<OutputMistake> outputMistakes(Eigen::Index motors, std::size_t& discrete);

/// Several mistakes with their numbers, zero for those without one.
struct Mistakes {
  std::vector<std::size_t> which;  ///< suspects, then outputs, which come after all suspects
  Eigen::VectorXd x;
  int numbers = 0;
  double unexplained = 1;                  ///< ‖left‖ / ‖residual‖
  double beyond = 1e300;                   ///< the largest remainder, in multiples of its limit
  std::vector<std::size_t> any_body = {};  ///< those of `which` that another set has of another body

  Mistakes only(std::size_t member) const { return {{which[member]}, x.segment(static_cast<Eigen::Index>(member), 1)}; }
};

/// What the numbers of several mistakes lack of certainty because they are fitted together, for each mistake.
struct NumbersDoubt {
  Eigen::VectorXd inflation;  ///< times as uncertain as alone; 1 or more
  Eigen::VectorXd shift;      ///< another number if the mistakes act in the other order, and then explain as much
};

/// Efforts with some suspects' mistakes at once; nullopt if there are none.
using EffortsTogether =
    std::function<std::optional<Eigen::VectorXd>(const std::vector<std::size_t>& which, const Eigen::VectorXd& x)>;

/// Looks for several mistakes at a few instants, at which `together` answers.
class Pursuit {
 public:
  Pursuit(std::vector<Suspect> suspects, Eigen::VectorXd right, Eigen::VectorXd found, Eigen::VectorXd limit,
          Eigen::Index motors, EffortsTogether together);

  /// Returns all pairs that explain everything, those with fewest numbers first; otherwise all such triples. Each of
  /// their mistakes is needed: without it much more is left.
  std::vector<Mistakes> all() const;
  /// Those of `all` with fewest numbers, without such that are like an earlier one.
  std::vector<Mistakes> best() const;
  /// The efforts with these mistakes by another `together`, as of further instants.
  std::optional<Eigen::VectorXd> efforts(const Mistakes& of, const EffortsTogether& together) const;
  /// How well the numbers are known beside each other.
  NumbersDoubt doubt(const Mistakes& mistakes) const;

 private:
  void setColumns();
  bool isOutput(std::size_t place) const { return place >= suspects_.size(); }
  const OutputMistake& output(std::size_t place) const { return outputs_[place - suspects_.size()]; }
  bool hasNumber(std::size_t place) const;
  double step(std::size_t place) const { return isOutput(place) ? 1e-5 : suspects_[place].step; }
  Eigen::VectorXd left(const Mistakes& of) const;
  Eigen::MatrixXd slopes(const Mistakes& at, const std::vector<Eigen::Index>& numbers) const;
  std::vector<Eigen::Index> numbersOf(const Mistakes& mistakes) const;
  void improve(Mistakes& mistakes, int steps) const;
  std::vector<Mistakes> singles() const;
  Eigen::MatrixXd basisAt(const Mistakes& inner, const Eigen::VectorXd& base) const;
  void extend(const Mistakes& start, std::vector<Mistakes>& out) const;
  std::vector<Mistakes> extended(const std::vector<Mistakes>& smaller) const;
  bool isEachNeeded(const Mistakes& mistakes) const;
  bool areAlike(std::size_t i, std::size_t j) const;

  std::vector<Suspect> suspects_;
  std::size_t discrete_ = 0;            ///< the number of outputs without a number
  std::vector<OutputMistake> outputs_;  ///< those without a number come first
  Eigen::VectorXd right_, found_, limit_;
  EffortsTogether together_;
  std::vector<std::size_t> places_;  ///< of the columns
  Eigen::MatrixXd columns_;          ///< effects to first order
};

/// The names and words of several mistakes, the largest first, each with its share of the deviation's square.
struct SeveralNamed {
  std::vector<NamedCause> together;
  std::string words;
  std::vector<NamedCause> ties = {};  ///< what explains as much as one of them
  bool is_sure = true;                ///< nothing else explains as much
};

/// The name of one mistake, in the contract's terms and in words.
struct NamedAlone {
  NamedCause cause;
  std::function<std::string(double wider)> words;  ///< for an uncertainty that is so many times as large
  std::string others = {};                         ///< "; as well explained by: …", or empty
  std::vector<NamedCause> ties = {};               ///< what explains as much
};
/// Names one mistake by what the efforts would be if it were the only one: right ones and `effect`. Returns nullopt if
/// it has no name.
using NameAlone = std::function<std::optional<NamedAlone>(const Eigen::VectorXd& effect)>;

/// Names each mistake of the first of `sets` as if it were the only one, by what remains of the residual without the
/// others, and says which other sets explain as much. `together` answers at all instants of the residual.
std::optional<SeveralNamed> nameEach(const Pursuit& pursuit, const std::vector<Mistakes>& sets,
                                     const Eigen::VectorXd& residual, const EffortsTogether& together,
                                     const NameAlone& name);

}  // namespace ursula
