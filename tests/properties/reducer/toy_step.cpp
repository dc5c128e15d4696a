#include "tests/properties/reducer/toy_step.h"

#include <algorithm>

#include "oracle/instant/instant.h"
#include "oracle/instant/layers.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"

namespace assay::properties::toys {

using corpus::Case, detector::PairContact, detector::Positions, detector::ViewPrimitive,
    detector::ViewSign;

Signs exact_signs(const ToyStep& step) {
  return oracle::view_signs({step.x_t0, step.x_t1}, step.mesh.triangles, {&step.view, 1}, 1);
}

Signs sampled_signs(const ToyStep& step, const std::vector<double>& times) {
  Signs shared;
  for (const double t : times) {
    const Positions x = (1 - t) * step.x_t0 + t * step.x_t1;
    const Signs now = oracle::view_signs({x, x}, step.mesh.triangles, {&step.view, 1}, 1);
    if (shared.empty()) shared = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] != shared[i]) shared[i] = ViewSign::zero;
    }
  }
  return shared;
}

Signs one_vertex_signs(const ToyStep& step) {
  Signs signs;
  const auto& triangles = step.mesh.triangles;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<detector::MovingPoint, 3> corners;
    for (int i = 0; i < 3; ++i) {
      corners[static_cast<std::size_t>(i)] =
          detector::SteppedMesh{step.x_t0, step.x_t1}.path(triangles(t, i));
    }
    // The nearest point of the first vertex, at both ends, as a moving point.
    const auto nearest = [&](bool end) {
      const auto place = [&](const detector::MovingPoint& p) {
        const auto& x = end ? p.t1 : p.t0;
        return Eigen::Vector3d(x[0], x[1], x[2]);
      };
      const Eigen::Vector3d q0 = place(step.view.q0), q1 = place(step.view.q1);
      const Eigen::Vector3d d = q1 - q0;
      const double square = d.squaredNorm();
      const double s = square > 0 ? (place(corners[0]) - q0).dot(d) / square : 0;
      const Eigen::Vector3d n = q0 + std::min(1., std::max(0., s)) * d;
      return detector::Point{n[0], n[1], n[2]};
    };
    const detector::MovingPoint q = {nearest(false), nearest(true)};
    signs.push_back(oracle::view_sign(corners, {q, q}));
  }
  return signs;
}

std::optional<Finding> missing(const PairContact& contact, const char* claim, const char* stage,
                               std::size_t step) {
  return Finding{std::string(claim) + "/missing/" + stage + "/" + name_of(contact.feature.kind),
                 {contact.pair.a, contact.pair.b},
                 step};
}

int common_vertices(const detector::Triangles& triangles, const detector::TrianglePair& pair) {
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) common += triangles(pair.a, i) == triangles(pair.b, k) ? 1 : 0;
  }
  return common;
}

std::vector<std::uint8_t> not_clean(const Case& c, const Positions& x) {
  const auto state = oracle::layers_at(oracle::Instant(x), c.triangles, detector::Triangles(0, 3));
  std::vector<std::uint8_t> dirty;
  for (const auto clean : state.clean) dirty.push_back(clean == 0 ? 1 : 0);
  return dirty;
}

bool is_cycle(const detector::Topology& mesh) {
  for (const auto& component : mesh.components) {
    if (!component.is_cycle) return false;
  }
  return true;
}

ViewPrimitive view_of(const Case& c, std::size_t step) {
  return corpus::view_of_step(c, step).value_or(ViewPrimitive{});
}

}  // namespace assay::properties::toys
