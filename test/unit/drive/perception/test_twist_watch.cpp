#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/drive/perception/twist_watch.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"

namespace lstm_planner::test_twist_watch {
namespace {

/// One message.
struct Message {
  double stamp = 0.0;
  Pose2 pose;
  Twist2 twist;
};

/// What a publisher makes of a message whose values are right.
using Publisher = std::function<void(Message*, Random*)>;

struct Case {
  const char* name;
  Publisher publish;
  double rate = 20.0;   ///< Hz
  double error = 0.15;  ///< of the speed that the poses show, relative
};
std::ostream& operator<<(std::ostream& out, const Case& tried) { return out << tried.name; }
std::string nameOf(const testing::TestParamInfo<Case>& info) { return info.param.name; }

void asItIs(Message*, Random*) {}

Publisher noisyPoses(double deviation) {
  return [deviation](Message* message, Random* random) {
    message->pose.x += deviation * normal(*random);
    message->pose.y += deviation * normal(*random);
    message->pose.yaw += deviation * normal(*random);
  };
}

Publisher lateStamps(double longest) {
  return [longest](Message* message, Random* random) { message->stamp += uniform(*random, 0.0, longest); };
}

Publisher roundedStamps(double to) {
  return [to](Message* message, Random*) { message->stamp = to * std::floor(message->stamp / to); };
}

/// A filter's delay.
Publisher delayedTwist(double seconds, double rate) {
  return [seconds, rate, filtered = Twist2{}](Message* message, Random*) mutable {
    const double share = 1.0 / (1.0 + seconds * rate);
    filtered.linear += share * (message->twist.linear - filtered.linear);
    filtered.angular += share * (message->twist.angular - filtered.angular);
    message->twist = filtered;
  };
}

/// Every so many messages; a Create 2 that counts ticks over too short a time, or none.
Publisher spikes(int every) {
  return [every, count = 0](Message* message, Random*) mutable {
    if (++count % every != 0) return;
    const double share = count / every % 2 == 0 ? 3.0 : 0.0;
    message->twist = {share * message->twist.linear, share * message->twist.angular};
  };
}

/// A Create 2, whose driver takes the speed from the ticks of so short a time, and sends it ten times a second: at some
/// speeds it catches the same number of ticks every time, which may be one more, or one less, than the wheel turns by.
Publisher ticksOver(double seconds) {
  constexpr double kTick = M_PI * 0.072 / 508.8;  // m
  constexpr double kHalfAxle = 0.1175;            // m
  return [seconds, last = Pose2{}, left = 0.0, right = 0.0](Message* message, Random*) mutable {
    const double turned = message->pose.yaw - last.yaw;
    const Pose2 halfway{last.x, last.y, last.yaw + 0.5 * turned};
    const double way = toLocalFrame(halfway, {message->pose.x, message->pose.y}).x;
    last = message->pose;
    left += way - kHalfAxle * turned;
    right += way + kHalfAxle * turned;
    const auto counted = [seconds](double travelled, double speed) {
      return kTick * (std::floor(travelled / kTick) - std::floor((travelled - speed * seconds) / kTick)) / seconds;
    };
    const double left_speed = counted(left, message->twist.linear - kHalfAxle * message->twist.angular);
    const double right_speed = counted(right, message->twist.linear + kHalfAxle * message->twist.angular);
    message->twist = {0.5 * (left_speed + right_speed), 0.5 * (right_speed - left_speed) / kHalfAxle};
  };
}

/// A localisation that corrects the poses every five seconds.
Publisher jumps(double length) {
  return [length, next = 5.0, offset = Pose2{}](Message* message, Random* random) mutable {
    if (message->stamp > next) {
      next += 5.0;
      offset = {uniform(*random, -length, length), uniform(*random, -length, length), uniform(*random, -0.1, 0.1)};
    }
    message->pose = compose(offset, message->pose);
  };
}

const Case kRight[] = {{"Exact", asItIs},
                       {"TwiceASecond", asItIs, 2.0},
                       {"AHundredASecond", asItIs, 100.0},
                       {"NoisyPoses", noisyPoses(0.005)},
                       {"VeryNoisyPoses", noisyPoses(0.02)},
                       {"LateStamps", lateStamps(0.03)},
                       {"LateStampsOfAFastOdometry", lateStamps(0.03), 100.0},
                       {"RoundedStamps", roundedStamps(0.1)},
                       {"RoundedStampsOfAFastOdometry", roundedStamps(0.05), 100.0},
                       {"DelayedTwist", delayedTwist(0.2, 20.0)},
                       {"Spikes", spikes(10)},
                       {"TicksOfAShortTime", ticksOver(0.015), 10.0},
                       {"Jumps", jumps(0.1)},
                       {"Jumps2", jumps(0.2)}};

Publisher zeroAnd(const Publisher& publish) {
  return [publish](Message* message, Random* random) {
    message->twist = {};
    publish(message, random);
  };
}

const Case kWrong[] = {
    {"Zero", zeroAnd(asItIs)},
    {"ZeroTwiceASecond", zeroAnd(asItIs), 2.0},
    {"ZeroAHundredTimesASecond", zeroAnd(asItIs), 100.0},
    {"ZeroAndNoisyPoses", zeroAnd(noisyPoses(0.002))},
    {"ZeroAndLateStamps", zeroAnd(lateStamps(0.03))},
    {"ZeroAndRoundedStamps", zeroAnd(roundedStamps(0.1)), 20.0, 0.4},  // half of them say the same time
    {"ZeroAndJumps", zeroAnd(jumps(0.2))},
    {"InTheOdometryFrame", [](Message* message, Random*) { message->twist.linear *= std::cos(message->pose.yaw); }},
    {"Backwards", [](Message* message, Random*) { message->twist.linear = -message->twist.linear; }},
    {"TurningTheOtherWay", [](Message* message, Random*) { message->twist.angular = -message->twist.angular; }},
    {"InDegreesASecond", [](Message* message, Random*) { message->twist.angular *= 57.3; }},
    {"InKilometresAnHour", [](Message* message, Random*) { message->twist.linear *= 3.6; }}};

/// Stop and go, curves, turns in place: every few seconds something else, at 2 m/s^2 at most.
class Drive {
 public:
  explicit Drive(double max_speed) : max_speed_(max_speed) {}

