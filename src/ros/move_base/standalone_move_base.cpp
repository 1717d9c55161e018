#include "ros/move_base/standalone_move_base.hpp"

#include "ros/move_base/standalone_move_base_goal_server.hpp"

namespace lstm_planner {

StandaloneMoveBase::StandaloneMoveBase(tf2_ros::Buffer& tf) : goal_server_(std::make_unique<GoalServer>(tf)) {}

StandaloneMoveBase::~StandaloneMoveBase() = default;

}  // namespace lstm_planner
