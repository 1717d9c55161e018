#include <algorithm>
#include <cmath>

#include "fuzz/fuzz_scan.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/small_memory.hpp"
#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"

namespace lstm_planner::fuzz::recorder_harness {
namespace {

constexpr int kMostEvents = 200;
constexpr std::uint8_t kBurst = 255;  // a driver's stamps stand still; once an input, as it takes long

/// Counts, and checks what a recorder promises of its steps.
class CheckingSink : public StepSink {
 public:
  void startEpisode(const Episode&) override {
    require(!in_episode_, "an episode ends before the next starts");
    in_episode_ = true;
  }
  void addStep(const DriveStep& step) override {
    require(in_episode_, "steps belong to an episode");
    require(isFinite(step.pose) && isFinite(step.next_pose), "poses are finite");
    require(std::isfinite(step.observation.goal_distance) && std::isfinite(step.observation.goal_bearing) &&
                std::isfinite(step.observation.heading) && std::isfinite(step.observation.route_bearing) &&
                std::isfinite(step.observation.route_length) && std::isfinite(step.driven_angle),
            "what the network is told is finite");
    require(step.label >= 0 && step.label < 5, "the label is an allowed angle");
    require(step.next_stamp > step.stamp, "steps have a duration");
    ++steps_;
  }
  void endEpisode(double, EpisodeEnd) override {
    require(in_episode_, "what ends has started");
    in_episode_ = false;
  }
  void reject(Rejection) override { ++rejections_; }

  int steps() const { return steps_; }
  bool inEpisode() const { return in_episode_; }

 private:
  bool in_episode_ = false;
  int steps_ = 0;
  int rejections_ = 0;
};

/// Holds events back as the recorder does, with the same parameters, and counts how many wait.
class CountedOrder {
 public:
  explicit CountedOrder(const RecorderParameters& parameters) : order_(parameters.delay, parameters.max_gap) {}

  void add(const DriveEvent& event) {
    const EventOrder::Verdict verdict = order_.add(event);
    if (verdict == EventOrder::Verdict::kClockSet) {
      order_.clear();
      waiting_ = 0;
    }
    waiting_ += verdict == EventOrder::Verdict::kTaken ? 1 : 0;
    while (order_.take()) --waiting_;
    require(waiting_ <= EventOrder::kMostWaiting, "few events wait, whatever their stamps");
  }

 private:
  EventOrder order_;
  std::size_t waiting_ = 0;
};

RecorderParameters smallWorld() {
  RecorderParameters parameters;
  parameters.agent.memory = smallMemory();
  return parameters;
}

/// Time goes on by up to a quarter of a second, or jumps.
double nextStamp(FuzzInput* input, double stamp) {
  const std::uint8_t code = input->byte();
  return code < 224 ? stamp + static_cast<double>(code) / 1024.0 : input->number();
}

DriveEvent anyEvent(FuzzInput* input, double stamp, Pose2* pose) {
  switch (input->byte() % 8) {
    case 0:
      return GoalHeard{stamp, {input->flag() ? "odom" : "map", anyPose(input)}, "fuzz"};
    case 1:
      return input->flag() ? DriveEvent(GoalGivenUp{stamp}) : DriveEvent(OdometryHeard{stamp, anyPose(input), {}});
    case 2:
    case 3:
    case 4: {
      ScanHeard heard{stamp, anyScan(input), anyMount(input), "laser"};
      heard.scan.stamp = stamp;
      return heard;
    }
    default:
      pose->x += input->numberIn(-0.1, 0.1);
      pose->yaw += input->numberIn(-0.5, 0.5);
      return OdometryHeard{stamp, *pose, {input->numberIn(-1.0, 1.0), input->numberIn(-1.0, 1.0)}};
  }
}

/// Any odometry, scans and goals, with any stamps.
void record(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  static const RecorderParameters parameters = smallWorld();
  const bool map_is_known = input.flag();
  CheckingSink sink;
  DriveRecorder recorder(parameters, &sink, [&](const std::string& frame, double) -> std::optional<Pose2> {
    if (frame == "odom" || map_is_known) return Pose2{};
    return std::nullopt;
  });
  CountedOrder order(parameters);
  double stamp = 1000.0;
  Pose2 pose;
  int events = 0;
  bool had_burst = false;
  for (; events < kMostEvents && !input.empty(); ++events) {
    stamp = nextStamp(&input, stamp);
    const DriveEvent event = anyEvent(&input, stamp, &pose);
    if (flawOf(event).empty()) order.add(event);
    recorder.add(event);
    if (!std::isfinite(stamp)) stamp = 1000.0;
    if (input.byte() == kBurst && !had_burst) {
      had_burst = true;
      for (std::size_t i = 0; i <= EventOrder::kMostWaiting; ++i) order.add(OdometryHeard{stamp, pose, {}});
    }
  }
  recorder.finish();
  require(!sink.inEpisode(), "the last episode ends");
  require(sink.steps() <= events, "a step is made of a scan");
}

const Registration registration("recorder", &record);

}  // namespace
}  // namespace lstm_planner::fuzz::recorder_harness
