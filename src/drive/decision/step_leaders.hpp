#pragma once

#include "drive/decision/step_context.hpp"
#include "lstm_planner/drive/decision/bug_algorithm.hpp"

namespace lstm_planner {

// Those who lead decide a step: each writes what the robot does to the step's decision. `answer`: of step.searchPath()
// in this situation. A new leader is a function here, a value of Leader, and a line of NavigationAgent::decideAsLed().

/// Leads by preferences (Decision::preferences), of the network or for the goal's bearing: the preferred one of the
/// steering angles that the shield allows, as long as its detours stay within the bound. Otherwise the path through
/// what is remembered decides the step. Where nothing is remembered, nothing limits the detours.
void leadByPreferences(const StepContext& step, Replanner::Answer answer);

/// Leads along the path through what is remembered, which there must be.
void leadAlongPath(const StepContext& step, Replanner::Answer answer);

/// The last resort: leads along boundaries until the robot is nearer to the goal than ever. Then it writes nothing and
/// returns false: another must lead.
bool leadAlongBoundary(const StepContext& step, BugAlgorithm* bug_algorithm);

}  // namespace lstm_planner
