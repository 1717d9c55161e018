#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner::test_text_table {
namespace {

TEST(TextTable, CellsEndWhereTheirHeadingsEnd) {
  const TextTable table("epoch  mean accuracy    p95");
  EXPECT_EQ(table.line({"3", "0.25", "1.5"}), "    3           0.25    1.5");
  EXPECT_EQ(table.line({"12345"}), "12345");
}

TEST(TextTable, AWideCellKeepsABlankBeforeTheNextAndLetsLaterOnesStandInPlace) {
  const TextTable table("a  bb  cccccc");
  EXPECT_EQ(table.line({"long", "7", "8"}), "long 7      8");
}

TEST(TextTable, NamesOnTheLeftAreAsWideAsTheirColumn) {
  const TextTable table(leftText("set", 6) + "  count");
  EXPECT_EQ(table.headings(), "set     count");
  EXPECT_EQ(table.line({leftText("mazes", 6), "12"}), "mazes      12");
  EXPECT_EQ(leftText("too long", 3), "too long");
}

TEST(TextTable, MoreCellsThanHeadingsAreRefused) {
  const TextTable table("a  b");
  EXPECT_THROW(table.line({"1", "2", "3"}), std::invalid_argument);
}

TEST(TextTable, FixedTextHasAsManyDecimalsAsWanted) {
  EXPECT_EQ(fixedText(2.0 / 3.0, 3), "0.667");
  EXPECT_EQ(fixedText(1e6, 0), "1000000");
}

}  // namespace
}  // namespace lstm_planner::test_text_table
