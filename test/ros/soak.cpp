// A long time with the plugins and the recorder in one process: the simulated robot drives to random goals in one world
// after the other, its sensors, transforms and clock fail now and then, and nothing grows. Time is simulated and in
// lock step, so a day takes minutes. test/soak.sh runs a whole day.

#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/common/quantile.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/dataset_writer.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/ros/recorder/drive_messages.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "ros/fixtures/fake_robot.hpp"
#include "ros/fixtures/faulty_robot.hpp"
#include "ros/fixtures/plugin_host.hpp"
#include "ros/fixtures/process_figures.hpp"
#include "ros/fixtures/recorder_process.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::soak {
namespace {

/// What was measured in one part of the time, or at its end.
struct Sample {
  double memory = 0.0;  ///< MB
  int threads = 0;
  int descriptors = 0;
  double median = 0.0;  ///< s of processor time a plan
  double p99 = 0.0;     ///< s
  long goals = 0;
  long reached = 0;
  long faults = 0;
  long blind_contacts = 0;  ///< that started while there was no scan that could be used
  long contacts = 0;        ///< all
  long steps = 0;           ///< recorded
};

/// A recorder in lock step, with a file of its own.
class RecordedDrive {
 public:
  RecordedDrive(const RecorderParameters& parameters, const tf2::BufferCore& tf, const std::string& file)
      : file_(file),
        writer_(file, describe(parameters)),
        messages_(tf, "base_footprint", std::nullopt, parameters, &writer_) {
    node_.setCallbackQueue(&queue_);
    subscribers_ = {node_.subscribe("scan", 100, &RecordedDrive::onScan, this),
                    node_.subscribe("odom", 100, &RecordedDrive::onOdometry, this),
                    node_.subscribe("move_base/goal", 100, &RecordedDrive::onGoal, this),
                    node_.subscribe("move_base/result", 100, &RecordedDrive::onResult, this)};
  }

  /// Works on what has come.
  void hear() { queue_.callAvailable(); }

  /// Writes everything, and looks for faults in it. Returns the number of steps.
  long finish() {
    messages_.recorder().finish();
    writer_.finish();
    for (const std::string& fault : checkDatasetFile(file_)) ADD_FAILURE() << file_ << ": " << fault;
    std::filesystem::remove(file_);
    return writer_.stored();
  }

 private:
  static RecordingDescription describe(const RecorderParameters& parameters) {
    return {parameters, softwareVersion(), "live", "odom", "2000-01-01T00:00:00Z"};
  }
  void onScan(const sensor_msgs::LaserScan::ConstPtr& scan) { messages_.hear(*scan, ros::Time::now()); }
  void onOdometry(const nav_msgs::Odometry::ConstPtr& odometry) { messages_.hear(*odometry, ros::Time::now()); }
  void onGoal(const move_base_msgs::MoveBaseActionGoal::ConstPtr& goal) {
    messages_.hear(*goal, "move_base/goal", ros::Time::now());
  }
  void onResult(const move_base_msgs::MoveBaseActionResult::ConstPtr& result) {
    messages_.hear(*result, ros::Time::now());
  }

  std::string file_;
  DatasetWriter writer_;
  DriveMessages messages_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
};

class Soak : public testing::Test {
 protected:
  static constexpr double kGoalPatience = 300.0;  // s

  /// A part of the time: each kind of world once, so that parts can be compared.
  Sample drivePart(double seconds) {
    sample_ = {};
    for (const WorldKind kind : worldKinds()) driveIn(kind, seconds / static_cast<double>(worldKinds().size()));
    const std::vector<double> plan_times = host_->takePlanTimes();
    sample_.median = quantile(plan_times, 0.5);
    sample_.p99 = quantile(plan_times, 0.99);
    sample_.memory = residentMemory();
    sample_.threads = countThreads();
    sample_.descriptors = countDescriptors();
    return sample_;
  }

