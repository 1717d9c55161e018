#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace lstm_planner {

/// A table in Markdown, row by row.
class MarkdownTable {
 public:
  /// Writes the headings and the rule below them. `out` must outlive the table.
  MarkdownTable(const std::vector<std::string>& headings, std::ostream* out) : out_(*out) {
    row(headings);
    out_ << '|';
    for (std::size_t i = 0; i < headings.size(); ++i) out_ << "---|";
    out_ << '\n';
  }

  void row(const std::vector<std::string>& cells) {
    out_ << '|';
    for (const std::string& cell : cells) out_ << ' ' << cell << " |";
    out_ << '\n';
  }

 private:
  std::ostream& out_;
};

}  // namespace lstm_planner
