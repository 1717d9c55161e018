#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "lstm_planner/common/csv_writer.hpp"

namespace lstm_planner::test_csv_writer {
namespace {

TEST(CsvWriter, WritesRowsOfTextNumbersAndListsInOneOrAFewPieces) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.row("name", "count", "share", "good");
  csv.add("a", 3);
  csv.add(0.125);
  csv.row(true);
  csv.addAll(std::vector<long>{1, 2});
  csv.endRow();
  EXPECT_EQ(out.str(), "name,count,share,good\na,3,0.125,1\n1,2\n");
}

TEST(CsvWriter, QuotesWhatWouldOtherwiseBeReadAsSomethingElse) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.row("A*, thesis", "6\" wide", "two\nlines", "a;b", "plain text");
  EXPECT_EQ(out.str(), "\"A*, thesis\",\"6\"\" wide\",\"two\nlines\",a;b,plain text\n");
}

TEST(CsvWriter, AnotherSeparatorIsQuotedInPlaceOfTheComma) {
  std::ostringstream out;
  CsvWriter csv(&out, CsvWriter::Digits::kSix, ';');
  csv.row("lstm,no-shield", "a;b");
  EXPECT_EQ(out.str(), "lstm,no-shield;\"a;b\"\n");
}

TEST(CsvWriter, ExactNumbersAreReadAgainAsTheyWere) {
  std::ostringstream out;
  CsvWriter csv(&out, CsvWriter::Digits::kExact);
  const double number = 1.0 / 3.0;
  const float single = 0.1f;
  csv.row(number, single);
  const std::string text = out.str();
  const std::size_t comma = text.find(',');
  EXPECT_EQ(std::stod(text.substr(0, comma)), number);
  EXPECT_EQ(std::stof(text.substr(comma + 1)), single);
  EXPECT_EQ(text, "0.33333333333333331,0.100000001\n");
}

TEST(CsvWriter, FixedDecimalsDoNotStayForTheNextNumber) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.addFixed(2.0, 3);
  csv.row(2.0);
  EXPECT_EQ(out.str(), "2.000,2\n");
}

TEST(CsvWriter, WhatIsNoFiniteNumberIsEmpty) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.add(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<float>::infinity());
  csv.addFixed(-std::numeric_limits<double>::infinity(), 2);
  csv.row(1);
  EXPECT_EQ(out.str(), ",,,1\n");
}

}  // namespace
}  // namespace lstm_planner::test_csv_writer
