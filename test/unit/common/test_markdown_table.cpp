#include <gtest/gtest.h>

#include <sstream>

#include "lstm_planner/common/markdown_table.hpp"

namespace lstm_planner::test_markdown_table {
namespace {

TEST(MarkdownTable, HasHeadingsARuleAndRows) {
  std::ostringstream out;
  MarkdownTable table({"agent", "success"}, &out);
  table.row({"A*", ""});
  EXPECT_EQ(out.str(), "| agent | success |\n|---|---|\n| A* |  |\n");
}

}  // namespace
}  // namespace lstm_planner::test_markdown_table
