#include <array>
#include <stdexcept>
#include <vector>

#include "fuzz/fuzz_scan.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/small_memory.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "support/agent_steps.hpp"

namespace lstm_planner::fuzz::parameters_harness {
namespace {

constexpr std::array kLeaders{Leader::kNetwork, Leader::kRoute, Leader::kGreedy};

/// Any value for some of the parameters, the default for the others.
class ParameterChanger {
 public:
  explicit ParameterChanger(FuzzInput* input) : input_(*input) {}

  void change(AgentParameters* agent) {
    StepParameters& step = agent->step;
    ShieldParameters& shield = agent->shield;
    MemoryParameters& memory = agent->memory;
    EscapeParameters& escape = agent->escape;
    changeSome({&step.length,          &step.turn,
                &step.period,          &step.reached,
                &step.stall,           &step.still_distance,
                &step.still_turn,      &shield.footprint_radius,
                &shield.clearance,     &shield.tight_clearance,
                &shield.shortest_step, &shield.reach,
                &memory.width,         &memory.resolution,
                &memory.reach,         &memory.comfort,
                &memory.tightness,     &escape.patience_distance,
                &escape.last_resort,   &escape.progress,
                &escape.follow_step,   &escape.probe_angle,
                &escape.wall_turn,     &escape.leave_margin,
                &escape.first_leg,     &escape.loop_tolerance,
                &escape.loop_length,   &agent->goal_tolerance,
                &agent->goal_in_sight, &agent->goal_drift});
    const std::uint8_t flags = input_.byte();
    agent->leader = kLeaders.at(flags % 3);
    memory.enabled = flags < 224;
    escape.enabled = flags % 16 != 15;
    if (flags % 8 == 7) escape.patience_steps = static_cast<int>(input_.raw<std::int32_t>());
  }

  void change(MotionParameters* motion) {
    MovingReturnsParameters& moving = motion->moving;
    changeSome({&motion->max_linear,
                &motion->max_angular,
                &motion->max_wheel_speed,
                &motion->axle_length,
                &motion->linear_acceleration,
                &motion->lookahead,
                &motion->nearest_target,
                &motion->turn_in_place,
                &motion->heading_gain,
                &motion->reaction_time,
                &motion->safety_margin,
                &motion->slow_gap,
                &motion->slow_speed,
                &moving.range,
                &moving.youngest,
                &moving.oldest,
                &moving.range_margin,
                &moving.lateral_margin,
                &moving.angle_margin,
                &moving.hold,
                &motion->person_speed,
                &motion->person_margin,
                &motion->position_tolerance,
                &motion->heading_tolerance});
    if (input_.byte() % 8 == 7) moving.fewest_beams = static_cast<int>(input_.raw<std::int32_t>());
  }

  void change(RecorderParameters* recorder) {
    changeSome({&recorder->period, &recorder->min_step_distance, &recorder->min_step_turn, &recorder->max_gap,
                &recorder->max_label_error, &recorder->range_cap, &recorder->max_speed, &recorder->goal_tolerance,
                &recorder->delay});
    for (int more = input_.byte() % 4; more > 0; --more) recorder->action_angles.push_back(input_.number());
  }

 private:
  void changeSome(const std::vector<double*>& numbers) {
    for (int left = input_.byte() % 4; left > 0; --left) {
      double& number =
          *numbers[static_cast<std::size_t>(input_.integer(0, static_cast<std::int64_t>(numbers.size()) - 1))];
      number = input_.flag() ? input_.number() : number * input_.numberIn(0.0, 4.0);
    }
  }

  FuzzInput& input_;
};

LaserScan roomScan(int blocked) {
  LaserScan scan{0.0, -M_PI_2, M_PI / 63.0, 0.1, 30.0, std::vector<float>(64, 3.0f)};
  scan.ranges[static_cast<std::size_t>(blocked) % scan.ranges.size()] = 0.5f;
  return scan;
}

constexpr int kSteps = 4;

void drive(const AgentParameters& parameters) {
  NavigationAgent agent(noPolicy(), parameters);
  agent.setGoal({5.0, 2.0});
  std::vector<Pose2> plan;
  for (int step = 0; step < kSteps; ++step) {
    const Pose2 pose{0.3 * step, 0.0, 0.5 * step};
    test::perceive(&agent, roomScan(16 * step), {}, pose, 1000.0 + step);
    agent.decide();
    rollOut(agent.situation(), agent.decision(), agent.shield(), {5.0, 2.0, 0.0}, parameters, {}, &plan);
  }
}

void follow(const MotionParameters& parameters) {
  const MotionController controller(parameters);
  Shield shield(Footprint(0.17425), parameters.safety_margin, 2.0);
  MovingReturns moving(parameters.moving);
  const std::vector<Pose2> plan = {{}, {1.0, 0.0, 0.0}, {2.0, 0.5, 0.0}};
  Situation situation;
  for (int step = 0; step < kSteps; ++step) {
    perceive(roomScan(16 * step), {}, {}, 6.0, &situation);
    shield.show(situation.obstacles);
    moving.show(situation.profile, {}, 1000.0 + 0.3 * step);
    const Twist2 twist = controller.compute({plan, {}, {0.1, 0.1}, shield, 0.05}, moving.points());
    require(std::isfinite(twist.linear) && std::isfinite(twist.angular), "a command is finite");
  }
}

void record(const RecorderParameters& parameters) {
  RecordingSink sink{RecordingDescription{}};
  DriveRecorder recorder(parameters, &sink, [](const std::string&, double) { return std::optional<Pose2>(Pose2()); });
  recorder.add(GoalHeard{1000.0, {"odom", {5.0, 2.0, 0.0}}, "fuzz"});
  for (int step = 0; step <= kSteps; ++step) {
    const double stamp = 1000.0 + 0.6 * step;
    recorder.add(OdometryHeard{stamp, {0.2 * step, 0.0, 0.1 * step}, {0.3, 0.3}});
    recorder.add(ScanHeard{stamp, roomScan(16 * step), {}, "laser"});
  }
  recorder.finish();
}

/// Parameters of any value are refused with a sentence, or agent, controller and recorder work with them.
void useParameters(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const int kind = input.byte() % 3;
  ParameterChanger changer(&input);
  expectRefusal<std::invalid_argument>([&] {
    if (kind == 0) {
      MotionParameters motion;
      changer.change(&motion);
      validate(motion);
      follow(motion);
      return;
    }
    RecorderParameters recorder;
    recorder.agent.memory = smallMemory();
    changer.change(&recorder.agent);
    if (kind == 1) {
      validate(recorder.agent);
      drive(recorder.agent);
      return;
    }
    changer.change(&recorder);
    validate(recorder);
    record(recorder);
  });
}

const Registration registration("parameters", &useParameters);

}  // namespace
}  // namespace lstm_planner::fuzz::parameters_harness
