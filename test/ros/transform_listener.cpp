// Transforms that would make tf throw, or forget all others. The clock stands still unless a test moves it.

#include "lstm_planner/ros/common/transform_listener.hpp"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <limits>
#include <string>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/fixtures/fake_robot.hpp"
#include "ros/fixtures/log_listener.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::transform_listener {
namespace {

class TransformListenerTest : public testing::Test {
 protected:
  TransformListenerTest() : publisher_(node_.advertise<tf2_msgs::TFMessage>("/tf", 10)) {
    ros::Time::setNow(ros::Time(1000.0));
    EXPECT_TRUE(eventually([&] { return publisher_.getNumSubscribers() > 0; }));
  }

  static geometry_msgs::TransformStamped transformAt(double x, const ros::Time& stamp) {
    return toMessage({x, 0.0, 0.0}, "map", "odom", stamp);
  }
  void publish(const geometry_msgs::TransformStamped& transform) {
    tf2_msgs::TFMessage message;
    message.transforms = {transform};
    publisher_.publish(message);
  }

  /// The newest one's x; NaN when there is none.
  double newest() const {
    try {
      return buffer_.lookupTransform("map", "odom", ros::Time(0)).transform.translation.x;
    } catch (const tf2::TransformException&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  bool takes(double x, const ros::Time& stamp) {
    publish(transformAt(x, stamp));
    return eventually([&] { return newest() == x; });
  }
  bool refuses(const ros::Time& stamp, const std::string& sentence) {
    return eventually([&] {
      publish(transformAt(-1.0, stamp));
      return log_.count(sentence) > 0 && newest() != -1.0;
    });
  }

  ros::NodeHandle node_;
  LogListener log_;
  tf2_ros::Buffer buffer_;
  TransformListener listener_{&buffer_};
  ros::Publisher publisher_;
};

TEST_F(TransformListenerTest, LeavesOutTheEndOfTimeAndTakesWhatComesAfterwards) {
  const std::string sentence =
      "the transform from odom to map by /transform_listener is not used: it is stamped 4294967296.000 s, and the "
      "clock "
      "says 1000.000 s";
  EXPECT_TRUE(refuses(ros::TIME_MAX, sentence)) << "as the first one";
  EXPECT_TRUE(takes(1.0, ros::Time::now()));
  ros::Time::setNow(ros::Time(1010.0));
  EXPECT_TRUE(refuses(ros::TIME_MAX, "the clock says 1010.000 s"));
  EXPECT_TRUE(takes(2.0, ros::Time::now()));
}

TEST_F(TransformListenerTest, LeavesOutTheEndOfTimeBeforeTheClockHasCome) {
  ros::Time::setNow(ros::Time());
  publish(transformAt(-1.0, ros::TIME_MAX));
  EXPECT_TRUE(takes(1.0, ros::Time(5000.0)));
}

TEST_F(TransformListenerTest, LeavesOutWhatWouldMakeItForgetAllOthers) {
  EXPECT_TRUE(takes(1.0, ros::Time::now()));
  EXPECT_TRUE(refuses(ros::Time(1060.0), "it is stamped 1060.000 s"));
  EXPECT_TRUE(takes(2.0, ros::Time(1001.0))) << "a clock that is a little ahead";
}

TEST_F(TransformListenerTest, TakesThoseOfAPublisherWhoseClockIsAheadUntilItIsSetRight) {
  EXPECT_TRUE(takes(1.0, ros::Time(700000.0)));
  EXPECT_TRUE(takes(2.0, ros::Time(700001.0)));
  EXPECT_TRUE(takes(3.0, ros::Time(1001.0)));
  EXPECT_TRUE(log_.eventuallyHas("the transform from odom to map was stamped 700001.000 s, and is 1001.000 s now"));
}

TEST_F(TransformListenerTest, ForgetsAllWhenTheClockIsSetBack) {
  EXPECT_TRUE(takes(1.0, ros::Time::now()));
  ros::Time::setNow(ros::Time(500.0));
  EXPECT_TRUE(takes(2.0, ros::Time::now()));
  EXPECT_TRUE(log_.eventuallyHas("the clock was set back by 500.000 s: all transforms so far are forgotten"));
}

const RosProgram program("transform_listener", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::transform_listener
