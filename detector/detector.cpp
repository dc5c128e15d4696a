#include "detector/detector.h"

#include "detector/mesh/mesh_checks.h"
#include "detector/step.h"

namespace assay::detector {

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
  if (auto problem = check_triangles(triangles, positions.rows())) return std::move(*problem);
  if (auto problem = check_positions(positions, positions.rows())) return std::move(*problem);
  Topology mesh = make_topology(triangles, positions.rows());
  BoundingVolumeTree tree(mesh, positions);
  const ViewKind kind = options.culling == Culling::view_line ? ViewKind::line : ViewKind::point;
  std::vector<ViewAnchor> anchors;
  for (const auto& component : mesh.components) {
    anchors.push_back(make_view_anchor(kind, component, positions));
  }
  return Detector(std::unique_ptr<Parts>(new Parts{
      {options, positions.rows(), std::move(mesh), std::move(tree), std::move(anchors)}, {}, {}}));
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

const Topology& Detector::topology() const { return parts_->context.mesh; }

}  // namespace assay::detector
