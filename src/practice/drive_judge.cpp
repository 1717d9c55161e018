#include "lstm_planner/practice/drive_judge.hpp"

#include <algorithm>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/practice/step_simulator.hpp"

namespace lstm_planner {

std::vector<JudgedDrive> judgeEach(const DrivePolicy& policy, const AgentParameters& agent_parameters,
                                   const DriveCourseParameters& course, WorldUse use, int worlds, int max_steps,
                                   std::uint64_t seed, int threads) {
  constexpr int kGoals = 2;
  constexpr int kStarts = 2;
  std::vector<std::vector<JudgedDrive>> by_world(static_cast<std::size_t>(worlds));
  parallelFor(worlds, threads, [&](int world, int) {
    Random random(seed * 1000003ULL + static_cast<std::uint64_t>(world));
    for (const DriveExercise& exercise : makeDriveExercises(course, use, seed, world, kGoals, kStarts)) {
      for (const DriveTask& task : exercise.tasks) {
        const PracticeConditions conditions = drawConditions(random);
        AgentParameters own = agent_parameters;
        own.shield.footprint_radius = kPracticeRadius;
        NavigationAgent agent(policy, fittedToFootprint(own));
        StepSimulator drive(*exercise.world, task, conditions, random());
        JudgedDrive judged;
        judged.world = world;
        judged.kind = exercise.kind;
        judged.arrived = drive.run(max_steps, &agent) == LoopEnd::kArrived;
        if (judged.arrived) judged.efficiency = drive.efficiency();
        by_world[static_cast<std::size_t>(world)].push_back(judged);
      }
    }
  });
  std::vector<JudgedDrive> all;
  for (const std::vector<JudgedDrive>& some : by_world) all.insert(all.end(), some.begin(), some.end());
  checkParameter(!all.empty(), "shortest", course.shortest, "at most as much as the paths in the worlds to judge in");
  return all;
}

DriveScore judgeDrives(const DrivePolicy& policy, const DriveCourseParameters& course, int worlds, int max_steps,
                       std::uint64_t seed, int threads) {
  DriveScore score;
  for (const JudgedDrive& drive : judgeEach(policy, practiceAgent(policy.description()), course, WorldUse::kValidation,
                                            worlds, max_steps, seed, threads)) {
    ++score.drives;
    score.arrival += drive.arrived ? 1.0 : 0.0;
    score.efficiency += drive.efficiency;
  }
  score.arrival /= std::max(1, score.drives);
  score.efficiency /= std::max(1, score.drives);
  return score;
}

}  // namespace lstm_planner
