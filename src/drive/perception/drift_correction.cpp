#include "lstm_planner/drive/perception/drift_correction.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

/// The scan is matched when the robot has moved that far, m, or turned, rad.
constexpr double kMatchedEvery = 0.3;
constexpr double kMatchedEveryTurn = 0.3;

/// Beams of one sweep are taken one after the other: a scanner at 10 Hz that turns by 1 rad/s shows a world that is
/// bent by 0.1 rad. So a robot that turns faster than this (rad/s) waits with the match, for this times the distance at
/// most.
constexpr double kFastestTurn = 0.5;
constexpr double kLongestWait = 2.0;

constexpr double kSpacing = 0.08;  ///< m between the pieces that are matched
constexpr std::size_t kMostPieces = 200;
constexpr std::size_t kNearKeys = 5;  ///< that a scan is matched with
/// m, how much less a key scan is worth that looks elsewhere by 1 rad.
constexpr double kTurnAsDistance = 0.7;

/// A scan is kept when no other was taken so near, m and rad, or so little of it is known.
constexpr double kKeyDistance = 1.0;
constexpr double kKeyTurn = 0.8;
constexpr double kKnownShare = 0.6;

/// Standard deviations of the odometry: of wheels that are calibrated badly, and slip now and then.
constexpr double kPositionError = 0.005;  ///< m
constexpr double kPositionShare = 0.06;   ///< of the distance
constexpr double kYawError = 0.002;       ///< rad
constexpr double kYawShare = 0.06;        ///< of the turn
constexpr double kYawADistance = 0.04;    ///< rad/m

}  // namespace

void DriftCorrection::restart() {
  correction_ = {};
  moved_ = 0.0;
  turned_ = 0.0;
  keys_.clear();
  slip_ = {};
}

void DriftCorrection::correct(Situation* situation) {
  const Pose2 odometry = situation->pose;
  checkPose(odometry);
  const bool turns_fast = turnRate(*situation) > kFastestTurn;
  if (keys_.empty() || isDue(odometry, turns_fast)) {
    surfaces_.show(situation->profile);
    surfaces_.sample(kSpacing, kMostPieces, &pieces_);
    if (!keys_.empty()) {
      moved_ += distanceBetween(last_odometry_, odometry);
      turned_ += turnBetween(last_odometry_, odometry);
    }
    if (slip_.note(pieces_, surfaces_, odometry)) {
      correction_ = compose(correction_, slip_.takeBack());
    } else if (keys_.empty()) {
      keep(compose(correction_, odometry));
    } else {
      match(odometry, turns_fast);
    }
    last_odometry_ = odometry;
  }
  previous_ = odometry;
  previous_time_ = situation->time;
  situation->pose = compose(correction_, odometry);
}

/// rad/s since the situation before.
double DriftCorrection::turnRate(const Situation& situation) const {
  const double seconds = situation.time - previous_time_;
  return seconds > 0.0 ? turnBetween(previous_, situation.pose) / seconds : 0.0;
}

bool DriftCorrection::isDue(const Pose2& odometry, bool turns_fast) const {
  const double wait = turns_fast ? kLongestWait : 1.0;
  return distanceBetween(last_odometry_, odometry) >= wait * kMatchedEvery ||
         turnBetween(last_odometry_, odometry) >= wait * kMatchedEveryTurn;
}

void DriftCorrection::match(const Pose2& odometry, bool turns_fast) {
  const Pose2 predicted = compose(correction_, odometry);
  const PoseError error{kPositionError + kPositionShare * moved_,
                        kYawError + kYawShare * turned_ + kYawADistance * moved_};
  chooseKeys(predicted);
  const ScanMatch found = matchScan(pieces_, near_, predicted, error);
  const Pose2& pose = found.is_sure ? found.pose : predicted;
  if (found.is_sure) correction_ = compose(pose, inverse(odometry));
  // In a fast turn the stamps of scan and odometry may not fit, too: what does not match then is not to be kept.
  const bool is_new = (found.is_sure || !turns_fast) && isNew(pose, found.share);
  if (is_new) keep(pose);
  if (!found.is_sure && !is_new) return;
  moved_ = 0.0;
  turned_ = 0.0;
}

void DriftCorrection::chooseKeys(const Pose2& pose) {
  const auto farness = [&pose](const KeyScan* key) {
    return distanceBetween(key->pose, pose) + kTurnAsDistance * turnBetween(key->pose, pose);
  };
  near_.clear();
  for (const KeyScan& key : keys_) near_.push_back(&key);
  const std::size_t most = std::min(kNearKeys, near_.size());
  std::partial_sort(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(most), near_.end(),
                    [&](const KeyScan* a, const KeyScan* b) { return farness(a) < farness(b); });
  near_.resize(most);
}

bool DriftCorrection::isNew(const Pose2& pose, double share) const {
  const KeyScan& nearest = *near_.front();
  return share < kKnownShare || distanceBetween(nearest.pose, pose) > kKeyDistance ||
         turnBetween(nearest.pose, pose) > kKeyTurn;
}

/// In place of the one farthest away, where there are too many.
void DriftCorrection::keep(const Pose2& pose) {
  if (keys_.size() < kMostKeyScans) {
    keys_.push_back({pose, surfaces_});
    return;
  }
  const auto farthest = std::max_element(keys_.begin(), keys_.end(), [&](const KeyScan& a, const KeyScan& b) {
    return distanceBetween(a.pose, pose) < distanceBetween(b.pose, pose);
  });
  *farthest = {pose, surfaces_};
}

}  // namespace lstm_planner