  Message next(double seconds, Random* random) {
    constexpr double kStep = 0.01;
    for (double passed = 0.0; passed < seconds - 1e-9; passed += kStep) {
      if (message_.stamp >= change_) {
        change_ = message_.stamp + uniform(*random, 0.5, 4.0);
        const bool stands = uniform(*random) < 0.2;
        const bool turns = uniform(*random) < 0.2;
        wanted_.linear = stands || turns ? 0.0 : uniform(*random, 0.0, max_speed_);
        wanted_.angular = stands || uniform(*random) < 0.3 ? 0.0 : uniform(*random, -1.5, 1.5);
      }
      Twist2& twist = message_.twist;
      twist.linear += std::clamp(wanted_.linear - twist.linear, -2.0 * kStep, 2.0 * kStep);
      twist.angular += std::clamp(wanted_.angular - twist.angular, -8.0 * kStep, 8.0 * kStep);
      message_.pose = alongTurn(message_.pose, twist.linear * kStep, twist.angular * kStep);
      message_.stamp += kStep;
    }
    return message_;
  }

 private:
  double max_speed_;
  double change_ = 0.0;
  Twist2 wanted_;
  Message message_;
};

class RightTwist : public testing::TestWithParam<Case> {};

TEST_P(RightTwist, IsNeverDoubtedInAnHour) {
  Random random(1);
  for (const double speed : {0.3, 2.0}) {
    TwistWatch watch;
    Drive drive(speed);
    Publisher publish = GetParam().publish;
    Message message;
    while (message.stamp < 3600.0 && !watch.contradiction()) {
      message = drive.next(1.0 / GetParam().rate, &random);
      Message published = message;
      publish(&published, &random);
      watch.note(published.stamp, published.pose, published.twist);
    }
    EXPECT_FALSE(watch.contradiction()) << speed << " m/s, after " << message.stamp << " s";
  }
}
INSTANTIATE_TEST_SUITE_P(Publishers, RightTwist, testing::ValuesIn(kRight), &nameOf);

class WrongTwist : public testing::TestWithParam<Case> {};

TEST_P(WrongTwist, IsNoticedSoonAndWhatThePosesShowIsUsed) {
  Random random(1);
  TwistWatch watch;
  Drive drive(0.3);
  Publisher publish = GetParam().publish;
  Message message;
  const auto pass = [&] {
    message = drive.next(1.0 / GetParam().rate, &random);
    Message published = message;
    publish(&published, &random);
    watch.note(published.stamp, published.pose, published.twist);
  };
  while (message.stamp < 10.0) pass();
  ASSERT_TRUE(watch.contradiction());
  double errors = 0.0;
  double speeds = 0.0;
  while (message.stamp < 600.0) {
    pass();
    errors += std::abs(watch.twist().linear - message.twist.linear);
    speeds += message.twist.linear;
  }
  // The drive changes its speed every two seconds; a mean over the last 0.3 s is wrong by 0.15 then.
  EXPECT_LT(errors, GetParam().error * speeds);
}
INSTANTIATE_TEST_SUITE_P(Publishers, WrongTwist, testing::ValuesIn(kWrong), &nameOf);

/// A robot that drives along a line, round a corner and on, by what it hears of its odometry every 0.05 s.
class Course {
 public:
  explicit Course(const Publisher& publish) : publish_(publish) {
    for (int i = 0; i <= 60; ++i) plan_.push_back({0.05 * i, 0.0, 0.0});
    for (int i = 1; i <= 400; ++i) plan_.push_back({3.0, 0.05 * i, M_PI_2});
  }

