#include "properties/laws/metamorphic/pinned_run.h"

#include <algorithm>
#include <map>

#include "detector/assembly.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::properties {

namespace {

using EdgeSet = std::vector<std::array<std::int32_t, 2>>;

// Returns the edges of each hole by the number of its apex, of ghosts whose apexes are numbered
// from `first` on. They are undirected and sorted, so they are the same for a hole that is walked
// from elsewhere or backward.
template <class Ghosts>
std::map<std::int32_t, EdgeSet> holes_of(const Ghosts& ghosts, std::int32_t first) {
  std::map<std::int32_t, EdgeSet> holes;
  for (const auto& [u, v, apex] : ghosts) {
    if (v < first) holes[apex - first].push_back({std::min(u, v), std::max(u, v)});
  }
  for (auto& [apex, edges] : holes) std::ranges::sort(edges);
  return holes;
}

std::vector<std::array<std::int32_t, 3>> pinned_ghosts(const Case& run) {
  std::vector<std::array<std::int32_t, 3>> ghosts;
  for (const auto& ghost : run.ghosts->triangles.rowwise())
    ghosts.push_back({ghost[0], ghost[1], ghost[2]});
  return ghosts;
}

}  // namespace

// Pins the places of the apexes. Everything else is left to the handler that is given.
class PinnedPlayer::PinnedBoundary : public detector::BoundaryHandler {
 public:
  explicit PinnedBoundary(std::shared_ptr<const BoundaryHandler> otherwise)
      : otherwise_(std::move(otherwise)) {}

  detector::Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                             detector::PacedStop& pace) const override {
    return otherwise_->close_up(triangles, vertex_count, pace);
  }
  std::vector<detector::ApexRule> choose_apexes(const detector::Surface& surface,
                                                detector::BoundingVolumeTree&, const PositionsView&,
                                                const detector::ElementaryTest&,
                                                const StopFunction&) const override {
    return std::vector<detector::ApexRule>(surface.loops.size());
  }
  // Returns the pinned apexes. Before the first step, when view primitives are chosen, none is
  // pinned yet.
  std::vector<MovingPoint> place_apexes(const detector::Surface& surface,
                                        const std::vector<detector::ApexRule>& rules,
                                        const SteppedMesh& motion) const override {
    return apexes.size() == surface.loops.size() ? apexes
                                                 : otherwise_->place_apexes(surface, rules, motion);
  }
  bool sweep(const detector::GhostSweep& sweep, std::span<const std::int32_t> ghosts,
             const StopFunction& stop, std::vector<std::uint8_t>& touched,
             detector::GhostCounts& counts) const override {
    return otherwise_->sweep(sweep, ghosts, stop, touched, counts);
  }

  std::vector<MovingPoint> apexes;  // of the step that is evaluated next

 private:
  std::shared_ptr<const BoundaryHandler> otherwise_;
};

Options options_with_views(const CaseFacts& facts) {
  auto options = facts.options();
  if (detector::chooses_views(options.culling)) {
    options.culling = Culling::view_line;
  }
  return options;
}

std::optional<Case> pinned_run(const CaseFacts& facts) {
  if (!facts.stages_of()) return std::nullopt;
  const auto& surface = facts.surface();
  Case run;
  run.id = facts.source().id;
  run.triangles = facts.source().triangles;
  run.frames = {facts.source().frames.front()};
  auto& [points, fans] = run.ghosts.emplace();
  fans = oracle::ghost_triangles(surface.loops, surface.first_apex);
  auto end = surface.first_apex + static_cast<std::int32_t>(surface.loops.size());
  for (const auto& component : surface.mesh.components) {
    fans.conservativeResize(fans.rows() + 1, 3);
    fans.bottomRows(1) << component.vertices.front(), end, end + 1;
    end += 2;
  }
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!facts.has_views(s)) return std::nullopt;
    const auto& result = facts.result(s);
    // The other run has Culling::view_line, and would ask for layers where this run did not.
    const bool any_dirty = std::ranges::any_of(
        result.doubts, [](std::uint8_t marks) { return (marks & detector::doubt::dirty) != 0; });
    if (any_dirty && !facts.known_from(s) && facts.starts_by_view_alone()) return std::nullopt;
    const auto from = static_cast<std::int32_t>(run.frames.size());
    run.script.push_back({from, from + 1, facts.script(s).commit});
    run.frames.insert(run.frames.end(), {facts.x_t0(s), facts.x_t1(s)});
    for (const auto at_end : {&MovingPoint::t0, &MovingPoint::t1}) {
      auto& of_frame = points.emplace_back();
      for (const auto& apex : result.apexes) of_frame.push_back(apex.*at_end);
      for (const auto& primitive : result.primitives)
        of_frame.insert(of_frame.end(), {primitive.q0.*at_end, primitive.q1.*at_end});
    }
  }
  points.insert(points.begin(), std::vector(points.front()));
  return run;
}

PinnedPlayer::PinnedPlayer(const Case& run, std::shared_ptr<PinnedBoundary> boundary)
    : run_(&run), boundary_(std::move(boundary)) {}

std::optional<PinnedPlayer> PinnedPlayer::make(const Case& run, const Options& options,
                                               const StagesOf& stages_of) {
  auto stages = stages_of(options);
  const auto boundary = std::make_shared<PinnedBoundary>(stages.boundary);
  stages.boundary = boundary;
  auto creation = detector::assemble(run.triangles, run.frames.front(), options, std::move(stages));
  PinnedPlayer player(run, boundary);
  if (!creation) {
    player.problem_ = std::move(creation).error();
    return player;
  }
  player.detector_ = std::move(creation).value();
  const auto& surface = player.detector_->surface();
  const auto pinned = pinned_ghosts(run);
  auto holes = holes_of(pinned, surface.first_apex);
  const std::span all(surface.all().triangles);
  for (const auto& hole :
       holes_of(all.subspan(surface.mesh.triangles.size()), surface.first_apex)) {
    const auto same =
        std::ranges::find_if(holes, [&](const auto& other) { return other.second == hole.second; });
    if (same == holes.end()) return std::nullopt;
    player.apex_of_loop_.push_back(same->first);
    holes.erase(same);
  }
  player.view_of_component_.resize(surface.mesh.components.size());
  for (const auto& [vertex, end, other_end] : pinned) {
    const auto triangles = surface.mesh.vertex_triangles.row(vertex);
    if (end < surface.first_apex || triangles.empty()) continue;
    const auto component = surface.mesh.component_of_triangle[at(triangles.front())];
    player.view_of_component_[at(component)] = end - surface.first_apex;
  }
  return player;
}

StepResult PinnedPlayer::evaluate(std::size_t step) {
  const auto& script = run_->script[step];
  return evaluate(step, run_->frames[at(script.from)], run_->frames[at(script.to)]);
}

StepResult PinnedPlayer::evaluate(std::size_t step, const PositionsView& x_t0,
                                  const PositionsView& x_t1) {
  if (problem_) {
    StepResult refusal;
    refusal.problem = problem_;
    return refusal;
  }
  const auto& points = run_->ghosts->apexes;
  const auto path = [&, &of_step = run_->script[step]](std::int32_t place) {
    return MovingPoint{points[at(of_step.from)][at(place)], points[at(of_step.to)][at(place)]};
  };
  std::vector<ViewPrimitive> primitives;
  for (const auto place : view_of_component_) primitives.push_back({path(place), path(place + 1)});
  boundary_->apexes.clear();
  for (const auto place : apex_of_loop_) boundary_->apexes.push_back(path(place));
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
