#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lstm_planner {

/// Some columns of numbers from a CSV file whose first line names its columns. Lines may end with CR LF, columns may be
/// in any order, blank lines are skipped. Throws std::invalid_argument naming the file, the line and what was expected.
class CsvFile {
 public:
  /// `columns` have to be there, `optional_columns` need not: has() says whether they are.
  CsvFile(const std::string& path, const std::vector<std::string>& columns,
          const std::vector<std::string>& optional_columns = {});

  std::size_t lines() const { return numbers_.size() / has_.size(); }
  /// `column` as in the constructor's lists, the optional ones after the others.
  bool has(std::size_t column) const { return has_[column]; }
  /// NaN for a column that is not there.
  double number(std::size_t line, std::size_t column) const { return numbers_[line * has_.size() + column]; }

 private:
  std::vector<bool> has_;
  std::vector<double> numbers_;  ///< line by line
};

}  // namespace lstm_planner
