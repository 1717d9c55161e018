#include "robot/learning/drive_batch.hpp"

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
  judged_ = CriticSums(advantage_variances->size());
  for (const CriticSums& some : tiles_.each(judged_, [&](DriveTile* tile) { return tile->judge(critic_parameters); })) {
    judged_ += some;
  }
  judged_.moveVariances(kVarianceRate, advantage_variances);
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
