#include "lstm_planner/drive/perception/moving_surroundings.hpp"

namespace lstm_planner {

void MovingSurroundings::expectSpeed(double fastest) {
  for (Eye& eye : eyes_) eye.returns.expectSpeed(fastest);
}

void MovingSurroundings::show(const Situation& situation) {
  eyes_[0].returns.show(situation.profile, situation.pose, situation.time);
  // The profile is that of the situation's pose, so its time counts, too: the robot moves from one to the next.
  eyes_[1].returns.show(situation.second.profile, situation.pose, situation.time);
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
  const std::array<double, 2> times = {situation.time, situation.second.time};
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    Eye& eye = eyes_[i];
    eye.things.show(eye.returns.returns(), eye.returns.moves(), times[i]);
    for (MovingThing thing : eye.things.around(situation.pose)) {
      const double since = situation.time - times[i];
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
