#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

/// Notes the parameters that it visits by their names, for a checkpoint; see parameter_visitors.hpp.
inline auto noteIn(nlohmann::json* settings) {
  return [settings](const std::string& name, const auto& value, Range, const char*, const char*) {
    (*settings)[name] = value;
  };
}

}  // namespace lstm_planner
