#include "properties/laws/metamorphic/pinned_run.h"

#include <algorithm>

#include "detector/assembly.h"

namespace assay::properties {

using detector::MovingPoint;
using detector::StepResult;

namespace {

using EdgeSet = std::vector<std::array<std::int32_t, 2>>;

// The edges are undirected and sorted, so they are the same for a loop that begins elsewhere or
// runs backward.
EdgeSet edges_of(const detector::Loop& loop) {
  EdgeSet edges;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto u = loop[i], v = loop[(i + 1) % loop.size()];
    edges.push_back({std::min(u, v), std::max(u, v)});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// For each loop of a surface, its place among `wanted`. Each place is used once.
std::optional<std::vector<std::size_t>> match(const std::vector<detector::Loop>& loops,
                                              const std::vector<detector::Loop>& wanted) {
  if (loops.size() != wanted.size()) return std::nullopt;
  std::vector<EdgeSet> open;
  for (const auto& loop : wanted) open.push_back(edges_of(loop));
  std::vector<std::size_t> place;
  for (const auto& loop : loops) {
    const auto found = std::find(open.begin(), open.end(), edges_of(loop));
    if (found == open.end()) return std::nullopt;
    place.push_back(static_cast<std::size_t>(found - open.begin()));
    found->clear();
  }
  return place;
}

}  // namespace

// Pins the places of the apexes. Everything else is left to the handler that is given.
class PinnedPlayer::PinnedBoundary : public detector::BoundaryHandler {
 public:
  explicit PinnedBoundary(std::shared_ptr<const BoundaryHandler> otherwise)
      : otherwise_(std::move(otherwise)) {}

  detector::Surface close_up(const detector::TrianglesView& triangles, Eigen::Index vertex_count,
                             detector::PacedStop& pace) const override {
    return otherwise_->close_up(triangles, vertex_count, pace);
  }
  std::vector<detector::ApexRule> choose_apexes(const detector::Surface& surface,
                                                detector::BoundingVolumeTree&,
                                                const detector::PositionsView&,
                                                const detector::ElementaryTest&,
                                                const detector::StopFunction&) const override {
    return std::vector<detector::ApexRule>(surface.loops.size());
  }
  // Before the first step, when view primitives are chosen, no apex is pinned yet.
  std::vector<MovingPoint> place_apexes(const detector::Surface& surface,
                                        const std::vector<detector::ApexRule>& rules,
                                        const detector::SteppedMesh& motion) const override {
    return apexes.size() == surface.loops.size() ? apexes
                                                 : otherwise_->place_apexes(surface, rules, motion);
  }
  bool sweep(const detector::GhostSweep& sweep, std::span<const std::int32_t> ghosts,
             const detector::StopFunction& stop, std::vector<std::uint8_t>& touched,
             detector::GhostCounts& counts) const override {
    return otherwise_->sweep(sweep, ghosts, stop, touched, counts);
  }

  std::vector<MovingPoint> apexes;  // of the step that is evaluated next

 private:
  std::shared_ptr<const BoundaryHandler> otherwise_;
};

detector::Options options_with_views(const CaseFacts& facts) {
  auto options = facts.options();
  if (detector::chooses_views(options.culling)) {
    options.culling = detector::Culling::view_line;
  }
  return options;
}

std::optional<PinnedRun> pinned_run(const CaseFacts& facts) {
  if (!facts.stages_of()) return std::nullopt;
  PinnedRun run{
      facts.source().triangles, facts.source().frames, {}, {}, {}, facts.surface().loops, {}};
  for (const auto& component : facts.surface().mesh.components) {
    run.seats.push_back(component.triangles.front());
  }
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!facts.has_views(s)) return std::nullopt;
    // The other run, of view-line, would ask for layers where this one did not.
    const auto& doubts = facts.result(s).doubts;
    const bool any_dirty = std::any_of(doubts.begin(), doubts.end(), [](std::uint8_t marks) {
      return (marks & detector::doubt::dirty) != 0;
    });
    if (any_dirty && !facts.known_from(s) && facts.starts_by_view_alone()) return std::nullopt;
    run.script.push_back(facts.script(s));
    run.primitives.push_back(facts.result(s).primitives);
    run.apexes.push_back(facts.result(s).apexes);
  }
  return run;
}

PinnedPlayer::PinnedPlayer(const PinnedRun& run, std::shared_ptr<PinnedBoundary> boundary)
    : run_(&run), boundary_(std::move(boundary)) {}

std::optional<PinnedPlayer> PinnedPlayer::make(const PinnedRun& run,
                                               const detector::Options& options,
                                               const StagesOf& stages_of) {
  auto stages = stages_of(options);
  const auto boundary = std::make_shared<PinnedBoundary>(stages.boundary);
  stages.boundary = boundary;
  auto made = detector::assemble(run.triangles, run.frames.front(), options, std::move(stages));
  PinnedPlayer player(run, boundary);
  if (!made) {
    player.problem_ = std::move(made).error();
    return player;
  }
  player.detector_ = std::move(made).value();
  auto places = match(player.detector_->surface().loops, run.loops);
  if (!places) return std::nullopt;
  player.loop_of_apex_ = std::move(*places);
  const auto& mesh = player.detector_->topology();
  player.seat_of_component_.resize(mesh.components.size());
  for (std::size_t c = 0; c < run.seats.size(); ++c) {
    const auto component = mesh.component_of_triangle[at(run.seats[c])];
    player.seat_of_component_[at(component)] = c;
  }
  return player;
}

StepResult PinnedPlayer::evaluate(std::size_t step) {
  const auto& script = run_->script[step];
  return evaluate(step, run_->frames[at(script.from)], run_->frames[at(script.to)]);
}

StepResult PinnedPlayer::evaluate(std::size_t step, const detector::PositionsView& x_t0,
                                  const detector::PositionsView& x_t1) {
  if (problem_) {
    StepResult refused;
    refused.problem = problem_;
    return refused;
  }
  std::vector<detector::ViewPrimitive> primitives;
  for (const auto seat : seat_of_component_) primitives.push_back(run_->primitives[step][seat]);
  boundary_->apexes.clear();
  for (const auto loop : loop_of_apex_) boundary_->apexes.push_back(run_->apexes[step][loop]);
  return detector_->evaluate(x_t0, x_t1, primitives);
}

void PinnedPlayer::commit(std::size_t step, const StepResult& result) {
  if (run_->script[step].commit && is_answered(result)) detector_->commit();
}

std::vector<StepResult> PinnedPlayer::play() {
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < run_->script.size(); ++s) {
    results.push_back(evaluate(s));
    commit(s, results.back());
  }
  return results;
}

}  // namespace assay::properties
