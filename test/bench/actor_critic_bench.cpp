#include "bench_support.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"

namespace lstm_planner::actor_critic_bench {
namespace {

/// One update: 256 agents walk for 64 steps, and errors go back.
void actorCriticUpdate(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  GridActorCriticParameters parameters;
  parameters.encoder.views = static_cast<int>(state.range(1));
  parameters.threads = 1;
  const GridEncoder encoder(parameters.encoder);
  const auto learner = makeGridActorCritic(parameters, benchLstm(encoder.size(), {cells}, encoder.outputs()));
  GridCourseParameters course_parameters;
  course_parameters.goals = 30;
  const GridCourse course(course_parameters, {{benchMaps(), 1.0}}, 1, 1);
  learner->startEpoch(0, course);
  const WorkMeter meter;
  for (auto _ : state) learner->update();
  meter.report("sample", static_cast<double>(state.iterations()) * parameters.agents * parameters.window, &state);
}
BENCHMARK(actorCriticUpdate)
    ->ArgNames({"cells", "views"})
    ->Apply([](auto* family) {
      addArgumentPairs({4, 8, 16, 32}, {1, 8}, family);
    }) -> Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner::actor_critic_bench
