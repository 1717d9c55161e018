#include "lstm_planner/common/nearest_name.hpp"

#include <algorithm>
#include <cstddef>

namespace lstm_planner {

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        rows[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({replaced, rows[i - 1][j] + 1, rows[i][j - 1] + 1});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
    }
  }
  return rows[a.size()][b.size()];
}

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 100;  // what is longer is no slip of the pen
  if (name.empty() || name.size() > kLongest) return "";
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3);  // farther names are others
  for (const std::string& candidate : names) {
    const bool starts = name.size() > 1 && candidate.compare(0, name.size(), name) == 0;
    const std::size_t distance = starts ? 1 : editDistance(name, candidate);
    if (distance > least || (distance == least && !nearest.empty())) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string hintAt(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(name, names);
  return nearest.empty() ? "" : "; the nearest is " + nearest;
}

}  // namespace lstm_planner
