#include "oracle/mesh/feature_pairs.h"

#include <algorithm>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

namespace assay::oracle {

namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using Entry = std::pair<TreeBox, std::int32_t>;
constexpr std::size_t node_size = 8;  // faster than 16 and 32 by 5 and 10 % on 80,000 triangles

TreeBox tree_box(const Box& b) {
  return {TreePoint(b.min[0], b.min[1], b.min[2]), TreePoint(b.max[0], b.max[1], b.max[2])};
}

std::vector<Entry> entries(const std::vector<Box>& boxes) {
  std::vector<Entry> result;
  result.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    result.emplace_back(tree_box(boxes[i]), static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace

struct BoxTree::Tree {
  bg::index::rtree<Entry, bg::index::linear<node_size>> packed;
};

BoxTree::BoxTree(const std::vector<Box>& boxes)
    : tree_(std::make_unique<Tree>(Tree{decltype(Tree::packed)(entries(boxes))})) {}

BoxTree::~BoxTree() = default;

void BoxTree::meeting(const Box& box, std::vector<std::int32_t>& found) const {
  found.clear();
  tree_->packed.query(
      bg::index::intersects(tree_box(box)),
      boost::make_function_output_iterator([&](const Entry& e) { found.push_back(e.second); }));
}

namespace {

constexpr std::size_t features_at_once = 128;  // features a thread takes at once

template <class BoxOf, class Accept>
void for_each_meeting(std::size_t items, const BoxOf& box_of, const BoxTree& tree,
                      const Workers& workers, const Accept& accept, const VisitFeatures& visit) {
  StopGate never({});
  StopGate& gate = workers.gate ? *workers.gate : never;
  std::vector<std::vector<std::int32_t>> partners(std::max(workers.jobs, 1));
  for_each_chunk(items, features_at_once, workers.jobs, gate,
                 [&](std::size_t begin, std::size_t end, int worker) {
                   for (std::size_t item = begin; item < end; ++item) {
                     tree.meeting(box_of(item), partners[worker]);
                     for (const std::int32_t other : partners[worker]) {
                       if (gate.stopped()) return;
                       if (accept(item, other)) visit(item, other, worker);
                     }
                   }
                 });
}

}  // namespace

BoxOfVertices swept_boxes(const detector::SteppedMesh& motion) {
  return [motion](std::span<const std::int32_t> vertices) {
    // A case for each number of vertices, so that the loop over them is unrolled, because a step
    // has some 10 boxes a vertex.
    switch (vertices.size()) {
      case 1:
        return swept_box(motion, vertices.first<1>());
      case 2:
        return swept_box(motion, vertices.first<2>());
      default:
        return swept_box(motion, vertices);
    }
  };
}

FeatureIndex::FeatureIndex(const MeshFeatures& features, BoxOfVertices box_of)
    : features_(features), box_of_(std::move(box_of)) {}

template <class Features>
std::unique_ptr<BoxTree> FeatureIndex::tree_of(const Features& features) const {
  std::vector<Box> boxes;
  boxes.reserve(features.size());
  for (const auto& f : features) boxes.push_back(box_of_(f));
  return std::make_unique<BoxTree>(boxes);
}

const BoxTree& FeatureIndex::faces() const {
  if (!faces_) faces_ = tree_of(features_.faces);
  return *faces_;
}

const BoxTree& FeatureIndex::edges() const {
  if (!edges_) edges_ = tree_of(features_.edges);
  return *edges_;
}

void for_each_vertex_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                          const VisitFeatures& visit) {
  const auto& vertices = a.features().vertices;
  const auto& faces = b.features().faces;
  for_each_meeting(
      vertices.size(), [&](std::size_t i) { return a.box_of(std::array{vertices[i]}); }, b.faces(),
      workers, [&](std::size_t i, std::int32_t f) { return !holds(faces[f], vertices[i]); }, visit);
}

void for_each_edge_edge(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit) {
  const auto &of_a = a.features().edges, &of_b = b.features().edges;
  const bool same = &a == &b;
  for_each_meeting(
      of_a.size(), [&](std::size_t i) { return a.box_of(of_a[i]); }, b.edges(), workers,
      [&](std::size_t i, std::int32_t j) {
        return !(same && i >= static_cast<std::size_t>(j)) && !share_vertex(of_a[i], of_b[j]);
      },
      visit);
}

void for_each_edge_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit) {
  const auto& edges = a.features().edges;
  const auto& faces = b.features().faces;
  for_each_meeting(
      edges.size(), [&](std::size_t i) { return a.box_of(edges[i]); }, b.faces(), workers,
      [&](std::size_t i, std::int32_t f) {
        return !holds(faces[f], edges[i][0]) && !holds(faces[f], edges[i][1]);
      },
      visit);
}

void for_each_face_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit) {
  const auto& faces = a.features().faces;
  const bool same = &a == &b;
  for_each_meeting(
      faces.size(), [&](std::size_t i) { return a.box_of(faces[i]); }, b.faces(), workers,
      [&](std::size_t i, std::int32_t j) { return !(same && i >= static_cast<std::size_t>(j)); },
      visit);
}

namespace {

using Holders = std::span<const std::int32_t>;  // the triangles that hold a feature

template <class Test>
void judge(const Holders& of_a, const Holders& of_b, const PairVisitor& visitor, int worker,
           const Test& test) {
  auto some_wanted = [&] {
    for (const std::int32_t s : of_a) {
      for (const std::int32_t t : of_b) {
        if (visitor.matters(s, t)) return true;
      }
    }
    return false;
  };
  if (!some_wanted() || !test()) return;
  for (const std::int32_t s : of_a) {
    for (const std::int32_t t : of_b) {
      if (visitor.matters(s, t)) visitor.meet(s, t, worker);
    }
  }
}

// Tests vertices and edges of a against faces of b.
void against_faces(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                   const Workers& workers, const PairVisitor& visitor) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  for_each_vertex_face(a, b, workers, [&](std::size_t i, std::size_t f, int worker) {
    const auto face = static_cast<std::int32_t>(f);
    judge(fa.triangles_of_vertex.of(i), {&face, 1}, visitor, worker,
          [&] { return tests.vertex_face(fa.vertices[i], fb.faces[f]); });
  });
  if (!tests.piercing) return;
  for_each_edge_face(a, b, workers, [&](std::size_t i, std::size_t f, int worker) {
    const auto face = static_cast<std::int32_t>(f);
    judge(fa.triangles_of_edge.of(i), {&face, 1}, visitor, worker,
          [&] { return tests.piercing(fa.edges[i], fb.faces[f]); });
  });
}

}  // namespace

void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                      const Workers& workers, const PairVisitor& visitor) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  if (fa.faces.empty() || fb.faces.empty()) return;
  against_faces(a, b, tests, workers, visitor);
  if (&a == &b) {
    for (const auto& [s, t] : same_vertices_pairs(fa.faces)) {
      if (visitor.matters(s, t)) visitor.meet(s, t, 0);
    }
  } else {
    const PairVisitor swapped = {
        [&](std::int32_t s, std::int32_t t) { return visitor.matters(t, s); },
        [&](std::int32_t s, std::int32_t t, int worker) { visitor.meet(t, s, worker); }};
    against_faces(b, a, tests, workers, swapped);
  }
  for_each_edge_edge(a, b, workers, [&](std::size_t i, std::size_t j, int worker) {
    judge(fa.triangles_of_edge.of(i), fb.triangles_of_edge.of(j), visitor, worker,
          [&] { return tests.edge_edge(fa.edges[i], fb.edges[j]); });
  });
}

}  // namespace assay::oracle
