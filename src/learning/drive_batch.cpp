#include "drive_batch.hpp"

#include <algorithm>

#include "parallel_for.hpp"

namespace lstm_planner {
namespace {

/// Of drives, in all tiles together.
constexpr int kLanes = 128;

/// Share of the way that the variances go towards those of one batch.
constexpr double kVarianceRate = 0.3;

}  // namespace

DriveBatch::DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
                       const std::vector<PracticeEpisode>& episodes)
    : parameters_(parameters) {
  const int tiles = kLanes / DriveTile::lanesFor(parameters);
  for (int tile = 0; tile < tiles; ++tile) {
    tiles_.push_back(std::make_unique<DriveTile>(parameters, policy, critic));
  }
  pack(episodes);
}

/// Each drive to the lane that is shortest so far.
void DriveBatch::pack(const std::vector<PracticeEpisode>& episodes) {
  for (const PracticeEpisode& episode : episodes) {
    DriveTile* shortest = nullptr;
    std::size_t lane = 0;
    for (const auto& tile : tiles_) {
      const std::size_t own = tile->shortestLane();
      if (shortest != nullptr && tile->lengthOf(own) >= shortest->lengthOf(lane)) continue;
      shortest = tile.get();
      lane = own;
    }
    shortest->append(lane, episode);
  }
  std::size_t longest = 0;
  for (const auto& tile : tiles_) longest = std::max(longest, tile->longest());
  windows_ = (static_cast<int>(longest) + parameters_.window - 1) / parameters_.window;
  for (const auto& tile : tiles_) tile->close(windows_);
}

void DriveBatch::judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances) {
  std::vector<DriveTileSums> all(tiles_.size());
  parallelFor(static_cast<int>(tiles_.size()), parameters_.threads, [&](int tile, int) {
    all[static_cast<std::size_t>(tile)] = tiles_[static_cast<std::size_t>(tile)]->judge(critic_parameters);
  });
  DriveTileSums sum = all.front();
  for (std::size_t tile = 1; tile < all.size(); ++tile) {
    for (std::size_t kind = 0; kind < sum.counts.size(); ++kind) {
      sum.squares[kind] += all[tile].squares[kind];
      sum.counts[kind] += all[tile].counts[kind];
    }
    sum.steps += all[tile].steps;
    sum.returns += all[tile].returns;
    sum.squared_returns += all[tile].squared_returns;
    sum.squared_errors += all[tile].squared_errors;
  }
  for (std::size_t kind = 0; kind < sum.counts.size(); ++kind) {
    if (sum.counts[kind] == 0.0) continue;
    double& variance = (*advantage_variances)[kind];
    variance += kVarianceRate * (sum.squares[kind] / sum.counts[kind] - variance);
  }
  const double spread = sum.squared_returns - sum.returns * sum.returns / sum.steps;
  explained_ = 1.0 - sum.squared_errors / std::max(1e-12, spread);
}

void DriveBatch::rewind() {
  window_ = -1;
  for (const auto& tile : tiles_) tile->rewind();
}

double DriveBatch::addUp(const std::function<double(DriveTile*)>& work, Eigen::VectorXf* gradient) {
  std::vector<double> counts(tiles_.size());
  parallelFor(static_cast<int>(tiles_.size()), parameters_.threads, [&](int tile, int) {
    const auto i = static_cast<std::size_t>(tile);
    counts[i] = work(tiles_[i].get());
  });
  double count = 0.0;
  *gradient = tiles_.front()->gradient();
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    count += counts[tile];
    if (tile > 0) *gradient += tiles_[tile]->gradient();
  }
  return count;
}

double DriveBatch::policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights,
                                  Eigen::VectorXf* gradient) {
  return addUp([&](DriveTile* tile) { return tile->policyGradient(window_, parameters, weights); }, gradient);
}

double DriveBatch::criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient) {
  return addUp([&](DriveTile* tile) { return tile->criticGradient(window_, parameters); }, gradient);
}

double DriveBatch::entropy() const {
  double entropy = 0.0;
  double steps = 0.0;
  for (const auto& tile : tiles_) {
    entropy += tile->entropy();
    steps += tile->stepsSeen();
  }
  return steps > 0.0 ? entropy / steps : 0.0;
}

}  // namespace lstm_planner
