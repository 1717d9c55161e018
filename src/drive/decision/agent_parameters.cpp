#include "lstm_planner/drive/decision/agent_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

/// Of the footprint radius: a coarser memory would have paths that lead through walls.
constexpr double kCoarsest = 0.29;

constexpr double kSameRadius = 1e-6;  // m

constexpr double kMillimetres = 1000.0;  // a metre
constexpr double kOfAMillimetre = 1e-6;  // a length that is so much shorter or longer counts as whole millimetres

/// m, of a memory that suits this footprint.
double coarsestResolution(const ShieldParameters& shield) { return kCoarsest * shield.footprint_radius; }

/// m from the middle of the robot within which obstacles may matter to its paths.
double farthestRadius(double resolution) { return kMostNearSquares * resolution; }

double widestMemory(double resolution) { return kMostSquaresASide * resolution; }

/// m from the middle of the robot within which obstacles matter to its paths.
double widestRadius(const AgentParameters& parameters) {
  const ShieldParameters& shield = parameters.shield;
  return std::max(shield.footprint_radius + std::max(parameters.memory.comfort, shield.clearance),
                  footprintOf(shield).circumscribedRadius() + shield.tight_clearance);
}

}  // namespace

AgentParameters fittedToFootprint(AgentParameters parameters) {
  ShieldParameters& shield = parameters.shield;
  if (!shield.footprint.empty()) shield.footprint_radius = footprintOf(shield).passingRadius();
  AgentParameters fitted = parameters;
  MemoryParameters& memory = fitted.memory;
  const double coarsest = coarsestResolution(shield);
  if (memory.comfort <= MemoryParameters().comfort) {  // nobody wanted more
    memory.comfort = std::min(memory.comfort, farthestRadius(coarsest) - shield.footprint_radius);
  }
  const double finest = widestRadius(fitted) / kMostNearSquares;
  if (!isAtMost(finest, coarsest) || !(memory.resolution > 0.0)) return parameters;
  if (!isAtMost(finest, memory.resolution) || !isAtMost(memory.resolution, coarsest)) {
    const double least = std::ceil(kMillimetres * finest - kOfAMillimetre) / kMillimetres;
    const double most = std::floor(kMillimetres * coarsest + kOfAMillimetre) / kMillimetres;
    memory.resolution = least <= most ? std::clamp(memory.resolution, least, most) : coarsest;
  }
  memory.width = std::min(memory.width, widestMemory(memory.resolution));
  return fitted;
}

void validate(const AgentParameters& parameters) {
  leaderNamed(nameOfLeader(parameters.leader));
  if (parameters.leader == Leader::kRoute && !parameters.memory.enabled) {
    throw std::invalid_argument(
        "leader is route, expected network where memory/enabled is false: no path is remembered");
  }
  visitAgentParameters(parameters, RangeCheck());
  checkParameter(parameters.step.stall > parameters.step.period, "step/stall", parameters.step.stall,
                 "more than step/period = " + numberText(parameters.step.period));
  const ShieldParameters& shield = parameters.shield;
  checkParameter(shield.clearance >= shield.tight_clearance, "shield/clearance", shield.clearance,
                 "at least shield/tight_clearance = " + numberText(shield.tight_clearance));
  checkParameter(shield.shortest_step <= parameters.step.length, "shield/shortest_step", shield.shortest_step,
                 "at most step/length = " + numberText(parameters.step.length));
  checkParameter(parameters.step.reached < shield.shortest_step, "step/reached", parameters.step.reached,
                 "less than shield/shortest_step = " + numberText(shield.shortest_step));
  const Footprint footprint = footprintOf(shield);
  checkParameter(footprint.isCircle() || std::abs(footprint.passingRadius() - shield.footprint_radius) < kSameRadius,
                 "shield/footprint_radius", shield.footprint_radius,
                 "as far as shield/footprint reaches to the side = " + numberText(footprint.passingRadius()));
  const double needed_reach = parameters.step.length + footprint.circumscribedRadius() + shield.clearance;
  checkParameter(isAtMost(needed_reach, shield.reach), "shield/reach", shield.reach,
                 "at least step, footprint radius and clearance together = " + numberText(needed_reach));

  const MemoryParameters& memory = parameters.memory;
  const double coarsest = coarsestResolution(shield);
  checkParameter(isAtMost(memory.resolution, coarsest), "memory/resolution", memory.resolution,
                 "at most 0.29 shield/footprint_radius = " + numberText(coarsest));
  const double widest = widestMemory(memory.resolution);
  checkParameter(isAtMost(memory.width, widest), "memory/width", memory.width,
                 "at most 2000 memory/resolution = " + numberText(widest));
  const double farthest = farthestRadius(memory.resolution);
  checkParameter(isAtMost(shield.footprint_radius + memory.comfort, farthest), "memory/comfort", memory.comfort,
                 "with shield/footprint_radius at most 16 memory/resolution = " + numberText(farthest));
  checkParameter(isAtMost(shield.footprint_radius + shield.clearance, farthest), "shield/clearance", shield.clearance,
                 "with shield/footprint_radius at most 16 memory/resolution = " + numberText(farthest));
  checkParameter(isAtMost(widestRadius(parameters), farthest), "shield/tight_clearance", shield.tight_clearance,
                 "with the farthest corner of shield/footprint at most 16 memory/resolution = " + numberText(farthest));

  checkParameter(parameters.step.reached < parameters.goal_tolerance, "step/reached", parameters.step.reached,
                 "less than goal_tolerance = " + numberText(parameters.goal_tolerance));
}

}  // namespace lstm_planner
