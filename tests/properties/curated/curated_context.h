// One step of a curated case with what the oracle says of it: signs, contacts, ghosts.
#pragma once

#include <nlohmann/json.hpp>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "tests/test.h"

namespace assay::properties::test {

using Set = std::vector<std::int32_t>;
using Flags = std::vector<std::uint8_t>;

inline Set members(const Flags& flags) {
  Set set;
  for (std::size_t t = 0; t < flags.size(); ++t) {
    if (flags[t]) set.push_back(static_cast<std::int32_t>(t));
  }
  return set;
}

inline detector::Positions rows(const std::vector<detector::Point>& points) {
  detector::Positions x(static_cast<Eigen::Index>(points.size()), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    for (int k = 0; k < 3; ++k) x(i, k) = points[static_cast<std::size_t>(i)][k];
  }
  return x;
}

class CuratedStep {
 public:
  CuratedStep(const corpus::Case& c, std::size_t step)
      : triangles(c.triangles), x_t0(c.frames[step]), x_t1(c.frames[step + 1]) {
    if (c.ghosts) {
      ghosts = c.ghosts->triangles;
      apexes_t0 = rows(c.ghosts->apexes[step]);
      apexes_t1 = rows(c.ghosts->apexes[step + 1]);
    }
    const auto view = corpus::view_of_step(c, step);
    if (view) primitive = *view;
    signs = signs_between(x_t0, x_t1);
    judgement = oracle::judge_step({x_t0, x_t1}, triangles, {});
  }

  std::vector<detector::ViewSign> signs_between(const detector::Positions& from,
                                                const detector::Positions& to) const {
    return oracle::view_signs({from, to}, triangles, {&primitive, 1}, 1);
  }
  bool all_signs(detector::ViewSign wanted) const {
    return std::all_of(signs.begin(), signs.end(), [&](auto s) { return s == wanted; });
  }
  // Positive at t=0, 1/2, 1 when the places there are doubles.
  bool all_positive_at_rest(const detector::Positions& x) const {
    const auto at = signs_between(x, x);
    return std::all_of(at.begin(), at.end(),
                       [](auto s) { return s == detector::ViewSign::positive; });
  }

  Flags touched(const detector::Positions& from, const detector::Positions& to) const {
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, from, to, ghosts);
  }
  Flags swept() const { return touched(apexes_t0, apexes_t1); }
  // As a first step: also what is pierced at t=0 (L11).
  Flags swept_alone() const {
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, apexes_t0, apexes_t1, ghosts,
                                     {1, true});
  }
  // Ghosts and mesh at one end of the step, piercing included.
  Flags at_rest(bool end) const {
    const auto &x = end ? x_t1 : x_t0, &apexes = end ? apexes_t1 : apexes_t0;
    return oracle::touched_by_ghosts({x, x}, triangles, apexes, apexes, ghosts, {1, true});
  }
  Flags at_either_end() const {
    Flags flags = at_rest(false);
    const Flags end = at_rest(true);
    for (std::size_t t = 0; t < flags.size(); ++t) flags[t] |= end[t];
    return flags;
  }
  // Ghosts that stay behind, corners and all, at their places of t=0.
  Flags by_frozen_ghosts() const {
    detector::Positions corners(3 * ghosts.rows(), 3);
    detector::Triangles frozen(ghosts.rows(), 3);
    const detector::Positions all = oracle::with_apexes(x_t0, apexes_t0);
    for (Eigen::Index i = 0; i < corners.rows(); ++i) {
      corners.row(i) = all.row(ghosts(i / 3, i % 3));
      frozen(i / 3, i % 3) = static_cast<std::int32_t>(x_t0.rows() + i);
    }
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, corners, corners, frozen);
  }

  // K with this Vv.
  oracle::Candidates k(Flags violated = {}) const { return {signs, std::move(violated)}; }
  bool k_finds_nothing(Flags violated = {}) const {
    return oracle::split(judgement.pairs, k(std::move(violated))).in_k.empty();
  }
  bool k_finds_the_first(Flags violated = {}) const {
    return !judgement.pairs.empty() &&
           oracle::holds_a_first_contact(judgement.pairs, k(std::move(violated)));
  }
  std::vector<detector::PairContact> pairs_outside_k() const {
    return oracle::split(judgement.pairs, k()).outside;
  }
  // The pairs of all feature contacts, first or later ones of their pairs, that K has no pair of.
  std::vector<detector::TrianglePair> lost_feature_pairs() const;

  detector::Triangles triangles, ghosts{0, 3};
  detector::Positions x_t0, x_t1, apexes_t0{0, 3}, apexes_t1{0, 3};
  detector::ViewPrimitive primitive{};
  std::vector<detector::ViewSign> signs;
  oracle::StepJudgement judgement;
};

inline std::vector<detector::TrianglePair> CuratedStep::lost_feature_pairs() const {
  const auto mesh = oracle::mesh_features(triangles);
  const oracle::Candidates candidates = k();
  std::vector<detector::TrianglePair> lost;
  const detector::SteppedMesh motion = {x_t0, x_t1};
  auto path = [&](std::int32_t v) { return motion.path(v); };
  auto add = [&](std::span<const std::int32_t> of_a, std::span<const std::int32_t> of_b) {
    std::vector<detector::TrianglePair> pairs;
    for (const auto s : of_a) {
      for (const auto t : of_b) {
        pairs.push_back({std::min(s, t), std::max(s, t)});
        if (candidates.holds(pairs.back())) return;
      }
    }
    lost.insert(lost.end(), pairs.begin(), pairs.end());
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.faces.size()); ++f) {
      const auto& face = mesh.faces[static_cast<std::size_t>(f)];
      if (oracle::holds(face, mesh.vertices[i])) continue;
      const detector::VertexFace query{path(mesh.vertices[i]),
                                       {path(face[0]), path(face[1]), path(face[2])}};
      if (oracle::vertex_face_contact(query, detector::Want::yes_no).contact) {
        add(mesh.triangles_of_vertex.of(i), {&f, 1});
      }
    }
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.edges.size(); ++j) {
      const auto &a = mesh.edges[i], &b = mesh.edges[j];
      if (oracle::share_vertex(a, b)) continue;
      const detector::EdgeEdge query{{path(a[0]), path(a[1])}, {path(b[0]), path(b[1])}};
      if (oracle::edge_edge_contact(query, detector::Want::yes_no).contact) {
        add(mesh.triangles_of_edge.of(i), mesh.triangles_of_edge.of(j));
      }
    }
  }
  return lost;
}

}  // namespace assay::properties::test
