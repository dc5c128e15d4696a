#include "oracle/mesh/feature_pairs.h"

#include <algorithm>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

namespace assay::oracle {

using detector::FeatureKind;

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

constexpr std::chrono::milliseconds time_between_questions{2};

}  // namespace

StopGate::StopGate(detector::StopFunction stop)
    : stop_(std::move(stop)), next_(Clock::time_point::min().time_since_epoch().count()) {}

bool StopGate::stopped() {
  if (was_stopped()) return true;
  if (!stop_) return false;
  const Clock::time_point now = Clock::now();
  if (now.time_since_epoch().count() < next_.load(std::memory_order_relaxed)) return false;
  const std::unique_lock lock(asking_, std::try_to_lock);
  if (!lock) return was_stopped();
  if (stop_()) stopped_.store(true, std::memory_order_relaxed);
  next_.store((Clock::now() + time_between_questions).time_since_epoch().count(),
              std::memory_order_relaxed);
  return was_stopped();
}

namespace {

constexpr std::size_t features_at_once = 128;  // features a thread takes at once

// Calls work(begin, end, worker) for consecutive chunks that cover [0, count); whichever thread is
// free takes the next chunk. Once the gate has stopped, no further chunk is begun; within a chunk
// `work` asks the gate itself. If calls throw, rethrows the first exception.
using ChunkWork = std::function<void(std::size_t begin, std::size_t end, int worker)>;
void for_each_chunk(std::size_t count, int jobs, StopGate& gate, const ChunkWork& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::mutex failure_lock;
  std::exception_ptr failure;
  auto run = [&](int worker) {
    try {
      while (!failed && !gate.stopped()) {
        const std::size_t begin = next.fetch_add(features_at_once);
        if (begin >= count) return;
        work(begin, std::min(begin + features_at_once, count), worker);
      }
    } catch (...) {
      const std::lock_guard guard(failure_lock);
      if (!failure) failure = std::current_exception();
      failed = true;
    }
  };
  const std::size_t chunks = (count + features_at_once - 1) / features_at_once;
  const auto threads = static_cast<int>(
      std::min(static_cast<std::size_t>(std::max(jobs, 1)), std::max<std::size_t>(chunks, 1)));
  {
    std::vector<std::jthread> helpers;
    for (int worker = 1; worker < threads; ++worker) helpers.emplace_back(run, worker);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

template <class BoxOf, class Visit>
void for_each_meeting(std::size_t items, const BoxOf& box_of, const BoxTree& tree,
                      const Workers& workers, const Visit& visit) {
  StopGate never({});
  StopGate& gate = workers.gate ? *workers.gate : never;
  std::vector<std::vector<std::int32_t>> partners(std::max(workers.jobs, 1));
  for_each_chunk(items, workers.jobs, gate, [&](std::size_t begin, std::size_t end, int worker) {
    for (std::size_t item = begin; item < end; ++item) {
      tree.meeting(box_of(item), partners[worker]);
      for (const std::int32_t other : partners[worker]) {
        if (gate.stopped()) return;
        visit(item, other, worker);
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

void for_each_pair(const FeatureIndex& a, const FeatureIndex& b, FeatureKind kind,
                   const Workers& workers, const VisitPair& visit) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  if (kind == FeatureKind::vertex_face) {
    for_each_meeting(
        fa.vertices.size(), [&](std::size_t i) { return a.box_of(std::array{fa.vertices[i]}); },
        b.faces(), workers,
        [&](std::size_t i, std::int32_t j, int worker) {
          const std::int32_t v = fa.vertices[i];
          const Face& f = fb.faces[j];
          if (holds(f, v)) return;
          visit({{kind, {v, f[0], f[1], f[2], -1}}, fa.triangles_of_vertex.of(i), {&j, 1}}, worker);
        });
    return;
  }
  const auto box_of = [&](std::size_t i) { return a.box_of(fa.edges[i]); };
  if (kind == FeatureKind::piercing) {
    for_each_meeting(
        fa.edges.size(), box_of, b.faces(), workers,
        [&](std::size_t i, std::int32_t j, int worker) {
          const Edge& e = fa.edges[i];
          const Face& f = fb.faces[j];
          if (holds(f, e[0]) || holds(f, e[1])) return;
          visit({{kind, {e[0], e[1], f[0], f[1], f[2]}}, fa.triangles_of_edge.of(i), {&j, 1}},
                worker);
        });
    return;
  }
  for_each_meeting(fa.edges.size(), box_of, b.edges(), workers,
                   [&](std::size_t i, std::int32_t j, int worker) {
                     const auto other = static_cast<std::size_t>(j);
                     const Edge &e = fa.edges[i], &o = fb.edges[other];
                     if ((&a == &b && i >= other) || share_vertex(e, o)) return;
                     visit({{kind, {e[0], e[1], o[0], o[1], -1}},
                            fa.triangles_of_edge.of(i),
                            fb.triangles_of_edge.of(other)},
                           worker);
                   });
}

void for_each_face_face(const FeatureIndex& mesh, const Workers& workers, const VisitFaces& visit) {
  const auto& faces = mesh.features().faces;
  for_each_meeting(
      faces.size(), [&](std::size_t i) { return mesh.box_of(faces[i]); }, mesh.faces(), workers,
      [&](std::size_t i, std::int32_t other, int worker) {
        const auto face = static_cast<std::int32_t>(i);
        if (face < other) visit(face, other, worker);
      });
}

void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeaturesMeet& test,
                      const Workers& workers, const PairVisitor& visitor, bool asks_piercing) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  if (fa.faces.empty() || fb.faces.empty()) return;
  const auto judge = [&](const FeatureIndex& one, const FeatureIndex& other, FeatureKind kind,
                         const PairVisitor& of) {
    for_each_pair(one, other, kind, workers, [&](const FeaturePair& pair, int worker) {
      std::optional<bool> meet;  // tested where some pair of triangles matters
      for (const std::int32_t s : pair.of_first) {
        for (const std::int32_t t : pair.of_second) {
          if (!of.matters(s, t)) continue;
          if (!meet) meet = test(pair.feature);
          if (!*meet) return;
          of.meet(s, t, worker);
        }
      }
    });
  };
  const auto against_faces = [&](const FeatureIndex& one, const FeatureIndex& other,
                                 const PairVisitor& of) {
    judge(one, other, FeatureKind::vertex_face, of);
    if (asks_piercing) judge(one, other, FeatureKind::piercing, of);
  };
  against_faces(a, b, visitor);
  if (&a == &b) {
    for (const auto& [s, t] : same_vertices_pairs(fa.faces)) {
      if (visitor.matters(s, t)) visitor.meet(s, t, 0);
    }
  } else {
    against_faces(
        b, a,
        {[&](std::int32_t s, std::int32_t t) { return visitor.matters(t, s); },
         [&](std::int32_t s, std::int32_t t, int worker) { visitor.meet(t, s, worker); }});
  }
  judge(a, b, FeatureKind::edge_edge, visitor);
}

}  // namespace assay::oracle
