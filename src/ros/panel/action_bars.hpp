#pragma once

#include <QPainter>
#include <QWidget>
#include <vector>

#include "ros/panel/drive_view.hpp"

namespace lstm_planner {

/// Draws the steering angles beside each other: the longer its bar, the more the network prefers one. Grey: the shield
/// removed it; orange: it was chosen.
class ActionBars : public QWidget {
 public:
  explicit ActionBars(QWidget* parent = nullptr) : QWidget(parent) { setFixedHeight(kHeight); }

  void setActions(const std::vector<ViewAction>& actions) {
    actions_ = actions;
    update();
  }
  const std::vector<ViewAction>& actions() const { return actions_; }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    const int longest = height() - kTextHeight;
    if (actions_.empty()) {
      painter.drawText(rect(), Qt::AlignCenter, QString::fromUtf8("the network is not asked"));
      return;
    }
    const int count = static_cast<int>(actions_.size());
    for (int i = 0; i < count; ++i) {
      const ViewAction& action = actions_[static_cast<std::size_t>(i)];
      const int left = width() * i / count;
      const int right = width() * (i + 1) / count;
      const int length = static_cast<int>(longest * (kShortest + (1.0 - kShortest) * action.share));
      const int gap = (right - left) / 6;
      painter.fillRect(left + gap, longest - length, right - left - 2 * gap, length, colorOf(action));
      painter.drawText(QRect(left, longest, right - left, kTextHeight), Qt::AlignCenter,
                       QString::fromStdString(action.name));
    }
  }

 private:
  static constexpr int kHeight = 100;        // pixels
  static constexpr int kTextHeight = 24;     // pixels
  static constexpr double kShortest = 0.06;  // of the longest bar: the least preferred one is seen, too

  // As the arrows in the scene (MarkerPublisher).
  static QColor colorOf(const ViewAction& action) {
    if (action.removed) return QColor(128, 128, 128);
    return action.chosen ? QColor(255, 140, 0) : QColor(25, 102, 230);
  }

  std::vector<ViewAction> actions_;
};

}  // namespace lstm_planner