  void driveIn(WorldKind kind, double seconds) {
    const std::uint64_t seed = worldSeed(WorldUse::kJudging, seed_, world_number_++);
    const GridWorld world(generateWorld(kind, seed));
    const ShieldParameters shield;
    const std::vector<DriveTask> tasks =
        drawTasks(world, kPlaces, shield.footprint_radius, shield.clearance, 1.0, seed);
    robot_.enter(world, tasks[0].start, seed);
    if (!host_) host_ = std::make_unique<PluginHost>([this] { robot_.step({}); });
    recording_ = std::make_unique<RecordedDrive>(recorder_parameters_, host_->tf(),
                                                 folder_ / (std::to_string(seed) + ".sqlite"));
    const long faults = robot_.faults();
    giveGoal(world, tasks);
    const std::string where = std::string(toString(kind)) + ", seed " + std::to_string(seed);
    for (long period = 0; static_cast<double>(period) * FaultyRobot::kPeriod < seconds; ++period) {
      if (!step(where)) giveGoal(world, tasks);
    }
    endGoal(actionlib_msgs::GoalStatus::PREEMPTED);
    sample_.faults += robot_.faults() - faults;
    sample_.steps += recording_->finish();
    recording_.reset();
  }

  /// Mostly a place that can be reached, sometimes one that may be in a wall.
  void giveGoal(const GridWorld& world, const std::vector<DriveTask>& tasks) {
    constexpr double kAnywhere = 0.1;
    const OccupancyGrid& grid = world.grid();
    Point2 place = tasks[uniformIndex(random_, tasks.size())].goal;
    if (uniform(random_) < kAnywhere) {
      place = grid.centerOf({static_cast<int>(uniformIndex(random_, static_cast<std::size_t>(grid.columns()))),
                             static_cast<int>(uniformIndex(random_, static_cast<std::size_t>(grid.rows())))});
    }
    const geometry_msgs::PoseStamped goal = toMessage({place.x, place.y, 0.0}, "map", ros::Time::now());
    const auto action = boost::make_shared<move_base_msgs::MoveBaseActionGoal>();
    action->header.stamp = ros::Time::now();
    action->goal_id.id = std::to_string(++goal_number_);
    action->goal_id.stamp = ros::Time::now();
    action->goal.target_pose = goal;
    action_goals_.publish(action);
    host_->drive(goal);
    goal_periods_ = 0;
    ++sample_.goals;
  }

  void endGoal(int status) {
    const auto result = boost::make_shared<move_base_msgs::MoveBaseActionResult>();
    result->header.stamp = ros::Time::now();
    result->status.status = static_cast<decltype(result->status.status)>(status);
    result->status.goal_id.id = std::to_string(goal_number_);
    results_.publish(result);
  }

  /// False when the goal is over.
  bool step(const std::string& where) {
    using State = PluginHost::State;
    Twist2 command;
    const State state = host_->step(&command);
    maybeAskAQuestion();
    const bool was_blind = robot_.isBlind();
    const int contacts = robot_.robot().contacts();
    robot_.step(command);
    recording_->hear();
    if (robot_.robot().contacts() > contacts) noteContact(was_blind, where);
    const bool too_long = static_cast<double>(++goal_periods_) * FaultyRobot::kPeriod > kGoalPatience;
    if (state == State::kDriving && !too_long) return true;
    sample_.reached += state == State::kReached ? 1 : 0;
    endGoal(state == State::kReached ? actionlib_msgs::GoalStatus::SUCCEEDED : actionlib_msgs::GoalStatus::ABORTED);
    return false;
  }

  /// As move_base's make_plan: about some other place, now and then.
  void maybeAskAQuestion() {
    constexpr double kMeanPause = 60.0;  // s
    if (uniform(random_) >= FaultyRobot::kPeriod / kMeanPause) return;
    host_->makePlan(toMessage({uniform(random_, -20.0, 20.0), uniform(random_, -20.0, 20.0), 0.0}, "map"));
  }

  void noteContact(bool blind, const std::string& where) {
    ++sample_.contacts;
    sample_.blind_contacts += blind ? 1 : 0;
    const Pose2& pose = robot_.robot().truePose();
    std::printf("| contact at (%.2f, %.2f) in %s, goal %ld, %.2f s after entering, with %s\n", pose.x, pose.y,
                where.c_str(), goal_number_, robot_.robot().time(), toString(robot_.fault()));
  }

 private:
  static constexpr int kPlaces = 12;  // in each world

