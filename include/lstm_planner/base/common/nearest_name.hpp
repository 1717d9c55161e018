#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// Of the names that there are the one that was most likely meant by `name`: one that it starts, or one of few letters
/// that are missing, too many, wrong or exchanged (edit distance of Damerau and Levenshtein). Empty where none is near.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

/// "; the nearest is NAME", to end a sentence with; empty where none is near.
std::string hintAt(const std::string& name, const std::vector<std::string>& names);

}  // namespace lstm_planner
