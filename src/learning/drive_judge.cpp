#include "lstm_planner/learning/drive_judge.hpp"

#include <algorithm>
#include <vector>

#include "lstm_planner/learning/step_drive.hpp"
#include "parallel_for.hpp"

namespace lstm_planner {

DriveScore judgeDrives(const DrivePolicy& policy, const DriveCourseParameters& course, int worlds, int max_steps,
                       std::uint64_t seed, int threads) {
  constexpr int kGoals = 2;
  constexpr int kStarts = 2;
  std::vector<DriveScore> scores(static_cast<std::size_t>(worlds));
  parallelFor(worlds, threads, [&](int world, int) {
    DriveScore& score = scores[static_cast<std::size_t>(world)];
    Random random(seed * 1000003ULL + static_cast<std::uint64_t>(world));
    for (const DriveExercise& exercise :
         makeDriveExercises(course, WorldUse::kValidation, seed, world, kGoals, kStarts)) {
      for (const DriveTask& task : exercise.tasks) {
        const StepDriveConditions conditions = drawConditions(random);
        NavigationAgent agent(policy, practiceAgent(policy.description()));
        StepDrive drive(*exercise.world, task, conditions, policy.description().footprint_radius, random());
        ++score.drives;
        if (drive.run(max_steps, &agent) != DriveResult::End::kReached) continue;
        score.arrival += 1.0;
        score.efficiency += task.shortest / std::max(task.shortest, drive.pathLength());
      }
    }
  });
  DriveScore all;
  for (const DriveScore& score : scores) {
    all.drives += score.drives;
    all.arrival += score.arrival;
    all.efficiency += score.efficiency;
  }
  all.arrival /= std::max(1, all.drives);
  all.efficiency /= std::max(1, all.drives);
  return all;
}

}  // namespace lstm_planner
