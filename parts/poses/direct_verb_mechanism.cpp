#include <fmt/format.h>

#include <vector>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/text.h"
#include "model/motor_table.h"
#include "parts/poses/direct_mechanism.h"
#include "validation/mechanism/output_pose.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// The rows written so far.
class AssemblyTable {
 public:
  AssemblyTable(const LoopSolver& solver, bool has_time) : solver_(solver), has_time_(has_time) {}

  void add(double t, const Eigen::VectorXd& q, const LoopWork& work) {
    const std::vector<LoopSolver::JointValue> joints = solver_.joints(work);
    if (names_.empty()) nameColumns(joints);
    std::size_t at = 0;
    if (has_time_) columns_[at++].push_back(t);
    for (const double each : q) columns_[at++].push_back(each);
    for (const LoopSolver::JointValue& joint : joints) columns_[at++].push_back(joint.value);
    for (const double each :
         numbersOf(outputPose(solver_.mechanism(), work.bodies[solver_.mechanism().output()].displacement)))
      columns_[at++].push_back(each);
  }
  std::string text() const { return csvText(names_, columns_); }

 private:
  void nameColumns(const std::vector<LoopSolver::JointValue>& joints) {
    if (has_time_) names_.emplace_back("t_s");
    for (std::size_t k = 0; k < solver_.mechanism().motorCount(); ++k)
      names_.push_back(motorColumn(solver_.mechanism(), k, "q"));
    for (const LoopSolver::JointValue& joint : joints) names_.push_back(joint.name);
    for (const char* name : output_columns) names_.emplace_back(name);
    columns_.resize(names_.size());
  }

  const LoopSolver& solver_;
  bool has_time_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace

int directOfMechanism(const MechanismScenario& scenario, const std::filesystem::path& motion, const std::string& out,
                      const std::vector<std::string>& map) {
  const MotorTable read = readMotorTable(motion, *scenario.mechanism, map, false);
  std::vector<std::string> used = scenario.mapped;
  used.insert(used.end(), read.mapped.begin(), read.mapped.end());
  requireUsed(map, used);
  if (!read.read_as.empty()) say("{}: read as: {}\n", shownPath(motion.string()), read.read_as);
  const CsvTable& given = read.table;
  const Eigen::MatrixXd q = motorColumns(given, *scenario.mechanism, "q", true);
  const std::vector<double>* t = given.find("t_s");
  if (q.rows() == 0)
    throw CsvError(fmt::format("{}: error: no row, expected the motors' coordinates", motion.string()));
  return alongLoops(scenario, [&] {
    const MechanismAlong path(scenario);
    loops::LoopPose pose = path.motion().near(0);
    AssemblyTable table(path.solver(), t != nullptr);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.cols());
    LoopWork work;
    for (Eigen::Index i = 0; i < q.rows(); ++i) try {
        const MotorMotion asked{t == nullptr ? 0 : (*t)[i], q.row(i), rest, rest};
        path.solver().moveTo(asked.q, pose);
        path.solver().kinematics(asked, pose, work);
        pose = work.pose;
        table.add(asked.t, asked.q, work);
      } catch (const LoopError& error) {
        throw CsvError(fmt::format("{}: error: {}", given.place(i), error.what()));
      }
    writeOutput(out, table.text());
    return exit_passed;
  });
}

}  // namespace ursula
