#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_agent_parameters {
namespace {

std::string complaintAbout(const std::function<void(AgentParameters*)>& change) {
  AgentParameters parameters;
  change(&parameters);
  return test::refusalOf<std::invalid_argument>([&] { validate(parameters); });
}

TEST(AgentParameters, DefaultsAreValid) { EXPECT_NO_THROW(validate(AgentParameters{})); }

TEST(AgentParameters, NamesTheParameterThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::pair<const char*, std::function<void(AgentParameters*)>> wrong[] = {
      {"step/length", [](AgentParameters* p) { p->step.length = 0.0; }},
      {"step/length", [&](AgentParameters* p) { p->step.length = nan; }},
      {"step/turn", [](AgentParameters* p) { p->step.turn = -1.0; }},
      {"step/stall", [](AgentParameters* p) { p->step.stall = p->step.period; }},
      {"shield/footprint_radius", [&](AgentParameters* p) { p->shield.footprint_radius = infinity; }},
      {"shield/tight_clearance", [](AgentParameters* p) { p->shield.tight_clearance = -0.01; }},
      {"shield/clearance", [](AgentParameters* p) { p->shield.clearance = 0.02; }},
      {"shield/shortest_step", [](AgentParameters* p) { p->shield.shortest_step = 0.5; }},
      {"shield/reach", [](AgentParameters* p) { p->shield.reach = 0.6; }},
      {"memory/resolution", [](AgentParameters* p) { p->memory.resolution = 0.0; }},
      {"memory/resolution", [](AgentParameters* p) { p->memory.resolution = 0.3 * p->shield.footprint_radius; }},
      {"memory/width", [](AgentParameters* p) { p->memory.width = 3.9; }},
      {"memory/width", [](AgentParameters* p) { p->memory.width = 2001.0 * p->memory.resolution; }},
      {"memory/width", [&](AgentParameters* p) { p->memory.width = nan; }},
      {"memory/reach", [](AgentParameters* p) { p->memory.reach = 0.0; }},
      {"memory/comfort", [](AgentParameters* p) { p->memory.comfort = -0.01; }},
      {"memory/tightness", [](AgentParameters* p) { p->memory.tightness = 0.9; }},
      {"escape/last_resort", [](AgentParameters* p) { p->escape.last_resort = 0.5; }},
      {"goal_drift", [](AgentParameters* p) { p->goal_drift = -0.01; }},
      {"goal_drift", [](AgentParameters* p) { p->goal_drift = 1.0; }},
      {"escape/patience_steps", [](AgentParameters* p) { p->escape.patience_steps = 0; }},
      {"escape/probe_angle", [](AgentParameters* p) { p->escape.probe_angle = 1.0; }},
      {"escape/wall_turn", [](AgentParameters* p) { p->escape.wall_turn = 3.2; }},
      {"goal_tolerance", [](AgentParameters* p) { p->goal_tolerance = 0.0; }},
      {"goal_in_sight", [](AgentParameters* p) { p->goal_in_sight = -1.0; }},
  };
  for (const auto& [name, change] : wrong) {
    EXPECT_EQ(complaintAbout(change).find(std::string("parameter ") + name + " is "), 0u)
        << name << ": " << complaintAbout(change);
  }
}

TEST(AgentParameters, NameTheirLeaders) {
  for (const Leader leader : {Leader::kNetwork, Leader::kRoute, Leader::kGreedy}) {
    EXPECT_EQ(leaderNamed(nameOfLeader(leader)), leader);
  }
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { leaderNamed("lstm"); }),
            "leader is 'lstm', expected network, route or none");
}

TEST(AgentParameters, ARouteCannotLeadWhereNothingIsRemembered) {
  EXPECT_NE(complaintAbout([](AgentParameters* p) {
              p->leader = Leader::kRoute;
              p->memory.enabled = false;
            }).find("leader is route"),
            std::string::npos);
}

TEST(AgentParameters, TakesTheLimitsOfTheMemory) {
  EXPECT_EQ(complaintAbout([](AgentParameters* p) {
              p->memory.resolution = 0.29 * p->shield.footprint_radius;
              p->memory.width = 4.0;
              p->memory.comfort = 0.0;
              p->memory.tightness = 1.0;
              p->escape.last_resort = 1.0;
              p->goal_drift = 0.0;
            }),
            "");
}

