#include "ros/common/plugin_diagnostics.hpp"

#include <ros/console.h>

#include <chrono>
#include <exception>

#include "ros/common/timing.hpp"

namespace lstm_planner {
namespace {

constexpr std::chrono::milliseconds kStatusPeriod(200);
const ros::WallDuration kDiagnosticsPeriod(1.0);

/// How often and how old.
void describe(const SensorHealth& sensor, diagnostic_updater::DiagnosticStatusWrapper* status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!sensor.is_heard) {
    status->summary(DiagnosticStatus::ERROR, "nothing has been received on " + sensor.topic);
    return;
  }
  if (sensor.problem.empty() && sensor.contradicts_itself) {
    status->summary(DiagnosticStatus::WARN, "messages come in time; their twist contradicts their poses, which count");
  } else if (sensor.problem.empty()) {
    status->summary(DiagnosticStatus::OK, "messages come in time");
  } else {
    status->summary(DiagnosticStatus::ERROR, sensor.problem);
  }
  status->add("topic", sensor.topic);
  status->add("age (s)", sensor.age);
  status->add("rate (Hz)", sensor.period > 0.0 ? 1.0 / sensor.period : 0.0);
  status->add("oldest that is used (s)", sensor.timeout);
}

}  // namespace

PluginDiagnostics::PluginDiagnostics(const std::string& name, std::mutex* mutex, const Report& state,
                                     const Report& figures)
    : name_(name),
      mutex_(*mutex),
      state_(byTheClock(locked(state))),
      diagnostics_publisher_(ros::NodeHandle().advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)),
      status_publisher_(ros::NodeHandle("~/" + name).advertise<diagnostic_msgs::DiagnosticStatus>("status", 1, true)) {
  updater_.setHardwareID("none");
  updater_.add(name_, byTheClock(locked([state, figures](Status& status) {
                 state(status);
                 figures(status);
               })));
}

void PluginDiagnostics::start() {
  repeater_.emplace(kStatusPeriod, [this] {
    try {
      if (ros::ok()) tell();
    } catch (const std::exception& error) {
      ROS_ERROR_THROTTLE(kLogPeriod, "no diagnostics of %s: %s", name_.c_str(), error.what());
    }
  });
}

void PluginDiagnostics::add(const std::string& what, const Report& report) {
  updater_.add(name_ + " " + what, locked(report));
}

void PluginDiagnostics::addSensors(const std::function<SensorListener*()>& sensors) {
  add("scan", byTheClock([sensors](Status& status) {
        if (sensors() != nullptr) describe(sensors()->scanHealth(ros::Time::now()), &status);
      }));
  if (sensors() != nullptr && sensors()->hasSecondScanner()) {
    add("second scan",
        byTheClock([sensors](Status& status) { describe(sensors()->secondScanHealth(ros::Time::now()), &status); }));
  }
  add("odometry", byTheClock([sensors](Status& status) {
        if (sensors() != nullptr) describe(sensors()->odometryHealth(ros::Time::now()), &status);
      }));
}

PluginDiagnostics::Report PluginDiagnostics::locked(const Report& report) {
  return [this, report](Status& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    report(status);
  };
}

PluginDiagnostics::Report PluginDiagnostics::byTheClock(const Report& report) {
  return [this, report](Status& status) {
    report(status);
    if (clock_stands_ && status.level < diagnostic_msgs::DiagnosticStatus::ERROR) {
      status.summary(diagnostic_msgs::DiagnosticStatus::WARN, StandingClock::kText);
    }
  };
}

void PluginDiagnostics::tell() {
  clock_stands_ = clock_.stands();
  Status state;
  state.name = name_;
  state_(state);
  if (state != published_) {
    published_ = state;
    status_publisher_.publish(published_);
  }
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (diagnostics_publisher_.getNumSubscribers() == 0 || now - updated_ < kDiagnosticsPeriod) return;
  updated_ = now;
  updater_.force_update();
}

}  // namespace lstm_planner
