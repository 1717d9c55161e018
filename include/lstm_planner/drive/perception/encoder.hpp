#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/drive/perception/network_inputs.hpp"
#include "lstm_planner/drive/perception/observation.hpp"
#include "lstm_planner/network/metadata_reader.hpp"

namespace lstm_planner {

/// Everything needed to turn an Observation into the network's input; it travels in the model file's metadata.
struct EncoderParameters {
  /// Names of the inputs (networkInputs()) in their order.
  std::vector<std::string> input_layout = inputsOfGroup("thesis");
  double angle_span = M_PI;      ///< rad, centred on the heading
  double range_cap = 6.0;        ///< m; sectors are encoded as range / range_cap
  double distance_scale = 5.0;   ///< m; the goal distance d is encoded as d / (d + distance_scale), in [0, 1)
  double angle_scale = M_PI;     ///< rad; bearing and heading are encoded as angle / angle_scale
  double action_scale = M_PI_2;  ///< rad; the previous action is encoded as angle / action_scale
  double position_cell = 0.0;    ///< m; see observe(); 0 = odometry as it is
  double heading_cell = 0.0;     ///< rad; the heading is rounded to a multiple, and the goal's bearing is from there
  double event_range = 1.0;      ///< m; a sector with less is an event

  /// 1: one network with an output an action, and everything relative to the heading. 8: the same network, with one
  /// output, looks into each of eight directions in turn, everything turned such that it lies ahead; see
  /// Encoder::turn().
  int views = 1;
};

constexpr int kDriveViews = 8;

/// How far apart views lie, rad.
constexpr double kViewAngle = 2.0 * M_PI / kDriveViews;

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const EncoderParameters& parameters);

/// To and from the metadata of a model file (keys: input_layout, sector_count, angle_span, range_cap, distance_scale,
/// angle_scale, action_scale, position_cell, heading_cell where it is not 0, event_range where there are events, views
/// where there are eight). The reader notes what is missing or malformed.
void writeMetadata(const EncoderParameters& parameters, std::map<std::string, std::string>* metadata);
EncoderParameters readEncoderParameters(MetadataReader* metadata);

/// The eighth of a turn, 0 .. 7, that is nearest to an angle (rad).
int viewNearest(double angle);

/// What the other views need of an observation in addition to its encoding.
struct ViewBearings {
  int ahead = 0;                 ///< the direction in the odometry frame, in eighths of a turn, nearest to the heading
  double goal = 0.0;             ///< rad, relative to the heading
  double previous_action = 0.0;  ///< rad, relative to the heading as it is now
  Point2 goal_direction;         ///< of length 1, from `goal`
  Point2 previous_direction;     ///< of length 1, from `previous_action`
  Point2 motion;                 ///< m, since the step before, in the robot's frame as it is now
};

ViewBearings bearingsOf(const Observation& observation);

/// Encodes observations. Every output is finite for a finite observation. Copies share their parameters.
class Encoder {
 public:
  explicit Encoder(const EncoderParameters& parameters);  ///< throws as validate()
  explicit Encoder(std::shared_ptr<const EncoderParameters> parameters);
  const EncoderParameters& parameters() const { return *parameters_; }
  int size() const { return static_cast<int>(parameters_->input_layout.size()); }

  /// Fills `input`, which must have size() values. With eight views it is that of the view ahead: the heading is 0,
  /// and the previous action and the motion are relative to the heading as it is now.
  void encode(const Observation& observation, Eigen::Ref<Eigen::VectorXf> input) const;

  /// With eight views: what is seen in each direction, from what encode() gave of the same observation. Value i of the
  /// view into direction d of the odometry frame, in eighths of a turn, goes to inputs[i * stride + d]. How
  /// the odometry frame lies decides only which view is which. The heading is the robot's, relative to the view. No
  /// range could mean "not seen", so a sector into which the scanner does not look is 0 and its seen_ is 0: the network
  /// can learn what to make of it.
  void turn(const float* ahead, const ViewBearings& bearings, float* inputs, int stride) const;

 private:
  /// Inputs that show the same of several sectors or directions, or a single one.
  struct Group {
    const NetworkInput* input;
    std::array<std::int16_t, kDriveViews> at;  ///< where each stands in the input, -1 where it does not
  };
  void findGroups();

  std::shared_ptr<const EncoderParameters> parameters_;
  std::vector<Group> groups_;
};

}  // namespace lstm_planner
