#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/perception/encoder.hpp"
#include "lstm_planner/drive/perception/network_inputs.hpp"

namespace lstm_planner::test_network_inputs {
namespace {

Observation randomObservation(std::uint64_t seed) {
  Random random(seed);
  Observation observation;
  for (double& range : observation.sector_ranges) range = uniform(random, 0.0, 6.0);
  for (double& visits : observation.visits) visits = uniform(random, 0.0, 5.0);
  for (PlacesAround& places : observation.places) {
    for (double& visits : places.visits) visits = uniform(random, 0.0, 5.0);
    for (double& age : places.ages) age = uniform(random, 0.0, 100.0);
  }
  for (double* angle : {&observation.goal_bearing, &observation.heading, &observation.previous_action,
                        &observation.route_bearing, &observation.turn}) {
    *angle = uniform(random, -3.0, 3.0);
  }
  observation.goal_distance = uniform(random, 0.0, 10.0);
  observation.room_visits = uniform(random, 0.0, 5.0);
  observation.behind_best = uniform(random, 0.0, 5.0);
  observation.steps_since_best = uniform(random, 0.0, 100.0);
  observation.motion = {uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5)};
  return observation;
}

TEST(NetworkInputs, MirrorAsTheirRowsSay) {
  EncoderParameters parameters;
  parameters.event_range = 3.0;
  const Observation observation = randomObservation(1);
  const Observation other = mirrored(observation);
  for (const NetworkInput& input : networkInputs()) {
    const auto mirroredIndex = [&](int index) {
      if (input.mirrors == InputMirrors::kSectors) return kSectorCount - 1 - index;
      return input.mirrors == InputMirrors::kAround ? (kPlaceDirections - index) % kPlaceDirections : index;
    };
    const double sign = input.mirrors == InputMirrors::kSign ? -1.0 : 1.0;
    for (int index = 0; index < input.count; ++index) {
      EXPECT_NEAR(input.value(other, parameters, index),
                  sign * input.value(observation, parameters, mirroredIndex(index)), 1e-12)
          << input.name << " " << index;
    }
  }
}

TEST(NetworkInputs, AViewIsThatOfARobotTurnedByItsAngle) {
  const EncoderParameters parameters;
  Observation observation = randomObservation(2);
  observation.turn = 0.0;
  observation.heading = 0.0;
  for (int view = 0; view < kDriveViews; ++view) {
    const double angle = view * kViewAngle;
    Observation turned = observation;
    turned.heading = normalizeAngle(-angle);  // in the odometry frame: the view looks along its x axis then
    turned.goal_bearing = normalizeAngle(observation.goal_bearing - angle);
    turned.previous_action = normalizeAngle(observation.previous_action - angle);
    turned.motion = toLocalFrame({0.0, 0.0, angle}, observation.motion);
    for (const NetworkInput& input : networkInputs()) {
      if (input.turns != InputTurns::kBearing) continue;
      EXPECT_NEAR(input.from(bearingsOf(observation), parameters, view), input.value(turned, parameters, 0), 1e-12)
          << input.name << " in view " << view;
    }
  }
}

TEST(NetworkInputs, EachNameIsFoundAndBelongsToOneRow) {
  std::set<std::string> names;
  std::set<std::string> groups;
  for (const NetworkInput& input : networkInputs()) groups.insert(input.group);
  for (const std::string& group : groups) {
    for (const std::string& name : inputsOfGroup(group)) {
      EXPECT_TRUE(names.insert(name).second) << name;
      EXPECT_EQ(inputNamed(name).input->group, group) << name;
    }
  }
  EXPECT_EQ(inputNamed("room_visits").input->count, 1);
  EXPECT_EQ(inputNamed("room_visits_3").index, 3);
  for (const char* name : {"sector", "sector_8", "sector_", "_0", "", "heading_0"}) {
    EXPECT_THROW(inputNamed(name), std::invalid_argument) << name;
  }
}

TEST(NetworkInputs, StandInTheTableOfThePage) {
  std::ifstream file(LSTM_PLANNER_SOURCE_DIR "/models/onnx.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::size_t table = page.find("| input | value | group |\n");
  const auto end = page.begin() + static_cast<std::ptrdiff_t>(page.find("\n\n", table));
  constexpr int kHead = 2;  // rows
  EXPECT_EQ(std::count(page.begin() + static_cast<std::ptrdiff_t>(table), end, '\n') + 1 - kHead,
            static_cast<std::ptrdiff_t>(networkInputs().size()));
  for (const NetworkInput& input : networkInputs()) {
    const std::string name = input.name;
    const std::string names = input.count > 1 ? "`" + name + "_0` ... `" + name + "_7`" : "`" + name + "`";
    const std::string row = "| " + names + " | " + input.meaning + " | " + input.group + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace lstm_planner::test_network_inputs
