// The panel as rviz loads it, with plugins and a recorder that this test plays.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rviz/config.h>
#include <rviz/panel.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <functional>
#include <map>
#include <memory>
#include <pluginlib/class_loader.hpp>
#include <string>

#include "ros/fixtures/callback_thread.hpp"
#include "ros/fixtures/waiting.hpp"

namespace lstm_planner {
namespace {

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;

DiagnosticStatus status(const std::string& name, const std::string& message,
                        const std::map<std::string, std::string>& values = {}) {
  DiagnosticStatus status;
  status.name = name;
  status.message = message;
  for (const auto& [key, value] : values) {
    status.values.emplace_back();
    status.values.back().key = key;
    status.values.back().value = value;
  }
  return status;
}

DiagnosticArray arrayOf(const DiagnosticStatus& status) {
  DiagnosticArray array;
  array.status.push_back(status);
  return array;
}

/// What planner, controller and recorder of one robot publish and serve.
class PlayedRobot {
 public:
  explicit PlayedRobot(const std::string& name_space) : name_(name_space), node_(callbacks_.nodeHandle(name_space)) {
    decision_ = node_.advertise<DiagnosticArray>("move_base/LstmGlobalPlanner/decision", 1);
    planner_ = node_.advertise<DiagnosticStatus>("move_base/LstmGlobalPlanner/status", 1, true);
    controller_ = node_.advertise<DiagnosticStatus>("move_base/SteeringController/status", 1, true);
    diagnostics_ = node_.advertise<DiagnosticArray>("/diagnostics", 1);
    planner_.publish(status("", "the network leads: it is chosen", {{"model", "/folder/of_" + name_ + ".onnx"}}));
    controller_.publish(status("", "it drives"));
    pause_ = node_.advertiseService("dataset_recorder/pause", &PlayedRobot::pause, this);
    finish_ = node_.advertiseService("dataset_recorder/finish", &PlayedRobot::finish, this);
  }

  void publish() {
    decision_.publish(arrayOf(status("", "network",
                                     {{"leader", "network"},
                                      {"goal_distance", "3.25"},
                                      {"goal_bearing", "0.5236"},
                                      {"action", "2"},
                                      {"preferences", "1, 2, 3, 2, 1"},
                                      {"allowed", "0, 1, 1, 1, 1"},
                                      {"action_angles", "-1.5708, -0.7854, 0, 0.7854, 1.5708"}})));
    const std::string prefix = name_.empty() ? "" : name_ + "/";
    diagnostics_.publish(arrayOf(status(prefix + "dataset_recorder: recording", is_paused_ ? "paused" : "recording",
                                        {{"steps", "7"}, {"episodes", "1"}, {"paused", is_paused_ ? "yes" : "no"}})));
  }

 private:
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    is_paused_ = request.data != 0;
    response.message = is_paused_ ? "paused with 7 steps" : "recording on with 7 steps";
    return true;
  }
  bool finish(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    response.message = "7 steps are in a file";
    return true;
  }

  std::string name_;
  CallbackThread callbacks_;
  ros::NodeHandle node_;
  ros::Publisher decision_, planner_, controller_, diagnostics_;
  ros::ServiceServer pause_, finish_;
  std::atomic<bool> is_paused_{false};
};

class RvizPanel : public testing::Test {
 protected:
  RvizPanel() : panel_(loader_.createInstance("lstm_planner/DrivePanel")) {}

  void initialize() { panel_->initialize(nullptr); }

  /// True as soon as the condition holds, while the robot goes on.
  bool eventually(const std::function<bool()>& condition, double patience = 20.0) {
    return lstm_planner::eventually(condition, patience, [this] {
      robot_.publish();
      ros::spinOnce();
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    });
  }

