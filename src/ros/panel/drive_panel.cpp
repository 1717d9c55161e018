#include "ros/panel/drive_panel.hpp"

#include <ros/exceptions.h>
#include <ros/names.h>
#include <ros/service.h>
#include <ros/time.h>
#include <rviz/config.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QHBoxLayout>
#include <QTimer>
#include <QVBoxLayout>
#include <chrono>
#include <pluginlib/class_list_macros.hpp>

PLUGINLIB_EXPORT_CLASS(lstm_planner::DrivePanel, rviz::Panel)

namespace lstm_planner {
namespace {

constexpr int kRefreshPeriod = 200;  // ms
constexpr int kLeastHeight = 420;    // pixels, for two lines of Planner, This step and Controller each
constexpr int kQueue = 10;

double now() { return ros::SteadyTime::now().toSec(); }

Report reportOf(const diagnostic_msgs::DiagnosticStatus& status) {
  Report report{status.level, status.message, {}};
  for (const auto& entry : status.values) report.values[entry.key] = entry.value;
  return report;
}

void showLine(const ViewLine& line, QLabel* label) {
  constexpr const char* kStyles[] = {"", "color: #b06000", "color: #c00000"};
  label->setText(QString::fromStdString(line.text));
  label->setStyleSheet(kStyles[line.level <= 0 ? 0 : line.level == 1 ? 1 : 2]);
}

template <typename Service>
std::string answerOf(const std::string& name, Service service) {
  if (!ros::service::call(name, service)) return "no answer from the service " + name;
  return service.response.message;
}

std::string askToPause(const std::string& name, bool pause) {
  std_srvs::SetBool service;
  service.request.data = static_cast<unsigned char>(pause);
  return answerOf(name, service);
}

}  // namespace

DrivePanel::DrivePanel(QWidget* parent) : rviz::Panel(parent) {
  auto* rows = new QVBoxLayout(this);
  auto* above = new QFormLayout;
  auto* below = new QFormLayout;
  auto* buttons = new QHBoxLayout;
  namespace_edit_ = new QLineEdit;
  namespace_edit_->setObjectName("namespace");
  namespace_edit_->setPlaceholderText("rviz's own");
  above->addRow("Namespace", namespace_edit_);
  model_ = addLine("Model", "model", above);
  goal_ = addLine("Goal", "goal", above);
  leader_ = addLine("Planner", "planner", above);
  decided_ = addLine("This step", "decided", above);
  bars_ = new ActionBars;
  removed_ = addLine("Shield removed", "removed", below);
  robot_ = addLine("Controller", "controller", below);
  recording_ = addLine("Recorder", "recorder", below);
  for (auto [button, text, name] :
       {std::make_tuple(&pause_, "Pause", "pause"), std::make_tuple(&discard_, "Discard episode", "discard_episode"),
        std::make_tuple(&finish_, "Finish", "finish")}) {
    *button = new QPushButton(text);
    (*button)->setObjectName(name);
    buttons->addWidget(*button);
    connect(*button, &QPushButton::clicked, this, [this, service = std::string(name)] { call(service); });
  }
  said_ = new QLabel;
  said_->setObjectName("said");
  said_->setWordWrap(true);
  rows->addLayout(above);
  rows->addWidget(bars_);
  rows->addLayout(below);
  rows->addLayout(buttons);
  rows->addWidget(said_);
  rows->addStretch();
  setMinimumHeight(kLeastHeight);  // lines that wrap would be cut otherwise

  connect(namespace_edit_, &QLineEdit::editingFinished, this, [this] {
    if (namespace_edit_->text() == namespace_) return;
    namespace_ = namespace_edit_->text();
    subscribe();
    Q_EMIT configChanged();
  });
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] { refresh(); });
  timer->start(kRefreshPeriod);
}

DrivePanel::~DrivePanel() = default;

QLabel* DrivePanel::addLine(const QString& title, const char* name, QFormLayout* form) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  form->addRow(title, label);
  return label;
}

void DrivePanel::onInitialize() { subscribe(); }

void DrivePanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  config.mapGetString("Namespace", &namespace_);
  config.mapGetString("Planner", &planner_);
  config.mapGetString("Controller", &controller_);
  config.mapGetString("Recorder", &recorder_);
  namespace_edit_->setText(namespace_);
  subscribe();
}

void DrivePanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Namespace", namespace_);
  config.mapSetValue("Planner", planner_);
  config.mapSetValue("Controller", controller_);
  config.mapSetValue("Recorder", recorder_);
}

void DrivePanel::subscribe() {
  view_ = DriveView();
  said_->clear();
  // Where the new name is refused, the buttons must not go on to another robot.
  for (ros::Subscriber* each :
       {&decision_subscriber_, &planner_subscriber_, &controller_subscriber_, &diagnostics_subscriber_}) {
    each->shutdown();
  }
  try {
    subscribeIn(namespace_.toStdString());
  } catch (const ros::InvalidNameException& error) {
    said_->setText(error.what());
  }
}

void DrivePanel::subscribeIn(const std::string& name_space) {
  node_ = ros::NodeHandle(name_space);
  recorder_node_ = node_.resolveName(recorder_.toStdString());
  using diagnostic_msgs::DiagnosticArray;
  using diagnostic_msgs::DiagnosticStatus;
  const std::string planner = planner_.toStdString();
  decision_subscriber_ =
      node_.subscribe<DiagnosticArray>(planner + "/decision", kQueue, [this](const DiagnosticArray::ConstPtr& message) {
        if (!message->status.empty()) view_.hearDecision(reportOf(message->status.front()), now());
      });
  planner_subscriber_ = node_.subscribe<DiagnosticStatus>(
      planner + "/status", kQueue,
      [this](const DiagnosticStatus::ConstPtr& message) { view_.setPlanner(reportOf(*message)); });
  controller_subscriber_ = node_.subscribe<DiagnosticStatus>(
      controller_.toStdString() + "/status", kQueue,
      [this](const DiagnosticStatus::ConstPtr& message) { view_.setController(reportOf(*message)); });
  diagnostics_subscriber_ = node_.subscribe("/diagnostics", kQueue, &DrivePanel::onDiagnostics, this);
}

void DrivePanel::onDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
  const std::string name = recorder_node_.substr(1) + ": recording";
  for (const auto& status : message->status) {
    if (status.name == name) view_.hearRecorder(reportOf(status), now());
  }
}

void DrivePanel::call(const std::string& service) {
  if (answer_.valid()) return;
  const std::string name = ros::names::append(recorder_node_, service);
  // In a thread of its own: rviz goes on drawing while the recorder works.
  answer_ = std::async(std::launch::async, [name, service, pause = !view_.isPaused()] {
    return service == "pause" ? askToPause(name, pause) : answerOf(name, std_srvs::Trigger());
  });
}

void DrivePanel::takeAnswer() {
  if (!answer_.valid() || answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  said_->setText(QString::fromStdString(answer_.get()));
}

void DrivePanel::refresh() {
  takeAnswer();
  // What was latched by a node that has ended is not true any more.
  if (planner_subscriber_.getNumPublishers() == 0) view_.setPlanner({});
  if (controller_subscriber_.getNumPublishers() == 0) view_.setController({});

  model_->setText(QString::fromStdString(view_.model()));
  goal_->setText(QString::fromStdString(view_.goal(now())));
  showLine(view_.leader(now()), leader_);
  decided_->setText(QString::fromStdString(view_.decided(now())));
  bars_->setActions(view_.actions(now()));
  removed_->setText(QString::fromStdString(view_.removed(now())));
  showLine(view_.controller(), robot_);
  showLine(view_.recorder(now()), recording_);
  pause_->setText(view_.isPaused() ? "Record" : "Pause");
  for (QPushButton* button : {pause_, discard_, finish_}) {
    button->setEnabled(view_.hasRecorder(now()) && !answer_.valid());
  }
}

}  // namespace lstm_planner
