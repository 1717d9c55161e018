#include "practice/practice_episode.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace lstm_planner {

float* addStep(const Encoder& encoder, const Observation& observation, PracticeEpisode* episode) {
  const auto own = static_cast<std::size_t>(encoder.size());
  const std::size_t first = episode->inputs.size();
  episode->inputs.resize(first + own + kDrivePrivilegedInputs);
  encoder.encode(observation, Eigen::Map<Eigen::VectorXf>(episode->inputs.data() + first, encoder.size()));
  if (encoder.parameters().views != 1) episode->bearings.push_back(bearingsOf(observation));
  episode->steps.emplace_back();
  return episode->inputs.data() + first + own;
}

PracticeSums sumUp(const std::vector<PracticeEpisode>& episodes) {
  PracticeSums sums;
  double practised = 0.0;
  for (const PracticeEpisode& episode : episodes) {
    sums.steps += static_cast<double>(episode.steps.size());
    if (episode.is_example) continue;
    practised += 1.0;
    for (const PracticeEpisode::Step& step : episode.steps) sums.reward += static_cast<double>(step.reward);
    sums.arrival += episode.arrived ? 1.0 : 0.0;
  }
  sums.reward /= std::max(1.0, practised);
  sums.arrival /= std::max(1.0, practised);
  return sums;
}

}  // namespace lstm_planner