  std::string text(const char* name) const {
    const auto* label = panel_->findChild<QLabel*>(name);
    return label == nullptr ? "there is no label " + std::string(name) : label->text().toStdString();
  }
  /// Expects that a label says that sooner or later.
  void expectText(const char* name, const std::string& expected) {
    EXPECT_TRUE(eventually([&] { return text(name) == expected; })) << name << " says: " << text(name);
  }
  QPushButton* button(const char* name) const { return panel_->findChild<QPushButton*>(name); }
  void click(const char* name) {
    ASSERT_NE(button(name), nullptr);
    EXPECT_TRUE(eventually([&] { return button(name)->isEnabled(); }));
    button(name)->click();
  }

  PlayedRobot robot_{""};
  pluginlib::ClassLoader<rviz::Panel> loader_{"rviz", "rviz::Panel"};
  boost::shared_ptr<rviz::Panel> panel_;
};

TEST_F(RvizPanel, ShowsWhatThePluginsSay) {
  initialize();
  expectText("model", "of_.onnx");
  expectText("planner", "the network leads: it is chosen");
  expectText("goal", "3.25 m, 30° left");
  expectText("removed", "90° right");
  expectText("controller", "it drives");
  expectText("recorder", "recording (steps: 7, episodes: 1)");
}

TEST_F(RvizPanel, SaysWhatIsNotThere) {
  rviz::Config config;
  config.mapSetValue("Namespace", "nobody_here");
  initialize();
  panel_->load(config);
  expectText("planner", "there is no planner");
  expectText("controller", "there is no controller");
  EXPECT_FALSE(button("pause")->isEnabled());
}

TEST_F(RvizPanel, ListensInItsNamespaceAndKeepsIt) {
  PlayedRobot other("robot2");
  initialize();
  auto* edit = panel_->findChild<QLineEdit*>("namespace");
  ASSERT_NE(edit, nullptr);
  edit->setText("robot2");
  Q_EMIT edit->editingFinished();
  expectText("model", "of_robot2.onnx");
  rviz::Config config;
  panel_->save(config);
  QString kept;
  EXPECT_TRUE(config.mapGetString("Namespace", &kept));
  EXPECT_EQ(kept, "robot2");
}

TEST_F(RvizPanel, RefusesANameThatRosDoesNotTake) {
  initialize();
  expectText("recorder", "recording (steps: 7, episodes: 1)");
  auto* edit = panel_->findChild<QLineEdit*>("namespace");
  edit->setText("two words");
  Q_EMIT edit->editingFinished();
  EXPECT_NE(text("said").find("two words"), std::string::npos) << text("said");
  EXPECT_TRUE(eventually([&] { return !button("pause")->isEnabled(); }));
  EXPECT_FALSE(eventually([&] { return button("pause")->isEnabled(); }, 1.0)) << "it would call the robot of before";
  edit->setText("");
  Q_EMIT edit->editingFinished();
  expectText("said", "");
  expectText("planner", "the network leads: it is chosen");
}

TEST_F(RvizPanel, RefusesARecorderThatRosDoesNotTake) {
  rviz::Config config;
  config.mapSetValue("Recorder", "a recorder");
  initialize();
  panel_->load(config);
  EXPECT_TRUE(eventually([&] { return !button("pause")->isEnabled(); }));
  EXPECT_FALSE(eventually([&] { return button("pause")->isEnabled(); }, 1.0));
  EXPECT_NE(text("said").find("a recorder"), std::string::npos) << text("said");
}

TEST_F(RvizPanel, ItsButtonsCallTheRecorder) {
  initialize();
  // The test before had services of the same names, which may still be on their way out.
  for (const char* service : {"/dataset_recorder/pause", "/dataset_recorder/finish"}) {
    ASSERT_TRUE(ros::service::waitForService(service, ros::Duration(10.0)));
  }
  click("pause");
  expectText("said", "paused with 7 steps");
  EXPECT_TRUE(eventually([&] { return button("pause")->text() == "Record"; }));
  click("pause");
  expectText("said", "recording on with 7 steps");
  click("finish");
  expectText("said", "7 steps are in a file");
  click("discard_episode");  // this recorder does not have it
  EXPECT_TRUE(eventually([&] { return text("said").find("no answer from the service") == 0; })) << text("said");
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rviz_panel");
  const ros::NodeHandle node;  // keeps ROS up between the tests
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
