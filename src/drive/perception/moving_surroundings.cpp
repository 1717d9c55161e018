#include "lstm_planner/drive/perception/moving_surroundings.hpp"

namespace lstm_planner {

MovingSurroundings::MovingSurroundings(const MovingReturnsParameters& parameters) : parameters_(parameters) {
  eyes_.emplace_back(parameters_);
}

void MovingSurroundings::expectSpeed(double fastest) {
  fastest_ = fastest;
  for (Eye& eye : eyes_) eye.returns.expectSpeed(fastest);
}

void MovingSurroundings::show(const Situation& situation) {
  while (eyes_.size() < 1 + situation.second.size()) {
    eyes_.emplace_back(parameters_);
    eyes_.back().returns.expectSpeed(fastest_);
  }
  eyes_.front().returns.show(situation.profile, situation.pose, situation.time);
  for (std::size_t i = 0; i < situation.second.size(); ++i) {
    // The profile is that of the situation's pose, so its time counts, too: the robot moves from one to the next.
    eyes_[i + 1].returns.show(situation.second[i].profile, situation.pose, situation.time);
  }
  collect();
}

void MovingSurroundings::collect() {
  points_.clear();
  resting_.clear();
  for (const Eye& eye : eyes_) {
    points_.insert(points_.end(), eye.returns.points().begin(), eye.returns.points().end());
    resting_.insert(resting_.end(), eye.returns.resting().begin(), eye.returns.resting().end());
  }
}

std::vector<MovingThing> MovingSurroundings::follow(const Situation& situation) {
  std::vector<MovingThing> things;
  for (std::size_t i = 0; i < 1 + situation.second.size(); ++i) {
    Eye& eye = eyes_[i];
    const double time = i == 0 ? situation.time : situation.second[i - 1].time;
    eye.things.show(eye.returns.returns(), eye.returns.moves(), time);
    for (MovingThing thing : eye.things.around(situation.pose)) {
      const double since = situation.time - time;
      thing.center.x += since * thing.velocity.x;
      thing.center.y += since * thing.velocity.y;
      things.push_back(thing);
    }
  }
  return things;
}

void MovingSurroundings::reset() {
  for (Eye& eye : eyes_) {
    eye.returns.reset();
    eye.things.reset();
  }
  collect();
}

}  // namespace lstm_planner
