#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/drive/perception/scan_rules.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_scan_rules {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  return test::refusalOf<std::invalid_argument>([&] {
    ScanRules rules;
    setNoReturn(text, &rules);
  });
}

TEST(ScanRules, AreReadFromTheTextThatTheyAreWrittenAs) {
  for (const std::string text : {"", "nan", "zero beyond", "below", "nan zero beyond 65.53"}) {
    ScanRules rules = urgNodeRules();
    setNoReturn(text, &rules);
    EXPECT_EQ(noReturnText(rules), text);
  }
}

TEST(ScanRules, KeepTheLeastShareWhenTheReadingsAreReadAnew) {
  ScanRules rules;
  rules.least_measured = 0.2;
  setNoReturn("nan", &rules);
  EXPECT_EQ(rules.least_measured, 0.2);
}

TEST(ScanRules, AreRefusedWithTheWordThatIsNoReading) {
  EXPECT_THAT(refusal("nan infinite"), HasSubstr("the word 'infinite', expected nan, zero, below, beyond or a reading "
                                                 "from above 0 to 10000 m; +inf needs no word"));
  EXPECT_THAT(refusal("-1"), HasSubstr("'-1'"));
  EXPECT_THAT(refusal("65.53m"), HasSubstr("'65.53m'"));
  EXPECT_THAT(refusal("65.53 82"), HasSubstr("expected one number at most"));
}

TEST(ScanRules, BeamTimesAreReadFromTheTextThatTheyAreWrittenAs) {
  for (const std::string text : {"", "0.18 0", "0 -0.2"}) {
    ScanRules rules;
    rules.beam_times = BeamTimes{0.5, 0.5};
    setBeamTimes(text, &rules);
    EXPECT_EQ(beamTimesText(rules), text);
  }
  ScanRules rules;
  setBeamTimes("[0.182, 0.0]", &rules);  // as rosparam reads a list
  EXPECT_EQ(beamTimesText(rules), "0.182 0");
  setNoReturn("nan", &rules);
  EXPECT_EQ(beamTimesText(rules), "0.182 0") << "the readings are another matter";
}

TEST(ScanRules, BeamTimesAreTwoNumbersOfLessThanASecond) {
  for (const std::string text : {"0.18", "0.18 0 0", "0.18 fast", "0.18s 0", "0 nan", "0 1.5", "-2 0"}) {
    const std::string said = test::refusalOf<std::invalid_argument>([&] {
      ScanRules rules;
      setBeamTimes(text, &rules);
    });
    EXPECT_EQ(said, "beam_times is '" + text + "', expected two numbers from -1 to 1 s, such as 0.18 0");
  }
}

TEST(ScanRules, NeedAShareThatIsNotZero) {
  ScanRules rules;
  rules.least_measured = 0.0;
  EXPECT_THROW(validate(rules), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_scan_rules
