#include "lstm_planner/training/critic.hpp"

#include <algorithm>

namespace lstm_planner {

void CriticSums::count(std::size_t set, double value, double advantage) {
  const double result = value + advantage;
  steps += 1.0;
  returns += result;
  squared_returns += result * result;
  squared_errors += advantage * advantage;
  set_steps[set] += 1.0;
  set_squared_advantages[set] += advantage * advantage;
}

double CriticSums::explained() const {
  const double spread = squared_returns - returns * returns / steps;
  return 1.0 - squared_errors / std::max(1e-12, spread);
}

void CriticSums::moveVariances(double share, std::vector<double>* variances) const {
  for (std::size_t set = 0; set < set_steps.size(); ++set) {
    if (set_steps[set] == 0.0) continue;
    double& variance = (*variances)[set];
    variance += share * (set_squared_advantages[set] / set_steps[set] - variance);
  }
}

std::vector<double*> numbersOf(CriticSums* sums) {
  std::vector<double*> all = {&sums->steps, &sums->returns, &sums->squared_returns, &sums->squared_errors};
  for (std::vector<double>* by_set : {&sums->set_steps, &sums->set_squared_advantages}) {
    for (double& number : *by_set) all.push_back(&number);
  }
  return all;
}

}  // namespace lstm_planner
