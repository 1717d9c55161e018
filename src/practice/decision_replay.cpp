#include "lstm_planner/practice/decision_replay.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/training/confusion.hpp"

namespace lstm_planner {

namespace {

std::string joined(const std::map<std::string, long>& counts, bool name_first) {
  std::string text;
  for (const auto& [name, count] : counts) {
    const std::string number = std::to_string(count);
    text += (text.empty() ? "" : ", ") + (name_first ? name + " " + number : number + " " + name);
  }
  return text;
}

bool isJump(EpisodeEnd end) { return end == EpisodeEnd::kTimeJump || end == EpisodeEnd::kOdometryJump; }

}  // namespace

DecisionReplay::DecisionReplay(DrivePolicy policy, const AgentParameters& parameters, const ScanRules& rules)
    : rules_((validate(rules), rules)), agent_(std::move(policy), parameters) {}

void DecisionReplay::startEpisode(const Episode& episode) {
  const bool goes_on = episode_ && isJump(episode_->end) && sameGoal(episode_->goal, episode.goal);
  is_new_goal_ = is_new_goal_ || !goes_on;
  episode_ = episode;
  ++episodes_;
}

void DecisionReplay::advise(const DriveStep& step) { advice_ = decideAbout(step); }

void DecisionReplay::addStep(const DriveStep& step) {
  ReplayedDecision replayed = advice_ && advice_->stamp == step.stamp ? std::move(*advice_) : decideAbout(step);
  advice_.reset();
  replayed.next_pose = step.next_pose;
  replayed.driven_angle = step.driven_angle;
  replayed.driven_action = description().actions.nearest(step.driven_angle);
  decisions_.push_back(std::move(replayed));
}

ReplayedDecision DecisionReplay::decideAbout(const DriveStep& step) {
  if (step.ranges.empty()) {
    throw std::invalid_argument("the step at " + fixedText(step.stamp, 3) +
                                " s has no scan, without which nothing can be decided");
  }
  if (newest_ && step.stamp < *newest_) noteJump();  // of the clock; OdometryHistory counts them, too
  newest_ = step.stamp;
  perceive(scanOf(step.geometry, step.ranges), step.geometry.mount, rules_, description().encoder.range_cap,
           &situation_);
  situation_.pose = step.pose;
  situation_.time = step.stamp;
  if (agent_.parameters().correct_drift) drift_.correct(&situation_);
  agent_.perceive(situation_);
  goal_changes_.tell(&agent_, {step.goal.x, step.goal.y, 0.0}, drift_.correction(), is_new_goal_, jumps_);
  agent_.decide();
  is_new_goal_ = false;

  ReplayedDecision replayed;
  replayed.episode = episodes_ - 1;
  replayed.stamp = step.stamp;
  replayed.pose = step.pose;
  replayed.goal = {step.goal.x, step.goal.y, episode_ ? episode_->goal.pose.yaw : 0.0};
  replayed.sectors = agent_.situation().sectors;
  replayed.decision = inParentFrame(inverse(drift_.correction()), agent_.decision());
  replayed.steering_angle = normalizeAngle(replayed.decision.direction - step.pose.yaw);
  replayed.action = description().actions.nearest(replayed.steering_angle);
  return replayed;
}

void DecisionReplay::endEpisode(double, EpisodeEnd end) {
  if (episode_) {
    episode_->end = end;
  }
  if (end == EpisodeEnd::kOdometryJump) noteJump();
}

void DecisionReplay::noteJump() {
  ++jumps_;
  drift_.restart();
}

RecorderParameters replayParameters(const PolicyDescription& description, const AgentParameters& agent,
                                    const ScanRules& rules) {
  RecorderParameters parameters;
  parameters.range_cap = description.encoder.range_cap;
  parameters.keep_scans = true;
  parameters.action_angles = description.actions.angles();
  parameters.agent = agent;
  parameters.scan_rules = rules;
  return parameters;
}

Agreement agreementOf(const std::vector<ReplayedDecision>& decisions) {
  Agreement agreement;
  int actions = 0;
  for (const ReplayedDecision& replayed : decisions) {
    actions = std::max({actions, replayed.action + 1, replayed.driven_action + 1});
  }
  ConfusionMatrix taken = ConfusionMatrix::Zero(actions, actions);
  for (const ReplayedDecision& replayed : decisions) {
    ++agreement.decisions;
    ++taken(replayed.driven_action, replayed.action);
    agreement.same_action += replayed.action == replayed.driven_action;
    agreement.asked += replayed.decision.preferred >= 0;
    agreement.preferred += replayed.decision.preferred >= 0 && replayed.decision.preferred == replayed.driven_action;
    agreement.mean_difference += std::abs(normalizeAngle(replayed.steering_angle - replayed.driven_angle));
  }
  if (agreement.decisions > 0) {
    agreement.mean_difference /= static_cast<double>(agreement.decisions);
    agreement.balanced = balancedAccuracy(taken);
    agreement.majority = accuracyOf(constantAnswer(taken));
    agreement.majority_balanced = balancedAccuracy(constantAnswer(taken));
  }
  return agreement;
}

std::string describeReplay(const DecisionReplay& replay) {
  std::map<std::string, long> sources;
  for (const ReplayedDecision& replayed : replay.decisions()) {
    ++sources[toString(replayed.decision.choice)];
  }
  std::map<std::string, long> rejections;
  for (int i = 0; i < kRejectionCount; ++i) {
    const long count = replay.rejections()[static_cast<std::size_t>(i)];
    if (count > 0) rejections[toString(static_cast<Rejection>(i))] = count;
  }
  const Agreement agreement = agreementOf(replay.decisions());
  const auto percent = [](double share) { return std::to_string(std::lround(100.0 * share)) + " %"; };
  std::ostringstream text;
  text << agreement.decisions << " decisions";
  if (agreement.decisions > 0) {
    const long episodes = replay.decisions().back().episode + 1;
    text << " in " << episodes << (episodes == 1 ? " episode (" : " episodes (") << joined(sources, true)
         << "): the planner took the driver's steering angle at " << agreement.same_action << " ("
         << percent(static_cast<double>(agreement.same_action) / static_cast<double>(agreement.decisions))
         << ", balanced " << percent(agreement.balanced) << "; majority-class baseline: " << percent(agreement.majority)
         << ", balanced " << percent(agreement.majority_balanced) << "), their angles differ by "
         << std::lround(agreement.mean_difference * 180.0 / M_PI) << " degrees on average";
    if (agreement.asked > 0)
      text << "; the network preferred it at " << agreement.preferred << " of " << agreement.asked;
  }
  if (!rejections.empty()) {
    text << "; not decided about: " << joined(rejections, false);
  }
  return text.str();
}

void writeDecisions(const std::vector<ReplayedDecision>& decisions, std::ostream* out) {
  constexpr int kAngleDecimals = 4;
  constexpr int kStampDecimals = 6;
  CsvWriter csv(out);
  csv.row("episode", "stamp", "source", "overruled", "action", "steering_angle", "driven_action", "driven_angle",
          "preferences");
  for (const ReplayedDecision& replayed : decisions) {
    csv.add(replayed.episode);
    csv.addFixed(replayed.stamp, kStampDecimals);
    csv.add(toString(replayed.decision.choice), toString(replayed.decision.overruled), replayed.decision.action);
    csv.addFixed(replayed.steering_angle, kAngleDecimals);
    csv.add(replayed.driven_action);
    csv.addFixed(replayed.driven_angle, kAngleDecimals);
    std::string preferences;
    for (const float preference : replayed.decision.preferences) {
      preferences += (preferences.empty() ? "" : " ") + fixedText(static_cast<double>(preference), kAngleDecimals);
    }
    csv.row(preferences);
  }
}

}  // namespace lstm_planner
