#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"

#include <cctype>

namespace lstm_planner {
namespace {

/// Thesis, Tables 3.7, 3.8 and 3.9.
const std::vector<ThesisTable>& tables() {
  static const std::vector<ThesisTable> all = {
      {"3.7",
       "Online testing in Dragon Age maps",
       "3.15",
       {{"A*", 1.00, 3.37e-4, 45.82, 47.029}, {"LSTM", 0.68, 1.69e-3, 53.39, 44.41}}},
      {"3.8",
       "Online testing in mazes with corridors 8 steps wide",
       "3.16",
       {{"A*", 1.00, 2.96e-4, 50.90, 53.69}, {"LSTM", 0.26, 1.98e-3, 61.71, 52.92}}},
      {"3.9",
       "Online testing in maps randomly filled for 25 %",
       "3.17",
       {{"A*", 1.00, 2.84e-4, 61.60, 49.85}, {"LSTM", 0.82, 2.04e-3, 71.57, 56.02}}},
  };
  return all;
}

std::string lowerCase(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace

bool isGridSet(const std::string& set_name, const std::string& kind, const std::string& number) {
  const std::string name = lowerCase(set_name);
  if (name.find(kind) == std::string::npos) return false;
  const std::size_t last = name.find_last_of("0123456789");
  if (last == std::string::npos) return false;
  const std::size_t before = name.find_last_not_of("0123456789", last);
  return name.substr(before + 1, last - before) == number;
}

const ThesisTable* thesisTableOf(const std::string& set_name) {
  const std::string name = lowerCase(set_name);
  if (name.find("dragon") != std::string::npos || name == "dao") return &tables()[0];
  if (isGridSet(name, "maze", "8")) return &tables()[1];
  if (isGridSet(name, "random", "25")) return &tables()[2];
  return nullptr;
}

}  // namespace lstm_planner
