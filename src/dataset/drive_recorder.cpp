#include "lstm_planner/dataset/drive_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/perception/deskew.hpp"
#include "lstm_planner/drive/perception/odometry_jump.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

constexpr double kLongestInterpolation = 0.5;   // s between the two odometry messages around a scan
constexpr double kClockSet = 1.0;               // s that a robot may drive until a clock that was set back goes on
constexpr std::size_t kMostWaitingScans = 200;  // five seconds at 40 Hz

ScanGeometry geometryOf(const ScanHeard& heard) {
  const LaserScan& scan = heard.scan;
  return {heard.frame,    scan.angle_min, scan.angle_increment, static_cast<int>(scan.ranges.size()),
          scan.range_min, scan.range_max, heard.mount};
}

}  // namespace

DriveRecorder::DriveRecorder(const RecorderParameters& parameters, StepSink* sink, FrameLookup lookup)
    : parameters_((validate(parameters), parameters)),
      actions_(parameters.action_angles),
      sink_(sink),
      lookup_(std::move(lookup)),
      order_(parameters.delay, parameters.max_gap),
      history_(parameters.max_speed),
      observer_(parameters.agent) {}

void DriveRecorder::add(DriveEvent event) {
  if (const std::string flaw = flawOf(event); !flaw.empty()) {
    reject(Rejection::kNotFinite, flaw);
    return;
  }
  const bool is_sensed = std::holds_alternative<OdometryHeard>(event) || std::holds_alternative<ScanHeard>(event);
  const auto restamp = [&event](double stamp) { std::visit([stamp](auto& heard) { heard.stamp = stamp; }, event); };
  // A goal is often given on another computer, whose clock must not be taken for a jump of the robot's.
  if (!is_sensed && std::abs(stampOf(event) - newest_) > parameters_.max_gap) restamp(newest_);
  EventOrder::Verdict verdict = order_.add(event);
  if (!is_sensed && verdict == EventOrder::Verdict::kLate) {
    // Not even a goal that is long on its way may be lost: the robot drives to it.
    restamp(now_);
    verdict = order_.add(event);
  }
  const double stamp = stampOf(event);
  if (verdict == EventOrder::Verdict::kClockSet) {
    workOnWhatIsDue(true);
    endEpisode(EpisodeEnd::kTimeJump);
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      reject(Rejection::kNoOdometry, "the stamps jump from " + fixedText(newest_, 3) + " s to " + fixedText(stamp, 3) +
                                         " s: scanner and odometry have different clocks, the clock was set, or "
                                         "nothing was heard in between");
    }
    waiting_.clear();
    last_sample_.reset();
    last_unusable_.reset();
    order_.clear();
    newest_ = stamp;
    verdict = order_.add(std::move(event));
  }
  if (verdict == EventOrder::Verdict::kLate) {
    reject(Rejection::kLate,
           "a message comes " + fixedText(newest_ - stamp, 3) +
               " s after others with later stamps, expected at most delay = " + numberText(parameters_.delay) + " s");
  }
  newest_ = std::max(newest_, stamp);
  workOnWhatIsDue(false);
}

void DriveRecorder::reject(Rejection rejection, const std::string& why) {
  sink_->reject(rejection);
  sink_->explain(rejection, why);
}

void DriveRecorder::workOnWhatIsDue(bool all) {
  while (const std::optional<DriveEvent> event = order_.take(all)) {
    now_ = stampOf(*event);
    std::visit([this](const auto& heard) { work(heard); }, *event);
  }
}

void DriveRecorder::finish() {
  workOnWhatIsDue(true);
  endEpisode(EpisodeEnd::kFinished);
}

void DriveRecorder::setPaused(bool paused) {
  if (paused && !paused_) endEpisode(EpisodeEnd::kPaused);
  paused_ = paused;
}