  const std::uint64_t seed_ = static_cast<std::uint64_t>(ros::param::param("~seed", 1));
  Random random_{seed_};
  const RecorderParameters recorder_parameters_ =
      loadRecorderNodeParameters(ros::NodeHandle("~/DatasetRecorder")).recorder;
  test::ScratchFolder folder_;
  FaultyRobot robot_{seed_ + 1};
  std::unique_ptr<PluginHost> host_;
  std::unique_ptr<RecordedDrive> recording_;
  ros::NodeHandle node_;
  ros::Publisher action_goals_ = node_.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 10);
  ros::Publisher results_ = node_.advertise<move_base_msgs::MoveBaseActionResult>("move_base/result", 10);
  Sample sample_;
  std::uint64_t world_number_ = 0;
  long goal_number_ = 0;
  long goal_periods_ = 0;
};

using Value = std::function<double(const Sample&)>;

/// The median in that quarter of the time, 0 to 3: one part in some fifty has a world in which plans take far longer.
double medianOf(const std::vector<Sample>& samples, std::size_t quarter, const Value& value) {
  std::vector<double> values;
  for (std::size_t i = quarter * samples.size() / 4; i < (quarter + 1) * samples.size() / 4; ++i) {
    values.push_back(value(samples[i]));
  }
  return quantile(values, 0.5);
}

/// The first quarter is left out: until then not everything has been used once.
void expectFlat(const std::vector<Sample>& samples, const char* what, const Value& value, double share, double margin) {
  const double before = medianOf(samples, 1, value);
  const double after = medianOf(samples, 3, value);
  EXPECT_LE(after, (1.0 + share) * before + margin)
      << what << " grew from " << before << " in the second quarter of the time to " << after << " in the last";
}

void printHeader() {
  std::printf(
      "| until | goals | reached | faults | steps | contacts | blind | memory | threads | descriptors | plan, "
      "median | 99 %% |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print(double hours, const Sample& s) {
  std::printf("| %.2f h | %ld | %ld | %ld | %ld | %ld | %ld | %.1f MB | %d | %d | %.0f us | %.0f us |\n", hours,
              s.goals, s.reached, s.faults, s.steps, s.contacts, s.blind_contacts, s.memory, s.threads, s.descriptors,
              1e6 * s.median, 1e6 * s.p99);
  std::fflush(stdout);
}

TEST_F(Soak, NothingGrowsNothingIsTouchedAndEveryDatasetIsSound) {
  const double hours = ros::param::param("~hours", 1.0 / 6.0);
  const int parts = std::max(4, static_cast<int>(std::lround(hours)));
  std::vector<Sample> samples;
  Sample sum;
  printHeader();
  for (int part = 1; part <= parts; ++part) {
    samples.push_back(drivePart(3600.0 * hours / parts));
    print(hours * part / parts, samples.back());
    sum.goals += samples.back().goals;
    sum.reached += samples.back().reached;
    sum.steps += samples.back().steps;
    sum.contacts += samples.back().contacts;
    sum.blind_contacts += samples.back().blind_contacts;
  }
  EXPECT_EQ(sum.blind_contacts, 0) << "contacts while no scan could be used";
  EXPECT_EQ(sum.contacts, 0) << "contacts, where nothing moves but the robot";
  EXPECT_GT(sum.steps, 0) << "steps recorded";
  // Some goals lie in walls, and each stay in a world ends before the last goal's end: that is all for short stays.
  if (hours >= 1.0) {
    EXPECT_GT(2 * sum.reached, sum.goals) << "goals reached";
  }
  // What is remembered of a drive differs by some 2 MB. In half a day, 4 MB is five bytes a scan.
  expectFlat(
      samples, "memory (MB)", [](const Sample& sample) { return sample.memory; }, 0.0, 4.0);
  expectFlat(
      samples, "the number of threads", [](const Sample& sample) { return sample.threads; }, 0.0, 0.0);
  expectFlat(
      samples, "the number of descriptors", [](const Sample& sample) { return sample.descriptors; }, 0.0, 0.0);
  // Worlds differ: hour by hour the 99th percentile scatters by a third of itself, medians of six hours by a sixth.
  // Twice as much after half a day does not come from that; medians of fewer parts scatter more.
  const double scatter = std::sqrt(24.0 / parts);
  expectFlat(
      samples, "a plan's median time (s)", [](const Sample& sample) { return sample.median; }, scatter, 0.0);
  expectFlat(
      samples, "a plan's 99th percentile (s)", [](const Sample& sample) { return sample.p99; }, scatter, 0.0);
}

const RosProgram program("soak", &runTests);

}  // namespace
}  // namespace lstm_planner::soak
