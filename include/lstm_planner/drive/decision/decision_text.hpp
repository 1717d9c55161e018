#pragma once

#include <string>

#include "lstm_planner/drive/decision/decision.hpp"

namespace lstm_planner {

/// In a sentence: who decided, whether along the remembered path, and who overruled the leader. For people.
std::string describe(const Decision& decision);

}  // namespace lstm_planner
