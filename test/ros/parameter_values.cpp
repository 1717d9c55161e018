// Whatever YAML makes of a value that can be meant is accepted: 1 is a number, 1e-3 (a text for YAML) too, and a number
// or a list is a text.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/ros/advice/drive_advice.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"
#include "lstm_planner/ros/move_base/standalone_move_base_parameters.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/ros/replay/bag_replay.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::parameter_values {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue listOf(const std::vector<XmlRpcValue>& entries) {
  XmlRpcValue list;
  list.setSize(static_cast<int>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) list[static_cast<int>(i)] = entries[i];
  return list;
}

template <typename T>
const T& comparable(const T& value) {
  return value;
}
std::vector<double> comparable(const Pose2& pose) { return {pose.x, pose.y, pose.yaw}; }

/// A visitor that sets each parameter in the forms that it may have, and expects them to be read.
class EveryForm {
 public:
  EveryForm(const ros::NodeHandle& node, int* count) : node_(node), count_(*count) {}

  template <typename T>
  void operator()(const std::string& name, const T& value, Range range, const char*, const char*) const {
    SCOPED_TRACE(name);
    ++count_;
    expectForms(name, value, range);
    node_.deleteParam(name);
  }

 private:
  template <typename T>
  void expect(const std::string& name, const XmlRpcValue& set, const T& value) const {
    node_.setParam(name, set);
    T read{};
    EXPECT_NO_THROW(ParameterReader(node_).read(name, &read));
    EXPECT_EQ(comparable(read), comparable(value)) << set;
  }

  void expectForms(const std::string& name, double value, Range range) const {
    if (!range.isGiven() || std::ceil(range.least) <= range.most) {
      const int whole = range.isGiven() ? static_cast<int>(std::ceil(range.least)) : 7;
      expect(name, whole, static_cast<double>(whole));
    }
    std::ostringstream exponent;
    exponent.precision(17);
    exponent << std::scientific << value;
    expect(name, exponent.str(), value);
    expect(name, value, value);
  }
  void expectForms(const std::string& name, int value, Range) const {
    expect(name, value, value);
    expect(name, static_cast<double>(value), value);
    expect(name, std::to_string(value), value);
  }
  void expectForms(const std::string& name, std::uint64_t seed, Range) const {
    expect(name, static_cast<int>(seed), seed);
    expect(name, static_cast<double>(seed), seed);
  }
  void expectForms(const std::string& name, bool value, Range) const {
    expect(name, value, value);
    expect(name, std::string(value ? "true" : "false"), value);
  }
  void expectForms(const std::string& name, const std::string& value, Range) const {
    expect(name, value, value);
    expect(name, 65, std::string("65"));
    expect(name, 65.53, std::string("65.53"));
    expect(name, listOf({"nan", 65.53, 1}), std::string("[nan, 65.53, 1]"));
    expect(name, listOf({listOf({1, -0.205}), listOf({0.3, 2})}), std::string("[[1, -0.205], [0.3, 2]]"));
  }
  void expectForms(const std::string& name, const std::vector<double>&, Range) const {
    const std::vector<double> numbers = {-1.5, 0.0, 2.0};
    expect(name, listOf({-1.5, 0, "2e0"}), numbers);
    expect(name, "-1.5 0 2", numbers);
  }
  void expectForms(const std::string& name, const Pose2&, Range) const {
    const Pose2 pose{1.0, -2.0, 0.5};
    expect(name, listOf({1, -2.0, "5e-1"}), pose);
    expect(name, "1 -2 5e-1", pose);
    XmlRpcValue group;
    group["x"] = 1.0;
    group["y"] = "-2";
    group["yaw"] = 0.5;
    expect(name, group, pose);
  }
  void expectForms(const std::string& name, const std::vector<NamedPose>&, Range) const {
    XmlRpcValue named;
    named["x"] = 1;
    named["y"] = 2;
    named["name"] = 7;
    node_.setParam(name, listOf({listOf({1, 2}), named}));
    std::vector<NamedPose> read;
    EXPECT_NO_THROW(ParameterReader(node_).read(name, &read));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(comparable(read[0].pose), comparable(read[1].pose));
    EXPECT_EQ(read[1].name, "7");
  }

  const ros::NodeHandle node_;
  int& count_;
};

template <typename Parameters>
const Parameters& defaults() {
  static const Parameters parameters;
  return parameters;
}

/// Whose parameters, and a call of EveryForm for each of them.
struct Owner {
  const char* name;
  void (*visit)(const EveryForm&);
};

