// Implements the broad and narrow phase interfaces of the IPC Toolkit by Assay, for a program that
// uses the toolkit:
//
//   AssayBroadPhase broad_phase;
//   const double size = ipc::compute_collision_free_stepsize(
//       mesh, x_t0, x_t1, min_distance, &broad_phase, AssayNarrowPhase());
//
// Alternatively, Detector::limit gives the step size in one call, with end positions that have no
// contact even after rounding. ipc_line_search.cpp shows both ways. ipc_mesh.h states the version
// of the toolkit.
#pragma once

#include <algorithm>
#include <atomic>
#include <ipc/broad_phase/lbvh.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "detector/distance/nearness.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/parallel/workers.h"
#include "detector/search/feature_pairs.h"
#include "detector/search/pair_search.h"

namespace assay::peers {

// Answers vertex-face and edge-edge queries in exact arithmetic on the input doubles, which must be
// finite. Passes point-point and point-edge queries on to the toolkit's Tight-Inclusion.
//
// Let t be the first time in [0,1] at which two features are within min_distance. Then toi is
// conservative_rescaling * t, and a collision is reported if toi <= tmax. Comparing toi, not t,
// keeps the margin of every pair, because the toolkit passes the toi of one pair as tmax of the
// next. toi is never above t. toi is 0 only if t is 0 or below the least positive double.
class AssayNarrowPhase : public ipc::TightInclusionCCD {
  using Vector = Eigen::ConstRef<Eigen::Vector3d>;
  using AnyVector = Eigen::ConstRef<ipc::VectorMax3d>;  // in the plane or in space

 public:
  // REQUIRES a rescaling in (0,1].
  explicit AssayNarrowPhase(double rescaling = 0.95) { conservative_rescaling = rescaling; }

  // How many queries were answered exactly, and how many were passed on to the toolkit.
  mutable std::atomic<std::uint64_t> exact = 0, passed_on = 0;

  bool point_point_ccd(AnyVector p0, AnyVector q0, AnyVector p1, AnyVector q1, double& toi,
                       double min_distance = 0, double tmax = 1) const override {
    ++passed_on;
    return TightInclusionCCD::point_point_ccd(p0, q0, p1, q1, toi, min_distance, tmax);
  }
  bool point_edge_ccd(AnyVector p0, AnyVector a0, AnyVector b0, AnyVector p1, AnyVector a1,
                      AnyVector b1, double& toi, double min_distance = 0,
                      double tmax = 1) const override {
    ++passed_on;
    return TightInclusionCCD::point_edge_ccd(p0, a0, b0, p1, a1, b1, toi, min_distance, tmax);
  }
  bool point_triangle_ccd(Vector p0, Vector a0, Vector b0, Vector c0, Vector p1, Vector a1,
                          Vector b1, Vector c1, double& toi, double min_distance = 0,
                          double tmax = 1) const override {
    const detector::VertexFace query = {path(p0, p1), {path(a0, a1), path(b0, b1), path(c0, c1)}};
    return meet(four_points(query), toi, min_distance, tmax);
  }
  bool edge_edge_ccd(Vector a0, Vector b0, Vector c0, Vector d0, Vector a1, Vector b1, Vector c1,
                     Vector d1, double& toi, double min_distance = 0,
                     double tmax = 1) const override {
    const detector::EdgeEdge query = {{path(a0, a1), path(b0, b1)}, {path(c0, c1), path(d0, d1)}};
    return meet(four_points(query), toi, min_distance, tmax);
  }

