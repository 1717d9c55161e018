#include <atomic>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/grid/surface_points.hpp"
#include "lstm_planner/simulation/drive_film.hpp"
#include "tools/command.hpp"
#include "tools/drive_options.hpp"
#include "tools/drive_report.hpp"
#include "tools/drive_worlds.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {
namespace {

/// All obstacles of a world, in the odometry frame of a drive.
std::vector<Point2> obstaclesOf(const DriveWorld& world, const DriveTask& task, double spacing) {
  std::vector<Point2> obstacles = surfacePoints(*world.map, spacing);
  for (Point2& place : obstacles) place = toLocalFrame(task.start, place);
  return obstacles;
}

DriveResult driveOnce(const DriveOptions& options, const DriveWorld& world, const NumberedDrive& exercise,
                      const DriveParameters& rules, const DrivePolicy& policy, DriveStates* states) {
  NavigationAgent agent(policy, options.agent);
  if (options.knows_map) agent.know(obstaclesOf(world, exercise.task, 0.5 * options.agent.memory.resolution));
  if (!options.states.empty()) states->watch(&agent);
  DriveListener listener;
  if (!options.film.empty()) {
    listener = filmOf(floorOf(world, exercise.task), exercise.task, options.film, options.film_parameters);
  }
  const Point2 start{exercise.task.start.x, exercise.task.start.y};
  const std::uint64_t seed = Random(exercise.seed)();
  if (world.cylinders) {
    MovingCylinders cylinders(*world.world, *world.cylinders, start, seed);
    return drive(&cylinders, exercise.task, rules, exercise.seed, &agent, listener);
  }
  if (options.crowd.walkers == 0) return drive(*world.world, exercise.task, rules, exercise.seed, &agent, listener);
  Crowd crowd(*world.world, world.walker_places, options.crowd, start, seed);
  return drive(&crowd, exercise.task, rules, exercise.seed, &agent, listener);
}

/// Only a network that leads is read: the others need no file. Says what the planner would warn of.
DrivePolicy policyOf(const DriveOptions& options) {
  if (options.agent.leader != Leader::kNetwork) return noPolicy();
  DrivePolicy policy = DrivePolicy::fromFile(options.model);
  for (const std::string& warning : {sizeWarning(policy.description(), options.agent.shield.footprint_radius),
                                     standInWarning(policy.description(), options.drive.robot.scanner.range_max)}) {
    if (!warning.empty()) std::cout << "warning: " << warning << "\n";
  }
  return policy;
}

DriveResults driveAll(const DriveOptions& options, const DriveCourse& course, const DrivePolicy& policy,
                      DriveStates* states) {
  DriveResults results;
  std::vector<std::pair<std::size_t, std::size_t>> jobs;
  for (std::size_t world = 0; world < course.worlds.size(); ++world) {
    const std::size_t exercises = course.worlds[world].exercises.size();
    results.emplace_back(exercises);
    for (std::size_t exercise = 0; exercise < exercises; ++exercise) jobs.emplace_back(world, exercise);
  }
  Progress progress;
  std::atomic<int> done{0};
  parallelFor(static_cast<int>(jobs.size()), options.threads, [&](int job, int thread) {
    const auto [world, exercise] = jobs[static_cast<std::size_t>(job)];
    const DriveWorld& where = course.worlds[world];
    results[world][exercise] = driveOnce(options, where, where.exercises[exercise], course.rules, policy, states);
    ++done;
    if (thread == 0) progress.show(static_cast<double>(done) / static_cast<double>(jobs.size()));
  });
  progress.show(1.0);
  return results;
}

}  // namespace

int runDrive(const std::vector<std::string>& arguments) {
  DriveOptions options;
  if (!readDriveOptions(arguments, &options)) return 0;
  const DrivePolicy policy = policyOf(options);  // before the worlds, which may take a minute
  const DriveCourse course = makeDriveCourse(options);
  DriveStates states;
  const DriveResults results = driveAll(options, course, policy, &states);
  printDriveSummary(std::cout, options, course, results);
  if (!options.json.empty()) writeJsonFile(options.json, driveJson(options, course, results));
  if (!options.details.empty()) writeTextFile(options.details, driveCsv(course, results));
  if (!options.pictures.empty()) drawDrives(options.pictures, course, results);
  if (!options.states.empty()) {
    drawDrive(options.states, course, results);
    states.drawBelow(options.states);
  }
  return 0;
}

}  // namespace lstm_planner