  /// Mean speed, m/s.
  double drive(double seconds) {
    const double before = robot_.pathLength();
    for (double passed = 0.0; passed < seconds - 1e-9; passed += kPeriod) {
      Message message{robot_.time(), robot_.odometry(), robot_.measuredTwist()};
      publish_(&message, &random_);
      watch_.note(message.stamp, message.pose, message.twist);
      Situation situation;
      situation.time = robot_.time();
      situation.pose = robot_.odometry();
      robot_.command(tracker_.compute({plan_, situation.pose, watch_.twist(), shield_, kPeriod}, situation));
      robot_.advance(kPeriod);
    }
    return (robot_.pathLength() - before) / seconds;
  }

 private:
  static constexpr double kPeriod = 0.05;  // s

  Publisher publish_;
  std::vector<Pose2> plan_;
  CircleWorld nothing_{{}};
  SimulatedRobot robot_{nothing_, {}, {}, 1};
  PathTracker tracker_{MotionParameters()};
  Shield shield_{Footprint(0.174), 0.03, 2.0};
  TwistWatch watch_;
  Random random_{1};
};

class DriveWithRightTwist : public testing::TestWithParam<Case> {};

/// But for what a robot does that believes a delay, or a spike.
TEST_P(DriveWithRightTwist, IsAsFastAsWithoutAWatch) {
  const double exact = Course(asItIs).drive(30.0);
  EXPECT_GT(exact, 0.27) << "max_linear is 0.3 m/s";
  EXPECT_GE(Course(GetParam().publish).drive(30.0), 0.95 * exact);
}
INSTANTIATE_TEST_SUITE_P(Publishers, DriveWithRightTwist, testing::ValuesIn(kRight), &nameOf);

class DriveWithWrongTwist : public testing::TestWithParam<Case> {};

TEST_P(DriveWithWrongTwist, IsAsFastAsWithARightOneAsSoonAsThatIsNoticed) {
  Course right(asItIs);
  Course wrong(GetParam().publish);
  right.drive(20.0);
  wrong.drive(20.0);
  EXPECT_GE(wrong.drive(20.0), 0.95 * right.drive(20.0));
}
INSTANTIATE_TEST_SUITE_P(Publishers, DriveWithWrongTwist, testing::ValuesIn(kWrong), &nameOf);

TEST(TwistWatch, SaysWhatWasSaidAndWhatWasShown) {
  TwistWatch watch;
  for (int i = 0; i < 100; ++i) watch.note(0.05 * i, alongTurn({}, 0.01 * i, 0.02 * i), {});
  ASSERT_TRUE(watch.contradiction());
  EXPECT_EQ(watch.contradiction()->said.linear, 0.0);
  EXPECT_NEAR(watch.contradiction()->shown.linear, 0.2, 1e-3);
  EXPECT_NEAR(watch.contradiction()->shown.angular, 0.4, 1e-6);
  EXPECT_NEAR(watch.twist().linear, 0.2, 1e-3);
  EXPECT_NEAR(watch.twist().angular, 0.4, 1e-6);
}

TEST(TwistWatch, KeepsWhatItKnowsWhenTheOdometryJumps) {
  OdometryHistory history(1.0);
  for (int i = 0; i < 100; ++i) history.add({0.05 * i, {0.01 * i, 0.0, 0.0}, {}});
  ASSERT_TRUE(history.twistWatch().contradiction());
  history.add({5.0, {100.0, 0.0, 0.0}, {}});
  EXPECT_EQ(history.jumps(), 1);
  EXPECT_NEAR(history.twist().linear, 0.2, 1e-3) << "until there are poses again";
  for (int i = 1; i < 10; ++i) history.add({5.0 + 0.05 * i, {100.0 + 0.005 * i, 0.0, 0.0}, {}});
  EXPECT_NEAR(history.twist().linear, 0.1, 1e-3);
}

}  // namespace
}  // namespace lstm_planner::test_twist_watch
