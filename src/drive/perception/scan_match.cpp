#include "lstm_planner/drive/perception/scan_match.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lstm_planner {

namespace {

constexpr int kRounds = 8;
/// m between a piece and its line: far at first, near once the pose is nearly right.
constexpr double kFarthest[kRounds] = {0.3, 0.3, 0.15, 0.15, 0.1, 0.1, 0.1, 0.1};
constexpr int kFewestRounds = 5;
constexpr double kDistanceError = 0.03;  ///< m, standard deviation; more than noise, as neighbours err alike
constexpr double kOutlier = 0.05;        ///< m, at which a piece counts half (Cauchy)
constexpr double kStill = 1e-4;          ///< m and rad
constexpr double kLeastShare = 0.2;      ///< of the pieces
constexpr std::size_t kFewestPieces = 15;
constexpr double kMostErrors = 5.0;  ///< standard deviations of the prediction

/// What the pieces say about the pose, as the normal equations of one step.
class Equations {
 public:
  Equations(const Pose2& predicted, const PoseError& error, const Pose2& pose) {
    const double position = 1.0 / square(error.position);
    information_.diagonal() << position, position, 1.0 / square(error.yaw);
    pull_ = -information_.diagonal().cwiseProduct(
        Eigen::Vector3d(pose.x - predicted.x, pose.y - predicted.y, normalizeAngle(pose.yaw - predicted.yaw)));
  }

  /// A piece `arm` from the robot is `distance` from its line, whose normal is `normal`; all in the frame of the pose.
  void add(const Point2& arm, const Point2& normal, double distance, double weight) {
    const Eigen::Vector3d slope(normal.x, normal.y, normal.y * arm.x - normal.x * arm.y);
    information_ += weight * slope * slope.transpose();
    pull_ -= weight * distance * slope;
  }

  Eigen::Vector3d step() const { return information_.ldlt().solve(pull_); }

 private:
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull_;
};

Point2 turned(const Pose2& pose, const Point2& vector) { return toParentFrame({0.0, 0.0, pose.yaw}, vector); }

/// Adds the pieces that lie on a surface of the key scan; `weight` of one.
void addPieces(const std::vector<SurfacePiece>& pieces, const KeyScan& key, const Pose2& pose, double farthest,
               double weight, Equations* equations, std::vector<std::uint8_t>* is_matched) {
  const Pose2 from_key = compose(inverse(key.pose), pose);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const SurfacePiece piece = inParentFrame(from_key, pieces[i]);
    const SurfacePiece* surface = key.surfaces.under(piece, farthest);
    if (surface == nullptr) continue;
    const double distance = surface->off(piece.at);
    (*is_matched)[i] = 1;
    equations->add(turned(pose, pieces[i].at), turned(key.pose, surface->normal), distance,
                   weight / (1.0 + square(distance / kOutlier)));
  }
}

}  // namespace

ScanMatch matchScan(const std::vector<SurfacePiece>& pieces, const std::vector<const KeyScan*>& keys,
                    const Pose2& predicted, const PoseError& error) {
  ScanMatch found;
  found.pose = predicted;
  if (pieces.empty() || keys.empty()) return found;
  // Key scans that see the same wall say the same.
  const double weight = 1.0 / (square(kDistanceError) * static_cast<double>(keys.size()));
  std::vector<std::uint8_t> is_matched;
  for (int round = 0; round < kRounds; ++round) {
    Equations equations(predicted, error, found.pose);
    is_matched.assign(pieces.size(), 0);
    for (const KeyScan* key : keys) {
      addPieces(pieces, *key, found.pose, kFarthest[round], weight, &equations, &is_matched);
    }
    const Eigen::Vector3d step = equations.step();
    found.pose = {found.pose.x + step[0], found.pose.y + step[1], normalizeAngle(found.pose.yaw + step[2])};
    if (round + 1 >= kFewestRounds && step.cwiseAbs().maxCoeff() < kStill) break;
  }
  const auto matched = static_cast<double>(std::count(is_matched.begin(), is_matched.end(), 1));
  found.share = matched / static_cast<double>(pieces.size());
  const bool is_near = distanceBetween(found.pose, predicted) < kMostErrors * error.position &&
                       turnBetween(found.pose, predicted) < kMostErrors * error.yaw;
  found.is_sure = is_near && found.share > kLeastShare && pieces.size() >= kFewestPieces;
  return found;
}

}  // namespace lstm_planner