 private:
  static detector::MovingPoint path(Vector t0, Vector t1) {
    return {{t0[0], t0[1], t0[2]}, {t1[0], t1[1], t1[2]}};
  }
  bool meet(const detector::FourPoints& query, double& toi, double d, double tmax) const {
    using namespace detector;
    const ProcessorState state;
    ++exact;
    const double until = std::min(1., tmax / conservative_rescaling);
    // To compute an exact time costs more than to prove that it is later than `until`.
    const auto is_later = [&] {
      return d > 0 ? filter_near(query, d).lo > until : surely_later(query, until) != Later::no;
    };
    if (until < 1 && is_later()) return false;
    const auto result =
        d > 0 ? test_near(query, d, Want::first_time) : test_contact(query, Want::first_time);
    if (!result.contact || result.time.hi > until) return false;
    toi = std::min(conservative_rescaling * result.time.lo, tmax);
    if (result.time.lo > 0) toi = std::max(toi, std::numeric_limits<double>::denorm_min());
    return true;
  }
};

// Lists face-vertex and edge-edge candidates by the detector's tree and feature pairs, in one
// thread. The candidates are all pairs without a common vertex that come within twice the inflation
// radius, because both elements of a pair are inflated. With a radius of 0, the list leaves out
// neighbours that are proved apart.
//
// The toolkit's LBVH answers all else: other kinds of candidates, input that is given as boxes, and
// meshes that are two-dimensional, have a vertex or an edge of no face, or list an edge twice or
// not at all. The tree is used again until faces or edges change.
class AssayBroadPhase : public ipc::BroadPhase {
  using Matrix = Eigen::ConstRef<Eigen::MatrixXd>;
  using Indices = Eigen::ConstRef<Eigen::MatrixXi>;
  template <class Candidate>
  using List = std::vector<Candidate>;

 public:
  std::string name() const override { return "Assay"; }
  // How many lists of candidates came from the detector, and how many from LBVH.
  mutable std::uint64_t served = 0, passed_on = 0;

  using ipc::BroadPhase::build;
  void build(Matrix x, Indices edges, Indices faces, double radius = 0) override {
    build(x, x, edges, faces, radius);
  }
  void build(Matrix x0, Matrix x1, Indices edges, Indices faces, double radius = 0) override {
    clear();
    dim = static_cast<std::uint8_t>(x0.cols());
    within_ = 2 * radius;
    if (dim == 3 && faces.rows() > 0 && x0.allFinite() && x1.allFinite()) take(x0, edges, faces);
    if (!is_served_) return lbvh_.build(x0, x1, edges, faces, radius);
    x_t0_ = x0;
    x_t1_ = x1;
  }
  void build(const ipc::AABBs& boxes, Indices edges, Indices faces, std::uint8_t in) override {
    clear();
    dim = in;
    lbvh_.build(boxes, edges, faces, in);
  }
  void clear() override {
    ipc::BroadPhase::clear();
    lbvh_.clear();
    is_served_ = is_found_ = is_lbvh_built_ = false;
  }

  void detect_edge_edge_candidates(List<ipc::EdgeEdgeCandidate>& found) const override {
    if (!is_served_) return lbvh().detect_edge_edge_candidates(found);
    using namespace detector;
    for (const auto key : near()) {
      if (kind_of(key) != FeatureKind::edge_edge) continue;
      const auto e = at(first_of(key)), f = at(second_of(key));
      if (may_collide(topology_.edges[e], topology_.edges[f]))
        found.emplace_back(row_of_edge_[e], row_of_edge_[f]);
    }
  }
  void detect_face_vertex_candidates(List<ipc::FaceVertexCandidate>& found) const override {
    if (!is_served_) return lbvh().detect_face_vertex_candidates(found);
    using namespace detector;
    for (const auto key : near()) {
      if (kind_of(key) != FeatureKind::vertex_face) continue;
      if (may_collide(std::array{first_of(key)}, topology_.triangles[at(second_of(key))]))
        found.emplace_back(second_of(key), first_of(key));
    }
  }
  void detect_vertex_vertex_candidates(List<ipc::VertexVertexCandidate>& found) const override {
    lbvh().detect_vertex_vertex_candidates(found);
  }
  void detect_edge_vertex_candidates(List<ipc::EdgeVertexCandidate>& found) const override {
    lbvh().detect_edge_vertex_candidates(found);
  }
  void detect_edge_face_candidates(List<ipc::EdgeFaceCandidate>& found) const override {
    lbvh().detect_edge_face_candidates(found);
  }
  void detect_face_face_candidates(List<ipc::FaceFaceCandidate>& found) const override {
    lbvh().detect_face_face_candidates(found);
  }

