#pragma once

namespace lstm_planner {

/// Counts how often a robot starts to touch something; until it touches nothing any more, that is one contact.
class ContactCount {
 public:
  /// Whether it touches something now.
  void note(bool touches) {
    contacts_ += touches && !touching_ ? 1 : 0;
    touching_ = touches;
  }
  /// Adds a contact with something that the robot does not touch any more.
  void add() { ++contacts_; }

  bool isTouching() const { return touching_; }
  int contacts() const { return contacts_; }

 private:
  bool touching_ = false;
  int contacts_ = 0;
};

}  // namespace lstm_planner
