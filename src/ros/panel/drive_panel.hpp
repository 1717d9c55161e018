#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rviz/panel.h>

#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QString>
#include <future>
#include <string>

#include "ros/panel/action_bars.hpp"
#include "ros/panel/drive_view.hpp"

namespace lstm_planner {

/// A panel of rviz: what the planner knows and decides, why the robot stands, and a recording's buttons.
///
/// All names are relative to its property Namespace, and that to rviz's own namespace. Which planner, controller and
/// recorder is in rviz's configuration: Planner, Controller, Recorder.
class DrivePanel : public rviz::Panel {
 public:
  explicit DrivePanel(QWidget* parent = nullptr);
  ~DrivePanel() override;

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  QLabel* addLine(const QString& title, const char* name, QFormLayout* form);
  void subscribe();
  void subscribeIn(const std::string& name_space);
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message);
  void call(const std::string& service);
  void takeAnswer();
  void refresh();

  // Names of nodes and plugins, relative to namespace_.
  QString namespace_;
  QString planner_ = "move_base/LstmGlobalPlanner";
  QString controller_ = "move_base/SteeringController";
  QString recorder_ = "dataset_recorder";

  DriveView view_;
  ros::NodeHandle node_;
  std::string recorder_node_;  ///< its whole name
  ros::Subscriber decision_subscriber_;
  ros::Subscriber planner_subscriber_;
  ros::Subscriber controller_subscriber_;
  ros::Subscriber diagnostics_subscriber_;
  std::future<std::string> answer_;  ///< of the recorder

  QLineEdit* namespace_edit_;
  QLabel* model_;
  QLabel* goal_;
  QLabel* leader_;
  QLabel* decided_;
  ActionBars* bars_;
  QLabel* removed_;
  QLabel* robot_;
  QLabel* recording_;
  QPushButton* pause_;
  QPushButton* discard_;
  QPushButton* finish_;
  QLabel* said_;  ///< by the recorder
};

}  // namespace lstm_planner
