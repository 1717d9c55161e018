#include <gtest/gtest.h>

#include <vector>

#include "lstm_planner/training/teacher_rescue.hpp"

namespace lstm_planner::test_teacher_rescue {
namespace {

/// Whether the teacher leads, step by step.
std::vector<bool> ledByTeacher(const std::vector<double>& distances) {
  TeacherRescue rescue(0.5, 3, 2);
  std::vector<bool> led;
  for (const double distance : distances) led.push_back(rescue.wanted(distance));
  return led;
}

TEST(TeacherRescue, LeadsForAWhileWhereTheLearnerIsStuck) {
  EXPECT_EQ(ledByTeacher({9, 9, 9, 9, 9, 9, 9}), (std::vector<bool>{false, false, false, true, true, false, true}));
}

TEST(TeacherRescue, LetsALearnerThatComesNearerLead) {
  EXPECT_EQ(ledByTeacher({9, 8, 7, 6, 5, 4, 3}), std::vector<bool>(7, false));
}

TEST(TeacherRescue, DoesNotTakeSmallStepsForProgress) {
  EXPECT_EQ(ledByTeacher({9.0, 8.9, 8.8, 8.7}), (std::vector<bool>{false, false, false, true}));
}

}  // namespace
}  // namespace lstm_planner::test_teacher_rescue