void DriveRecorder::endEpisode(EpisodeEnd end) {
  if (step_) sink_->reject(Rejection::kNoNextStep);
  step_.reset();
  if (in_episode_) sink_->endEpisode(now_, end);
  in_episode_ = false;
  const bool is_done = end == EpisodeEnd::kArrived || end == EpisodeEnd::kAborted;
  // Its coordinates are another place from then on, but who drives goes to the one that was meant.
  const bool is_elsewhere = end == EpisodeEnd::kOdometryJump && !is_goal_newest_ && isGoalInOdometry();
  if (is_done || is_elsewhere) goal_.reset();
}

bool DriveRecorder::isGoalInOdometry() const {
  const std::optional<Pose2> frame = goal_ ? lookup_(goal_->frame, now_) : std::nullopt;
  return frame && frame->x == 0.0 && frame->y == 0.0 && frame->yaw == 0.0;
}

void DriveRecorder::work(const OdometryHeard& odometry) {
  const double before = history_.empty() ? odometry.stamp : history_.newest().stamp;
  const double elapsed = odometry.stamp - before;
  const double driven = elapsed < 0.0 ? kClockSet : elapsed;
  const bool is_elsewhere =
      !history_.empty() && isOdometryJump(history_.newest().pose, odometry.pose, driven, parameters_.max_speed);
  const long jumps = history_.jumps();
  history_.add(odometry);
  const bool has_jumped = history_.jumps() != jumps;
  if (has_jumped) {
    // Stamps that go back count as a jump, too: then the clock was set, and the odometry may go on.
    endEpisode(is_elsewhere ? EpisodeEnd::kOdometryJump : EpisodeEnd::kTimeJump);
    observer_.forget();
    silence_.noteJump(odometry.stamp, odometry.pose);
  } else if (elapsed > parameters_.max_gap) {
    endEpisode(EpisodeEnd::kTimeJump);
  }

  std::vector<ScanHeard> scans;
  scans.swap(waiting_);
  for (const ScanHeard& scan : scans) {
    if (elapsed > kLongestInterpolation) {
      reject(Rejection::kNoOdometry, "from one odometry message to the next it takes " + fixedText(elapsed, 3) +
                                         " s, expected at most " + numberText(kLongestInterpolation) + " s");
    } else if (has_jumped) {
      reject(Rejection::kNoOdometry, "the odometry jumps from one message to the next, and the scan lies between them");
    } else if (scan.stamp < before) {
      reject(Rejection::kNoOdometry, "the scan is older than the first odometry");
    } else {
      sample(scan);
    }
  }
  if (in_episode_ && isAt(goal_position_, odometry.pose)) endEpisode(EpisodeEnd::kArrived);
  is_goal_newest_ = false;
}

void DriveRecorder::work(const GoalHeard& goal) {
  is_goal_newest_ = true;
  if (goal_ && sameGoal(*goal_, goal.goal)) return;
  endEpisode(EpisodeEnd::kNewGoal);
  goal_ = goal.goal;
  goal_source_ = goal.source;
}

void DriveRecorder::work(const GoalGivenUp&) { endEpisode(EpisodeEnd::kAborted); }

void DriveRecorder::work(const ScanHeard& scan) {
  silence_.show(scan.scan, parameters_.scan_rules, scan.stamp, history_.empty() ? Pose2() : history_.newest().pose);
  if (!history_.empty() && history_.newest().stamp == scan.stamp) {
    sample(scan);
  } else if (waiting_.size() < kMostWaitingScans) {
    waiting_.push_back(scan);
  } else {
    reject(Rejection::kNoOdometry,
           std::to_string(kMostWaitingScans) + " scans already wait for the next odometry message");
  }
}

