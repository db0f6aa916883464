#include "report/check_words.h"

#include <algorithm>

namespace ursula::report {
namespace {

struct Entry {
  const char *name, *title, *meaning;
};

const Entry entries[] = {
    {"motion.pose", "Commanded pose",
     "The pose in doubles is that in 50 digits: the motion asked for is well defined."},
    {"motion.twist", "Commanded velocity", "Velocities are the pose's derivatives."},
    {"motion.twist_rate", "Commanded acceleration", "Accelerations are the pose's second derivatives."},
    {"motion.load", "Load over time", "The load passes through its table and never leaves its range."},
    {"kinematics.joint_angles", "Joint coordinates", "The solver's joint coordinates are those of Simbody's loop."},
    {"kinematics.joint_rates", "Joint rates", "Likewise their rates, against Simbody's constraint Jacobian."},
    {"kinematics.joint_accelerations", "Joint accelerations", "Likewise their accelerations."},
    {"kinematics.positions", "Positions of all bodies", "Mass centres and orientations of every body agree."},
    {"kinematics.twists", "Velocities of all bodies", "Linear and angular velocities of every body agree."},
    {"kinematics.accelerations", "Accelerations of all bodies",
     "Linear and angular accelerations of every body agree."},
    {"kinematics.jacobian", "Jacobian", "The Jacobian makes the commanded velocity of Simbody's joint rates."},
    {"kinematics.jacobian_rate", "Jacobian's rate", "With its rate it makes the commanded acceleration."},
    {"kinematics.jacobian_difference", "Jacobian's rate by differences",
     "The rate is the derivative of the Jacobian itself."},
    {"torque.pointwise", "Efforts against Simbody",
     "The efforts are those of Simbody's own inverse dynamics, at every instant."},
    {"acceleration.pointwise", "Simbody's acceleration under the efforts",
     "Simbody, given the efforts, accelerates the platform as commanded."},
    {"torque.against_noc", "File against the NOC", "The file's efforts are those of this program's solver."},
    {"torque.twin", "Simbody, cut elsewhere", "It does not matter where the loops are cut."},
    {"torque.maximal", "Maximal coordinates",
     "Newton and Euler for free bodies with multipliers give the same efforts."},
    {"torque.mujoco", "MuJoCo", "Another engine's trees, closed by multipliers, give the same efforts."},
    {"complement.orthogonality", "T across D", "T is orthogonal to the constraints that it frees the motion from."},
    {"complement.rank", "Ranks of T and D", "T spans all that the constraints leave free."},
    {"invariance.rotation", "World turned", "Turning the world, gravity included, changes no effort."},
    {"invariance.axes", "Axes moved", "Other axes on the platform and another origin change no effort."},
    {"invariance.units", "Units changed", "Other units of length, mass and time change no effort."},
    {"invariance.labels", "Legs relabelled", "Relabelled legs carry their efforts along."},
    {"invariance.mass", "Masses doubled", "Twice the mass needs twice the effort."},
    {"invariance.time_reversal", "Time reversed", "Without friction the efforts are the same backwards."},
    {"reactions.pointwise", "Joint reactions", "Forces and moments in the joints are Simbody's."},
    {"torque.between", "Between the samples", "Nothing happens between the instants looked at."},
    {"direct.pointwise", "Direct dynamics", "The solver's accelerations under the efforts are the commanded ones."},
    {"direct.off_path", "Beside the path", "The accelerations are right in other states, too."},
    {"fast.inverse", "Fast efforts", "The kernels that users call give the NOC's efforts."},
    {"fast.direct", "Fast accelerations", "The kernels that users call give the NOC's accelerations."},
    {"fast.inverse_batch", "Efforts in batches", "Batches with each instruction set give the NOC's efforts."},
    {"fast.direct_batch", "Accelerations in batches",
     "Batches with each instruction set give the NOC's accelerations."},
    {"replay.position", "Position along the motion",
     "Simbody's loop, driven by the efforts alone, stays on the commanded path."},
    {"replay.orientation", "Orientation along the motion", "Likewise its orientation."},
    {"closure.position", "Loops stay closed", "The legs keep hold of the platform."},
    {"closure.velocity", "Loops stay closed, rates", "Likewise their velocities."},
    {"energy.balance", "Energy", "Energy gained is the motors' work, less what friction takes."},
    {"integration.ladder", "Finer steps, same motion", "The replay settles as its tolerance is tightened."},
    {"integration.second", "A second integrator", "Another integrator finds the same motion."},
    {"integration.order", "Order of the integrator", "The error falls at the order that the integrator has."},
    {"feedback.torque", "Held on the path", "A controller that holds Simbody on the path has nothing to add."},
};

}  // namespace

const std::vector<CheckGroup>& checkGroups() {
  static const std::vector<CheckGroup> groups = {
      {"Motors: the formulations agree on the efforts",
       {"torque", "acceleration", "reactions", "complement", "invariance", "direct"}},
      {"Fast kernels: what users call is the NOC", {"fast"}},
      {"Motion: the efforts make it in Simbody", {"replay", "closure", "energy", "feedback"}},
      {"Kinematics: solver and Simbody agree", {"kinematics"}},
      {"Numerics: the integration can be trusted", {"integration"}},
      {"Input: the motion asked for is well defined", {"motion"}},
  };
  return groups;
}

std::size_t groupOf(const std::string& check) {
  const std::string part = check.substr(0, check.find('.'));
  const std::vector<CheckGroup>& groups = checkGroups();
  const auto found = std::find_if(groups.begin(), groups.end(), [&part](const CheckGroup& group) {
    return std::find(group.of.begin(), group.of.end(), part) != group.of.end();
  });
  return static_cast<std::size_t>(found - groups.begin());
}

CheckWords checkWords(const std::string& check) {
  for (const Entry& entry : entries)
    if (check == entry.name) return {entry.title, entry.meaning};
  return {check, ""};
}

}  // namespace ursula::report
