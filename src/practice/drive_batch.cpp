#include "practice/drive_batch.hpp"

#include <algorithm>
#include <cstddef>

namespace lstm_planner {
namespace {

/// Share by which the variances move towards those of one batch.
constexpr double kVarianceRate = 0.3;

/// Of drives, in all tiles together.
constexpr int kQueues = 128;

}  // namespace

DriveBatch::DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
                       const std::vector<PracticeEpisode>& episodes)
    : exchange_(parameters.communicator, parameters.threads) {
  do {
    tiles_.push_back(std::make_unique<DriveTile>(parameters, policy, critic));
  } while (static_cast<int>(tiles_.size()) * tiles_.front()->queues().count() < kQueues);
  windows_ = pack(episodes);
}

int DriveBatch::pack(const std::vector<PracticeEpisode>& episodes) {
  for (const PracticeEpisode& episode : episodes) {
    DriveTile* shortest = nullptr;
    std::size_t queue = 0;
    for (const auto& tile : tiles_) {
      const std::size_t own = tile->queues().shortestQueue();
      if (shortest != nullptr && tile->queues().lengthOf(own) >= shortest->queues().lengthOf(queue)) continue;
      shortest = tile.get();
      queue = own;
    }
    shortest->queues().append(queue, episode);
  }
  std::size_t longest = 0;
  for (const auto& tile : tiles_) longest = std::max(longest, tile->queues().longest());
  const int window = tiles_.front()->queues().window();
  const int windows = (static_cast<int>(longest) + window - 1) / window;
  for (const auto& tile : tiles_) tile->queues().close(windows);
  return windows;
}

template <typename Sum, typename Work>
Sum DriveBatch::run(const Sum& zero, const Work& work) {
  return exchange_.run(static_cast<int>(tiles_.size()), zero,
                       [&](int tile, int) { return work(tiles_[static_cast<std::size_t>(tile)].get()); });
}

template <typename Work>
double DriveBatch::addUp(Eigen::Index size, const Work& work, Eigen::VectorXf* gradient) {
  const double steps = run(0.0, work);
  *gradient = exchange_.sumOf(static_cast<int>(tiles_.size()), size, [&](int tile) -> const Eigen::VectorXf& {
    return tiles_[static_cast<std::size_t>(tile)]->gradient();
  });
  return steps;
}

void DriveBatch::judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances) {
  judged_ =
      run(CriticSums(advantage_variances->size()), [&](DriveTile* tile) { return tile->judge(critic_parameters); });
  judged_.moveVariances(kVarianceRate, advantage_variances);
}

void DriveBatch::rewind() {
  window_ = -1;
  for (const auto& tile : tiles_) tile->rewind();
}

double DriveBatch::policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights,
                                  Eigen::VectorXf* gradient) {
  return addUp(
      parameters.size(), [&](DriveTile* tile) { return tile->policyGradient(window_, parameters, weights); }, gradient);
}

double DriveBatch::criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient) {
  return addUp(
      parameters.size(), [&](DriveTile* tile) { return tile->criticGradient(window_, parameters); }, gradient);
}

double DriveBatch::entropy() {
  const DriveTileEntropy all = run(DriveTileEntropy(), [](DriveTile* tile) { return tile->entropy(); });
  return all.steps > 0.0 ? all.sum / all.steps : 0.0;
}

}  // namespace lstm_planner
