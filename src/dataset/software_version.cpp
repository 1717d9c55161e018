#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

std::string softwareVersion() { return LSTM_PLANNER_VERSION; }

}  // namespace lstm_planner
