#pragma once

#include <QWidget>
#include <vector>

#include "ros/panel/drive_view.hpp"

namespace lstm_planner {

/// Draws the steering angles beside each other: the longer its bar, the more the network prefers one. Grey: the shield
/// removed it; orange: it was chosen.
class ActionBars : public QWidget {
 public:
  explicit ActionBars(QWidget* parent = nullptr);

  void setActions(const std::vector<ViewAction>& actions);
  const std::vector<ViewAction>& actions() const { return actions_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<ViewAction> actions_;
};

}  // namespace lstm_planner
