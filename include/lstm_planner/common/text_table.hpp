#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lstm_planner {

/// A number with so many decimals: "0.80".
std::string fixedText(double number, int decimals);

/// A number as people write it, with six digits at most: "0.8", "2.04", "1e+06".
std::string numberText(double number);

/// "12.3 %".
std::string percentText(double share, int decimals = 1);

/// The text, filled with blanks on the right up to `width`.
std::string leftText(const std::string& text, std::size_t width);

/// A line of headings, and lines of cells below it, as people read them on a terminal. A cell ends where its heading
/// ends.
class TextTable {
 public:
  /// Between two headings there are two blanks or more.
  explicit TextTable(std::string headings);

  const std::string& headings() const { return headings_; }
  /// Cells from the left. A cell that is too wide moves those behind it as far as needed.
  std::string line(const std::vector<std::string>& cells) const;

 private:
  std::string headings_;
  std::vector<std::size_t> ends_;
};

}  // namespace lstm_planner
