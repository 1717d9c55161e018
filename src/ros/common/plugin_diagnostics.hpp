#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "ros/common/repeater.hpp"
#include "ros/common/sensor_listener.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

/// Says on /diagnostics, once a second, and on "~/NAME/status", latched and whenever it changes, how a plugin is.
///
/// What is latched has no figures that change while the state stays: nobody could tell how old they are.
///
/// Has a thread of its own: nothing is done where the plugin works, and little where nobody listens.
class PluginDiagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Report = std::function<void(Status&)>;

  /// `mutex` is held while a report is made. `state`: the report that is latched, too. `figures`: what /diagnostics has
  /// of the same moment in addition. Construct, call and destroy this without holding the mutex: diagnostic_updater has
  /// a lock of its own, which is taken before it.
  PluginDiagnostics(const std::string& name, std::mutex* mutex, const Report& state, const Report& figures);

  /// One more for /diagnostics. Before start().
  void add(const std::string& what, const Report& report);
  /// "scan" and "odometry", empty where `sensors` gives none.
  void addSensors(const std::function<SensorListener*()>& sensors);
  void start();

 private:
  Report locked(const Report& report);
  /// For one that goes by ROS's clock: says so where that stands still, since nothing grows old then, and nobody asks.
  Report byTheClock(const Report& report);
  void tell();

  std::string name_;
  std::mutex& mutex_;
  Report state_;
  ros::Publisher diagnostics_publisher_;  ///< tells whether somebody listens
  ros::Publisher status_publisher_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTime updated_;
  StandingClock clock_;
  bool clock_stands_ = false;
  diagnostic_msgs::DiagnosticStatus published_;  ///< last
  std::optional<Repeater> repeater_;             ///< last: it uses what is above
};

}  // namespace lstm_planner
