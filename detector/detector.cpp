#include "detector/detector.h"

#include "detector/mesh/mesh_checks.h"
#include "detector/step.h"

namespace assay::detector {

namespace {

// From where all of S at rest is seen best, ghosts included.
void place_anchors(StepContext& context, const PositionsView& positions) {
  const Surface& surface = context.surface;
  std::vector<MovingPoint> apexes;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const Point apex = place_apex(context.apex_rules[l], surface.loops[l], positions);
    apexes.push_back({apex, apex});
  }
  const Positions x = with_apexes(positions, apexes, false);
  const Culling culling = context.options.culling;
  for (const auto& component : surface.all().components) {
    context.anchors.push_back(
        culling == Culling::view_auto
            ? choose_view_anchor(surface.all(), component, surface.first_apex, x)
            : make_view_anchor(culling == Culling::view_line ? ViewKind::line : ViewKind::point,
                               surface.all(), component, surface.first_apex, x));
  }
}

}  // namespace

struct Detector::Parts {
  StepContext context;
  std::optional<StepState> committed, evaluated;
};

Detector::Detector(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;
Detector::~Detector() = default;

Expected<Detector> Detector::create(const TrianglesView& triangles, const PositionsView& positions,
                                    const Options& options) {
  return assemble(triangles, positions, options, standard_stages(options));
}

Expected<Detector> Detector::assemble(const TrianglesView& triangles,
                                      const PositionsView& positions, const Options& options,
                                      Stages stages) {
  if (auto problem = check_triangles(triangles, positions.rows())) return std::move(*problem);
  if (auto problem = check_positions(positions, positions.rows())) return std::move(*problem);
  Surface surface = stages.boundary->close_up(triangles, positions.rows());
  BoundingVolumeTree tree(surface.mesh, positions);
  SearchMemory search(surface.mesh, tree);
  search.kept = stages.pair_search->prepare(surface.mesh, tree);
  StepContext context{
      options, std::move(stages), std::move(surface), std::move(tree), std::move(search), {}, {},
      {}};
  if (uses_views(options.culling)) {
    context.apex_rules = context.stages.boundary->choose_apexes(
        context.surface, context.tree, positions, *context.stages.elementary);
    place_anchors(context, positions);
    context.adjacent_pairs = adjacent_pairs(context.surface.mesh);
  }
  return Detector(std::unique_ptr<Parts>(new Parts{std::move(context), {}, {}}));
}

StepResult Detector::evaluate(const PositionsView& x_t0, const PositionsView& x_t1,
                              std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  parts_->evaluated.reset();
  return evaluate_step(parts_->context, parts_->committed, x_t0, x_t1, primitives, stop,
                       parts_->evaluated);
}

std::optional<Problem> Detector::commit() {
  if (!parts_->evaluated) {
    return Problem{InputError::nothing_to_commit, "no evaluated step to commit"};
  }
  parts_->committed = std::move(parts_->evaluated);
  parts_->evaluated.reset();
  return std::nullopt;
}

StepResult Detector::step(const PositionsView& x_t0, const PositionsView& x_t1,
                          std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  StepResult result = evaluate(x_t0, x_t1, primitives, stop);
  if (parts_->evaluated) commit();
  return result;
}

void Detector::reset() {
  parts_->committed.reset();
  parts_->evaluated.reset();
}

const Topology& Detector::topology() const { return parts_->context.surface.mesh; }

const Surface& Detector::surface() const { return parts_->context.surface; }

}  // namespace assay::detector