const Owner kOwners[] = {
    {"LstmGlobalPlanner",
     [](const EveryForm& visit) { visitGlobalPlannerParameters(defaults<GlobalPlannerParameters>(), visit); }},
    {"SteeringController",
     [](const EveryForm& visit) {
       visitSteeringControllerParameters(defaults<SteeringControllerParameters>(), visit);
     }},
    {"standalone_move_base",
     [](const EveryForm& visit) {
       visitStandaloneMoveBaseParameters(defaults<StandaloneMoveBaseParameters>(), visit);
     }},
    {"dataset_recorder",
     [](const EveryForm& visit) { visitRecorderNodeParameters(defaults<RecorderNodeParameters>(), visit); }},
    {"scripted_teleoperator",
     [](const EveryForm& visit) { visitTeleoperatorParameters(defaults<TeleoperatorParameters>(), visit); }},
    {"create2_stub",
     [](const EveryForm& visit) { visitCreate2StubParameters(defaults<Create2StubParameters>(), visit); }},
    {"demo_runner", [](const EveryForm& visit) { visitDemoParameters(defaults<DemoParameters>(), visit); }},
    {"bag_replay", [](const EveryForm& visit) { visitBagReplayParameters(defaults<BagReplayParameters>(), visit); }},
    {"drive_advice",
     [](const EveryForm& visit) { visitDriveAdviceParameters(defaults<DriveAdviceParameters>(), visit); }},
};

class ParameterValues : public testing::TestWithParam<Owner> {};

TEST_P(ParameterValues, AreReadInEveryFormThatCanBeMeant) {
  int count = 0;
  GetParam().visit(EveryForm(ros::NodeHandle(std::string("~/") + GetParam().name), &count));
  EXPECT_GT(count, 3);
}

INSTANTIATE_TEST_SUITE_P(Of, ParameterValues, testing::ValuesIn(kOwners),
                         [](const auto& info) { return std::string(info.param.name); });

/// What the yaml of parameter_values.test has as no_return, and what it means.
struct NoReturn {
  const char* name;
  const char* meaning;
};

class ParameterOfReadings : public testing::TestWithParam<NoReturn> {};

TEST_P(ParameterOfReadings, IsReadAsYamlHasIt) {
  const ros::NodeHandle node(std::string("~/no_return/") + GetParam().name);
  EXPECT_EQ(noReturnText(loadSteeringControllerParameters(node).sensors.scan_rules), GetParam().meaning);
  EXPECT_EQ(noReturnText(loadGlobalPlannerParameters(node).sensors.scan_rules), GetParam().meaning);
}

INSTANTIATE_TEST_SUITE_P(NoReturn, ParameterOfReadings,
                         testing::Values(NoReturn{"number", "30"}, NoReturn{"whole_number", "65"},
                                         NoReturn{"word", "nan"}, NoReturn{"nan_of_yaml", "nan"},
                                         NoReturn{"text", "nan zero 65.53"}, NoReturn{"list", "nan zero 65.53"},
                                         NoReturn{"nothing", ""}),
                         [](const auto& info) { return std::string(info.param.name); });

template <typename T>
std::string refusalOf(const ros::NodeHandle& node, const XmlRpcValue& value) {
  node.setParam("parameter", value);
  try {
    T read{};
    ParameterReader(node).read("parameter", &read);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ParameterValues, OfAnotherKindAreRefusedWithNameValueAndWhatWasExpected) {
  const ros::NodeHandle node("~/Refused");
  const std::string name = "parameter " + node.resolveName("parameter") + " is ";
  EXPECT_EQ(refusalOf<double>(node, "fast"), name + "fast, expected a number");
  EXPECT_EQ(refusalOf<double>(node, "0.3 m/s"), name + "0.3 m/s, expected a number");
  EXPECT_EQ(refusalOf<double>(node, "5 -"), name + "5 -, expected a number");
  EXPECT_EQ(refusalOf<double>(node, "1e999"), name + "1e999, expected a number");
  EXPECT_EQ(refusalOf<std::vector<double>>(node, "1 2 3e"), name + "1 2 3e, expected a list of numbers");
  EXPECT_EQ(refusalOf<int>(node, 2.5), name + "2.5, expected a whole number");
  EXPECT_EQ(refusalOf<bool>(node, "maybe"), name + "maybe, expected true or false");
  EXPECT_EQ(refusalOf<std::vector<NamedPose>>(node, "[[1, 2]]"),
            name + "[[1, 2]], expected a list of poses, set by a yaml or rosparam: behind _parameter:= it is a text");
  EXPECT_EQ(refusalOf<std::string>(node, true), name + "1, expected a text, a number or a list of them");
}

const RosProgram program("parameter_values", &runTests);

}  // namespace
}  // namespace lstm_planner::parameter_values