 private:
  // Makes the tree if the edges or faces differ from the edges and faces of the last tree.
  void take(Matrix x, Indices edges, Indices faces) {
    using namespace detector;
    const auto are = [](const Eigen::MatrixXi& a, Indices b) {
      return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
    };
    is_served_ = tree_ && x.rows() == x_t0_.rows() && are(edges_, edges) && are(faces_, faces);
    if (is_served_) return;
    tree_.reset();
    if (check_corners(Triangles(faces), x.rows())) return;
    topology_ = make_topology(Triangles(faces), x.rows());
    const auto& all = topology_.edges;
    row_of_edge_.assign(all.size(), -1);
    for (int row = 0; row < edges.rows(); ++row) {
      const std::array<int, 2> ends = {edges.row(row).minCoeff(), edges.row(row).maxCoeff()};
      const auto edge = std::ranges::lower_bound(all, ends);
      if (edge != all.end() && *edge == ends) row_of_edge_[edge - all.begin()] = row;
    }
    const auto& starts = topology_.vertex_triangles.starts;  // equal starts: a vertex of no face
    is_served_ = edges.rows() == std::ssize(all) && std::ranges::count(row_of_edge_, -1) == 0 &&
                 std::ranges::adjacent_find(starts) == starts.end();
    edges_ = edges;
    faces_ = faces;
    if (is_served_) tree_ = std::make_unique<BoundingVolumeTree>(topology_, Positions(x));
  }
  ipc::BroadPhase& lbvh() const {
    ++passed_on;
    lbvh_.can_vertices_collide = can_vertices_collide;
    if (is_served_ && !std::exchange(is_lbvh_built_, true)) {
      const Eigen::MatrixXd x0 = x_t0_, x1 = x_t1_;
      lbvh_.build(x0, x1, edges_, faces_, within_ / 2);
    }
    return lbvh_;
  }

  // Returns the vertex-face and edge-edge pairs. The first call after build() finds them.
  const std::vector<detector::FeatureKey>& near() const {
    using namespace detector;
    ++served;
    if (std::exchange(is_found_, true)) return near_;
    const ProcessorState state;
    const SteppedMesh motion = {x_t0_, x_t1_};
    tree_->grow_boxes(within_);
    tree_->refit(topology_, motion);
    const Marks marks(*tree_);
    const Representatives representatives(topology_);
    detector::FeaturePairs pairs(topology_, representatives, marks.types);
    pairs.fit(motion, nullptr, within_);
    if (within_ == 0) pairs.prove_apart(motion, tree_->wide(), nullptr, [] {});
    near_.clear();
    const auto take_pair = [&](std::int32_t a, std::int32_t b) {
      if (!pairs.are_proved_apart(a, b)) pairs.append(a, b, false, near_);
      return true;
    };
    const PairTables everything = {PairTable::everything(), PairTable::everything()};
    SearchCounts counts;
    WideSearch().search({topology_, *tree_, marks, everything}, counts, take_pair);
    return near_;
  }
  // Returns whether some vertex of `one` is allowed to collide with some vertex of `other`. The
  // toolkit applies the same rule.
  bool may_collide(std::span<const int> one, std::span<const int> other) const {
    return std::ranges::any_of(one, [&](int v) {
      return std::ranges::any_of(other, [&](int w) { return can_vertices_collide(v, w); });
    });
  }

  // The edges and faces for which tree_ was made.
  Eigen::MatrixXi edges_, faces_;
  detector::Topology topology_;
  std::vector<int> row_of_edge_;  // in edges_, by edge of the topology
  std::unique_ptr<detector::BoundingVolumeTree> tree_;
  detector::Positions x_t0_, x_t1_;
  double within_ = 0;
  bool is_served_ = false;
  mutable bool is_found_ = false, is_lbvh_built_ = false;
  mutable std::vector<detector::FeatureKey> near_;
  mutable ipc::LBVH lbvh_;
};

}  // namespace assay::peers
