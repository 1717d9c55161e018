#include "robot/learning/drive_batch.hpp"

#include <algorithm>
#include <memory>

namespace lstm_planner {
namespace {

/// Share by which the variances move towards those of one batch.
constexpr double kVarianceRate = 0.3;

}  // namespace

DriveBatch::DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
                       const std::vector<PracticeEpisode>& episodes)
    : tiles_(parameters.communicator, parameters.threads,
             [&] { return std::make_unique<DriveTile>(parameters, policy, critic); }),
      windows_(tiles_.pack(episodes)) {}

void DriveBatch::judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances) {
  const std::vector<DriveTileSums> all = tiles_.each(DriveTileSums(advantage_variances->size()),
                                                     [&](DriveTile* tile) { return tile->judge(critic_parameters); });
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

double DriveBatch::policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights,
                                  Eigen::VectorXf* gradient) {
  return tiles_.addUp(
      parameters.size(), [&](DriveTile* tile) { return tile->policyGradient(window_, parameters, weights); }, gradient);
}

double DriveBatch::criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient) {
  return tiles_.addUp(
      parameters.size(), [&](DriveTile* tile) { return tile->criticGradient(window_, parameters); }, gradient);
}

double DriveBatch::entropy() {
  DriveTileEntropy all;
  for (const DriveTileEntropy& some : tiles_.each(all, [](DriveTile* tile) { return tile->entropy(); })) {
    all.sum += some.sum;
    all.steps += some.steps;
  }
  return all.steps > 0.0 ? all.sum / all.steps : 0.0;
}

}  // namespace lstm_planner
