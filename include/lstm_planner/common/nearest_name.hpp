#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// The one of `names` that was most likely meant by `name`: `name` is its beginning, or differs from it by few letters
/// (edit distance of Damerau and Levenshtein). Empty if there is none.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

/// "; the nearest is NAME" as the end of a sentence; empty if there is no such name. "; here it is named NAME" where
/// `name` is what the navigation stack's local planners call one of `names`.
std::string hintAt(const std::string& name, const std::vector<std::string>& names);

}  // namespace lstm_planner