/// What a robot of that radius gets with everything else as shipped.
AgentParameters shippedFor(double radius) {
  AgentParameters parameters;
  parameters.shield.footprint_radius = radius;
  return fittedToFootprint(parameters);
}

TEST(AgentParameters, TheMemoryFollowsTheFootprint) {
  for (double radius = 0.09; radius < 0.51; radius += 0.01) {
    EXPECT_NO_THROW(validate(shippedFor(radius))) << radius;
  }
  const AgentParameters burger = shippedFor(0.105);
  EXPECT_NEAR(burger.memory.resolution, 0.03, 1e-9) << "0.29 * 0.105 = 0.03045, to a millimetre";
  EXPECT_NEAR(burger.memory.width, 60.0, 1e-9);
  EXPECT_NEAR(shippedFor(1.5).memory.resolution, 0.102, 1e-9) << "(1.5 + 0.12) / 16 = 0.10125";
}

/// A square around the origin, as it stands in a yaml file.
std::string squareOf(double half_width) {
  std::ostringstream text;
  const auto corner = [&](double x, double y) { text << '[' << x << ", " << y << ']'; };
  text << '[';
  corner(half_width, half_width);
  text << ", ";
  corner(half_width, -half_width);
  text << ", ";
  corner(-half_width, -half_width);
  text << ", ";
  corner(-half_width, half_width);
  text << ']';
  return text.str();
}

TEST(AgentParameters, EveryFootprintToTheMillimetreHasAMemory) {
  for (int millimetres = 20; millimetres <= 1000; ++millimetres) {
    AgentParameters parameters;
    parameters.shield.footprint_radius = millimetres / 1000.0;
    for (const std::string& footprint : {std::string(), squareOf(millimetres / 1000.0)}) {
      parameters.shield.footprint = footprint;
      const AgentParameters fitted = fittedToFootprint(parameters);
      EXPECT_NO_THROW(validate(fitted)) << millimetres << " mm " << footprint;
      const AgentParameters again = fittedToFootprint(fitted);
      EXPECT_EQ(again.memory.resolution, fitted.memory.resolution) << millimetres << " mm " << footprint;
      EXPECT_EQ(again.memory.width, fitted.memory.width) << millimetres << " mm " << footprint;
      EXPECT_EQ(again.memory.comfort, fitted.memory.comfort) << millimetres << " mm " << footprint;
    }
  }
}

TEST(AgentParameters, OnlyTheSmallestRobotsHaveLessComfort) {
  EXPECT_EQ(shippedFor(0.034).memory.comfort, MemoryParameters().comfort);
  EXPECT_NEAR(shippedFor(0.02).memory.comfort, 16.0 * 0.29 * 0.02 - 0.02, 1e-12);
  AgentParameters wished;
  wished.memory.comfort = 1.2;
  EXPECT_EQ(fittedToFootprint(wished).memory.comfort, 1.2) << "to be refused, not to be overheard";
}

TEST(AgentParameters, AMemoryThatSuitsTheFootprintStaysAsItIs) {
  const AgentParameters create2 = shippedFor(AgentParameters().shield.footprint_radius);
  EXPECT_EQ(create2.memory.resolution, MemoryParameters().resolution);
  EXPECT_EQ(create2.memory.width, MemoryParameters().width);
}

TEST(AgentParameters, AWaypointMustNotBeReachedWhereItIsChosen) {
  // Or every question would be a new step.
  EXPECT_EQ(complaintAbout([](AgentParameters* p) { p->step.reached = p->shield.shortest_step; }),
            "parameter step/reached is 0.15, expected less than shield/shortest_step = 0.15");
  EXPECT_EQ(complaintAbout([](AgentParameters* p) {
              p->step.reached = 0.1;
              p->goal_tolerance = 0.1;
            }),
            "parameter step/reached is 0.1, expected less than goal_tolerance = 0.1");
}

}  // namespace
}  // namespace lstm_planner::test_agent_parameters
