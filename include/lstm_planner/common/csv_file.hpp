#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lstm_planner {

/// Reads columns of numbers from a CSV file. The first line names the columns, which may be in any order. Lines may end
/// with CR LF, and the file may begin with a byte order mark; blank lines are skipped. Throws std::invalid_argument
/// naming the file, the line and what was expected.
class CsvFile {
 public:
  /// The file must have `columns`, at least one. It may have `optional_columns`; see has().
  CsvFile(const std::string& path, const std::vector<std::string>& columns,
          const std::vector<std::string>& optional_columns = {});

  std::size_t lines() const { return numbers_.size() / has_.size(); }
  /// Whether the file has the column. Columns are numbered as in the constructor's lists, the optional ones after the
  /// others.
  bool has(std::size_t column) const { return has_[column]; }
  /// NaN if the file does not have the column.
  double number(std::size_t line, std::size_t column) const { return numbers_[line * has_.size() + column]; }

 private:
  std::vector<bool> has_;
  std::vector<double> numbers_;  ///< line by line
};

}  // namespace lstm_planner
