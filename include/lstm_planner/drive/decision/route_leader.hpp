#pragma once

#include "lstm_planner/drive/decision/step_leader.hpp"

namespace lstm_planner {

/// Leads along the path through what is remembered, which there must be.
class RouteLeader : public StepLeader {
 public:
  bool decide(const StepContext& step, Replanner::Answer answer) override;
};

}  // namespace lstm_planner