void DriveRecorder::sample(ScanHeard scan) {
  // Counted from the clock's zero rather than from the first scan, so that a bag that starts earlier gives the same.
  const double number = std::floor(scan.stamp / parameters_.period);
  if (last_sample_ && number <= *last_sample_) {
    last_seen_ = scan.stamp;
    return;
  }
  if (const std::string flaw = see(&scan); !flaw.empty()) {
    // The next scan may do; how many did not, within one sample, depends on the scanner's rate alone.
    if (last_unusable_ != number) reject(Rejection::kUnusableScan, flaw);
    last_unusable_ = number;
    return;
  }
  // Where the robot was after a long time does not say where it went from the step before.
  if (last_sample_ && scan.stamp - last_seen_ > parameters_.max_gap) endEpisode(EpisodeEnd::kTimeJump);
  last_sample_ = number;
  last_seen_ = scan.stamp;

  if (paused_) {
    sink_->reject(Rejection::kPaused);
    return;
  }
  if (!goal_) {
    sink_->reject(Rejection::kNoGoal);
    return;
  }
  const std::optional<Pose2> frame = lookup_(goal_->frame, scan.stamp);
  if (!frame) {
    reject(Rejection::kNoTransform,
           "no transform leads from the goal's frame '" + goal_->frame + "' to that of the odometry");
    return;
  }
  goal_position_ = toParentFrame(*frame, {goal_->pose.x, goal_->pose.y});
  try {
    checkGoal(situation_->pose, goal_position_);
  } catch (const std::invalid_argument& error) {
    return reject(Rejection::kNotFinite, error.what());
  }
  if (isAt(goal_position_, situation_->pose)) {
    endEpisode(EpisodeEnd::kArrived);
  } else if (!in_episode_) {
    startEpisode();
    startStep(scan);
  } else if (isStep(step_->pose, situation_->pose, parameters_)) {
    labelStep();
    startStep(scan);
  } else {
    sink_->reject(Rejection::kStanding);
  }
}

std::string DriveRecorder::see(ScanHeard* scan) {
  if (!situation_) situation_.emplace();
  if (silence_.isCovered()) return "the scanner counts as covered: the returns of all beams went at once";
  const auto poseAt = [this](double time) { return history_.poseAt(time); };
  deskew(scan->mount, parameters_.scan_rules, poseAt, &scan->scan);
  try {
    perceive(scan->scan, scan->mount, parameters_.scan_rules, parameters_.range_cap, &*situation_);
  } catch (const UnusableScan& error) {
    return error.what();
  }
  situation_->time = scan->stamp;
  situation_->pose = history_.poseAt(scan->stamp);
  return "";
}

bool DriveRecorder::isAt(const Point2& goal, const Pose2& pose) const {
  return distanceBetween(goal, pose) <= parameters_.goal_tolerance;
}

void DriveRecorder::startEpisode() {
  in_episode_ = true;
  number_ = 0;
  previous_action_ = 0.0;
  observer_.start(goal_position_);
  Episode episode;
  episode.goal = *goal_;
  episode.goal_source = goal_source_;
  episode.begun = situation_->time;
  sink_->startEpisode(episode);
}

void DriveRecorder::startStep(const ScanHeard& scan) {
  DriveStep step;
  step.number = number_++;
  step.stamp = scan.stamp;
  step.pose = situation_->pose;
  step.twist = history_.twist();
  step.goal = goal_position_;
  step.observation = observer_.observe(*situation_, goal_position_, previous_action_);
  step.minimum_ranges = situation_->sectors.nearest;
  step.beams = situation_->sectors.beams;
  step.measured = situation_->sectors.measured;
  step.geometry = geometryOf(scan);
  if (parameters_.keep_scans) step.ranges = scan.scan.ranges;
  step_ = std::move(step);
  sink_->startStep(*step_);
}

void DriveRecorder::labelStep() {
  step_->next_stamp = situation_->time;
  step_->next_pose = situation_->pose;
  step_->driven_angle = drivenAngle(step_->pose, step_->next_pose, parameters_.min_step_distance);
  step_->label = actions_.nearest(step_->driven_angle);
  previous_action_ = actions_.angle(step_->label);
  const double error = std::abs(normalizeAngle(step_->driven_angle - previous_action_));
  if (error <= parameters_.max_label_error) {
    sink_->addStep(*step_);
  } else {
    sink_->reject(Rejection::kNoAllowedAngle);
  }
  step_.reset();
}

}  // namespace lstm_planner
