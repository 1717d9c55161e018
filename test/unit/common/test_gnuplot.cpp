#include <gtest/gtest.h>

#include "lstm_planner/common/gnuplot.hpp"

namespace lstm_planner::test_gnuplot {
namespace {

TEST(Gnuplot, TheNumbersLieBesideThePicture) {
  EXPECT_EQ(csvPathBeside("results/curve.png"), "results/curve.csv");
  EXPECT_EQ(csvPathBeside("results.2/curve"), "results.2/curve.csv");
  EXPECT_EQ(csvPathBeside("./curve"), "./curve.csv");
  EXPECT_EQ(csvPathBeside("curve.csv"), "curve.csv.csv") << "the picture has the name that somebody chose";
}

}  // namespace
}  // namespace lstm_planner::test_gnuplot
