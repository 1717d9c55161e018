#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lstm_planner {

/// How many letters must be changed, added or left out to get one text from the other; the exchange of two neighbours
/// counts as one (distance of Damerau and Levenshtein).
std::size_t editDistance(const std::string& a, const std::string& b);

/// The one of `names` that was most likely meant by `name`: `name` is its beginning, or differs from it by few letters
/// (editDistance()). Empty if there is none.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

/// "; the nearest is NAME" as the end of a sentence; empty if nearestName() is.
std::string hintAt(const std::string& name, const std::vector<std::string>& names);

}  // namespace lstm_planner
