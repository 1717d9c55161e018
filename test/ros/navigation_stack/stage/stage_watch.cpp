// A controller for the simulator Stage: keeps the simulation to a multiple of the computer's clock (without a window
// Stage runs as fast as it can), and writes what is true of the robot, a line a step: time (s), x, y (m), yaw (rad),
// stalled (0 or 1). A robot stalls where it touches something. In the world file, in the robot's model:
//
//   ctrl "PATH/libstage_watch FACTOR FILE"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stage.hh>
#include <string>
#include <thread>

namespace {

struct Watch {
  using Clock = std::chrono::steady_clock;

  std::chrono::duration<double> period;  ///< of the computer's clock, between two steps
  std::ofstream truth;
  Clock::time_point due = Clock::now();
};

int afterStep(Stg::Model* robot, void* data) {
  Watch& watch = *static_cast<Watch*>(data);
  const Stg::Pose pose = robot->GetGlobalPose();
  watch.truth << robot->GetWorld()->SimTimeNow() * 1e-6 << ' ' << pose.x << ' ' << pose.y << ' ' << pose.a << ' '
              << robot->Stalled() << std::endl;
  watch.due =
      std::max(watch.due + std::chrono::duration_cast<Watch::Clock::duration>(watch.period), Watch::Clock::now());
  std::this_thread::sleep_until(watch.due);
  return 0;
}

}  // namespace

extern "C" int Init(Stg::Model* robot, Stg::CtrlArgs* arguments) {
  std::istringstream words(arguments->worldfile);
  std::string library, path;
  double factor = 1.0;
  words >> library >> factor >> path;
  auto* watch = new Watch;  // as long as the process lives
  watch->period = std::chrono::duration<double>(robot->GetWorld()->sim_interval * 1e-6 / factor);
  watch->truth.open(path);
  watch->truth.precision(9);
  robot->AddCallback(Stg::Model::CB_UPDATE, afterStep, watch);
  return 0;
}
