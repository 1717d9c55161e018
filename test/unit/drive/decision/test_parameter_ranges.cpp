#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "lstm_planner/simulation/scripted_driver.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_parameter_ranges {
namespace {

struct Number {
  std::string name;
  double least;
  double most;
};

template <typename Parameters>
std::string complaintAbout(const Parameters& parameters) {
  return test::refusalOf<std::invalid_argument>([&] { validate(parameters); });
}

/// No value beyond a double's ends for whole numbers.
void set(double value, double* number) { *number = value; }
void set(double value, int* number) {
  *number = value > 0.0 ? std::numeric_limits<int>::max() : std::numeric_limits<int>::min();
}

/// Every number that `visit_all` visits is refused outside its range, by its name.
template <typename Parameters, typename VisitAll>
void expectRanges(const VisitAll& visit_all) {
  EXPECT_EQ(complaintAbout(Parameters{}), "");
  std::vector<Number> numbers;
  Parameters defaults;
  visit_all(defaults,
            [&](const std::string& name, auto& value, [[maybe_unused]] Range range, const char*, const char*) {
              if constexpr (kIsNumber<std::decay_t<decltype(value)>>) {
                EXPECT_TRUE(range.contains(value)) << name;
                numbers.push_back({name, range.least, range.most});
              }
            });
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Number& number : numbers) {
    for (const double wrong : {std::nan(""), kInfinity, -kInfinity, 1e300, -1e300, number.least - 1.0,
                               std::nextafter(number.most, kInfinity)}) {
      Parameters parameters;
      visit_all(parameters, [&](const std::string& name, auto& value, Range, const char*, const char*) {
        if constexpr (kIsNumber<std::decay_t<decltype(value)>>) {
          if (name == number.name) set(wrong, &value);
        }
      });
      std::ostringstream range;
      range << ", expected a number in [" << number.least << ", " << number.most << "]";
      const std::string complaint = complaintAbout(parameters);
      EXPECT_EQ(complaint.find("parameter " + number.name + " is "), 0u) << wrong << ": " << complaint;
      EXPECT_NE(complaint.find(range.str()), std::string::npos) << wrong << ": " << complaint;
    }
  }
}

TEST(ParameterRanges, HoldForTheAgent) {
  expectRanges<AgentParameters>([](auto& p, const auto& visit) { visitAgentParameters(p, visit); });
}

TEST(ParameterRanges, HoldForTheController) {
  expectRanges<MotionParameters>([](auto& p, const auto& visit) { visitMotionParameters(p, visit); });
}

TEST(ParameterRanges, HoldForTheRecorder) {
  expectRanges<RecorderParameters>([](auto& p, const auto& visit) { visitRecorderParameters(p, visit); });
}

TEST(ParameterRanges, HoldForTheSimulatedRobotScannerDriverAndPeople) {
  expectRanges<Create2Parameters>([](auto& p, const auto& visit) { visitCreate2Parameters(p, visit); });
  expectRanges<HokuyoParameters>([](auto& p, const auto& visit) { visitHokuyoParameters(p, visit); });
  expectRanges<ScriptedDriverParameters>([](auto& p, const auto& visit) { visitDriverParameters(p, visit); });
}

TEST(ParameterRanges, BoundWhatAnUpdateOfTheMemoryCosts) {
  for (const double radius : {0.1, 0.17425, 0.5, 2.0, 4.0}) {
    AgentParameters parameters;
    parameters.shield.footprint_radius = radius;
    parameters.shield.reach = 100.0;
    parameters.memory.reach = 100.0;
    parameters.memory.tightness = 100.0;
    for (const double resolution : {0.29 * radius, std::max(0.01, 1.01 * radius / kMostNearSquares)}) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::to_string(resolution));
      MemoryParameters& memory = parameters.memory;
      memory.resolution = std::min(1.0, resolution);
      memory.width = std::min(1000.0, kMostSquaresASide * memory.resolution);
      parameters.shield.clearance = std::min(5.0, kMostNearSquares * memory.resolution - radius - 1e-9);
      parameters.shield.tight_clearance = std::min(parameters.shield.clearance, 0.03);
      memory.comfort = parameters.shield.clearance;
      ASSERT_EQ(complaintAbout(parameters), "");
      const LocalMap made(memory, parameters.shield);
      EXPECT_LE(made.nearCells(), 5);
      EXPECT_LE(made.side(), 501);
    }
  }
}

TEST(ParameterRanges, KeepComfortWithinWhatTheMemoryCanLookAt) {
  AgentParameters parameters;
  parameters.memory.comfort = 12.0;
  EXPECT_EQ(complaintAbout(parameters), "parameter memory/comfort is 12, expected a number in [0, 5]");
  parameters.memory.comfort = 1.2;
  EXPECT_EQ(complaintAbout(parameters),
            "parameter memory/comfort is 1.2, expected with shield/footprint_radius at most 16 memory/resolution = "
            "0.8");
}

TEST(ParameterRanges, KeepClearanceAndCornersWithinWhatTheMemoryCanLookAt) {
  AgentParameters parameters;
  parameters.shield.clearance = 0.7;
  EXPECT_EQ(complaintAbout(parameters),
            "parameter shield/clearance is 0.7, expected with shield/footprint_radius at most 16 memory/resolution = "
            "0.8");
  AgentParameters with_corners;
  with_corners.shield.footprint = "[[1.0, 0.2], [1.0, -0.2], [-1.0, -0.2], [-1.0, 0.2]]";
  with_corners.shield.footprint_radius = 0.2;
  EXPECT_EQ(complaintAbout(with_corners),
            "parameter shield/tight_clearance is 0.03, expected with the farthest corner of shield/footprint at most "
            "16 memory/resolution = 0.8");
}

}  // namespace
}  // namespace lstm_planner::test_parameter_ranges
