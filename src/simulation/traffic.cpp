#include "lstm_planner/simulation/traffic.hpp"

namespace lstm_planner {

void Traffic::show(const std::vector<Body>& bodies) {
  circles().clear();
  for (const Body& body : bodies) circles().push_back(body.circle);
}

}  // namespace lstm_planner
