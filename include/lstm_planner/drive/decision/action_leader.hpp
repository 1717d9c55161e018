#pragma once

#include <optional>

#include "lstm_planner/drive/decision/action_choice.hpp"
#include "lstm_planner/drive/decision/route_leader.hpp"
#include "lstm_planner/drive/decision/step_leader.hpp"

namespace lstm_planner {

/// Leads by preferences (Decision::preferences), of the network or for the goal's bearing: the preferred one of the
/// steering angles that the shield allows, as long as its detours stay within the bound. Otherwise the path through
/// what is remembered decides the step. Where nothing is remembered, nothing limits the detours.
class ActionLeader : public StepLeader {
 public:
  explicit ActionLeader(const AgentParameters& parameters) : choice_(parameters) {}

  bool decide(const StepContext& step, Replanner::Answer answer) override;

 private:
  std::optional<ActionChoice::Action> choose(const StepContext& step) const;

  ActionChoice choice_;
  RouteLeader route_;
};

}  // namespace lstm_planner
