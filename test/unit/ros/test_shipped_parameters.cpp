// The yaml files name every parameter with its default and its range, and nothing else.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"

namespace lstm_planner::test_shipped_parameters {
namespace {

/// What a yaml file says of a parameter.
struct Shipped {
  YAML::Node value;
  std::string comment;
};
using ShippedParameters = std::map<std::string, Shipped>;

void flatten(const YAML::Node& node, const std::string& prefix, ShippedParameters* parameters) {
  for (const auto& entry : node) {
    const std::string name = prefix + entry.first.as<std::string>();
    if (entry.second.IsMap()) {
      flatten(entry.second, name + "/", parameters);
    } else {
      (*parameters)[name].value = entry.second;
    }
  }
}

/// The comments behind the values, by the indentation of the lines.
void readComments(std::istream& file, const std::string& prefix, ShippedParameters* parameters) {
  const std::regex line_form(R"(( *)(\w+):([^#]*)(?:# *(.*))?)");
  std::map<std::size_t, std::string> groups;  // by indentation
  for (std::string line; std::getline(file, line);) {
    std::smatch parts;
    if (!std::regex_match(line, parts, line_form)) continue;
    const auto indentation = static_cast<std::size_t>(parts[1].length());
    groups.erase(groups.lower_bound(indentation), groups.end());
    std::string name;
    for (const auto& group : groups) name += group.second + "/";
    name += parts[2];
    groups[indentation] = parts[2];
    const auto found =
        name.compare(0, prefix.size(), prefix) == 0 ? parameters->find(name.substr(prefix.size())) : parameters->end();
    if (found != parameters->end()) found->second.comment = parts[4];
  }
}

/// `root`: the group that all are in, if there is one.
ShippedParameters readShipped(const std::string& name, const std::string& root) {
  const std::string path = std::string(LSTM_PLANNER_SOURCE_DIR) + "/config/" + name;
  const YAML::Node file = YAML::LoadFile(path);
  ShippedParameters parameters;
  flatten(root.empty() ? file : file[root], "", &parameters);
  std::ifstream text(path);
  readComments(text, root.empty() ? "" : root + "/", &parameters);
  return parameters;
}

void expectValue(const YAML::Node& node, const std::string& value) { EXPECT_EQ(node.as<std::string>(), value); }
void expectValue(const YAML::Node& node, bool value) { EXPECT_EQ(node.as<bool>(), value); }
void expectValue(const YAML::Node& node, const std::vector<double>& value) {
  EXPECT_EQ(node.as<std::vector<double>>(), value);
}
void expectValue(const YAML::Node& node, const Pose2& pose) {
  expectValue(node, std::vector<double>{pose.x, pose.y, pose.yaw});
}
void expectValue(const YAML::Node& node, const std::vector<NamedPose>& poses) { EXPECT_EQ(node.size(), poses.size()); }
template <typename Number>
std::enable_if_t<kIsNumber<Number>> expectValue(const YAML::Node& node, Number value) {
  EXPECT_EQ(node.as<double>(), static_cast<double>(value));
}

/// The comment starts with it.
void expectRange(const std::string& comment, Range range) {
  const std::regex form(R"(\[([^,\]]+), ([^\]]+)\].*)");
  std::smatch ends;
  ASSERT_TRUE(std::regex_match(comment, ends, form)) << "no range in '" << comment << "'";
  constexpr double kRounding = 1e-3;  // 3.14
  EXPECT_NEAR(std::stod(ends[1]), range.least, kRounding * std::abs(range.least));
  EXPECT_NEAR(std::stod(ends[2]), range.most, kRounding * std::abs(range.most));
}

/// `elsewhere`: parameters that are not in the file, as they depend on where the robot drives.
template <typename VisitAll>
void expectShipped(ShippedParameters shipped, const std::set<std::string>& elsewhere, const VisitAll& visit_all) {
  visit_all([&](const std::string& name, const auto& value, Range range, const char*, const char* meaning) {
    SCOPED_TRACE(name);
    EXPECT_STRNE(meaning, "");
    if (elsewhere.count(name) > 0) return;
    const auto found = shipped.find(name);
    ASSERT_NE(found, shipped.end()) << "not in the file";
    // The scanner's readings in the files are those of urg_node.
    if (name != "no_return") expectValue(found->second.value, value);
    if (range.isGiven()) expectRange(found->second.comment, range);
    shipped.erase(found);
  });
  for (const auto& rest : shipped) ADD_FAILURE() << rest.first << " is in the file, but no parameter";
}

TEST(ShippedParameters, OfThePlannerAreAllThatThereAreWithDefaultsAndRanges) {
  const GlobalPlannerParameters defaults;
  expectShipped(readShipped("lstm_planner.yaml", "LstmGlobalPlanner"), {},
                [&](const auto& visit) { visitGlobalPlannerParameters(defaults, visit); });
}

TEST(ShippedParameters, OfTheControllerAreAllThatThereAreWithDefaultsAndRanges) {
  const SteeringControllerParameters defaults;
  expectShipped(readShipped("steering_controller.yaml", "SteeringController"), {},
                [&](const auto& visit) { visitSteeringControllerParameters(defaults, visit); });
}

TEST(ShippedParameters, OfTheRecorderAreAllThatThereAreWithDefaultsAndRanges) {
  const RecorderNodeParameters defaults;
  expectShipped(readShipped("dataset_recorder.yaml", ""), {},
                [&](const auto& visit) { visitRecorderNodeParameters(defaults, visit); });
}

TEST(ShippedParameters, OfTheStubAreAllThatThereAreWithDefaultsAndRanges) {
  const Create2StubParameters defaults;
  expectShipped(readShipped("create2_stub.yaml", ""), {"map", "circles", "start"},
                [&](const auto& visit) { visitCreate2StubParameters(defaults, visit); });
}

TEST(ShippedParameters, OfTheScriptedDriverAreAllThatThereAreWithDefaultsAndRanges) {
  const TeleoperatorParameters defaults;
  expectShipped(readShipped("scripted_teleoperator.yaml", ""), {"map"},
                [&](const auto& visit) { visitTeleoperatorParameters(defaults, visit); });
}

}  // namespace
}  // namespace lstm_planner::test_shipped_parameters
