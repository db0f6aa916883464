// Every pose that the platform can have for the actuated angles at the motion's start: all_poses SCENARIO

#include <ursula/ursula.h>
#include <algorithm>
#include <cstdio>
#include <exception>

namespace {

int printPoses(const char* file) {
  const ursula::Scenario scenario = ursula::readScenario(file);
  const ursula::Motion<double> start = scenario.trajectory->at(0);

  //! [poses]
  const ursula::DirectKinematics direct(*scenario.manipulator);
  ursula::Workspace<double> work;
  direct.solver().displacements(start, work);
  const ursula::Vector6d phi = direct.solver().angles(work).phi;  // or measured ones, rad

  const ursula::PlatformPoses poses = direct.poses(phi);
  double nearest = 1;
  for (const ursula::PlatformPose& pose : poses) {
    std::printf("P at (%.6f, %.6f, %.6f) m, %s\n", pose.p.x(), pose.p.y(), pose.p.z(),
                pose.assembles ? "assembles" : "out of reach");
    nearest = std::min(nearest, (pose.p - start.p).norm());
  }
  //! [poses]
  std::printf("%d real poses of %d; the one commanded is found within %.1e m\n", poses.size, poses.counted, nearest);
  return poses.counted == 8 && nearest < 1e-9 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try { return argc < 2 ? 2 : printPoses(argv[1]); } catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
