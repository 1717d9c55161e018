#include "lstm_planner/common/text_table.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lstm_planner {

std::string fixedText(double number, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << number;
  return text.str();
}

std::string numberText(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string percentText(double share, int decimals) { return fixedText(100.0 * share, decimals) + " %"; }

std::string leftText(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

TextTable::TextTable(std::string headings) : headings_(std::move(headings)) {
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    const bool ends = i + 1 == headings_.size() || headings_.compare(i + 1, 2, "  ") == 0;
    if (headings_[i] != ' ' && ends) ends_.push_back(i + 1);
  }
}

std::string TextTable::line(const std::vector<std::string>& cells) const {
  if (cells.size() > ends_.size()) {
    throw std::invalid_argument("a line has " + std::to_string(cells.size()) + " cells, expected " +
                                std::to_string(ends_.size()) + " as there are headings, or fewer");
  }
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t start = ends_[i] - std::min(ends_[i], cells[i].size());
    line.resize(i == 0 ? start : std::max(start, line.size() + 1), ' ');
    line += cells[i];
  }
  return line;
}

}  // namespace lstm_planner
