// Candidate feature pairs of two meshes, or of one mesh with itself: pairs whose boxes meet and
// that share no vertex. Several threads find the pairs, and hand each pair to the caller's visitor
// immediately. The visitor tests the pair exactly. No pair is stored, and the caller can stop the
// threads.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

struct Box {
  detector::Point min, max;
};

// Returns the box that holds some vertices over the whole step. The places of a vertex at t=0 and
// t=1 suffice, because its path is the segment between them.
template <class Vertices>
Box swept_box(const detector::SteppedMesh& motion, const Vertices& vertices) {
  Box box{motion.start(vertices[0]), motion.start(vertices[0])};
  for (const std::int32_t v : vertices) {
    for (int k = 0; k < 3; ++k) {
      for (const double x : {motion.vertices_t0(v, k), motion.vertices_t1(v, k)}) {
        if (x < box.min[k]) box.min[k] = x;
        if (x > box.max[k]) box.max[k] = x;
      }
    }
  }
  return box;
}

// Finds which of many closed boxes meet another box: a packed R-tree (Boost.Geometry). Its answers
// rest only on comparisons of doubles; rounded sums decide its layout, never an answer. Several
// threads may search at the same time.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);
  ~BoxTree();
  BoxTree(const BoxTree&) = delete;
  BoxTree& operator=(const BoxTree&) = delete;

  // Replaces `found` by the indices of all boxes that meet `box`, touching included, in any order.
  void meeting(const Box& box, std::vector<std::int32_t>& found) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

// Gives the box of a feature from its one, two or three vertices.
using BoxOfVertices = std::function<Box(std::span<const std::int32_t>)>;

// Returns a function that gives the box of a feature over the whole step. REQUIRES that the
// positions outlive the returned function.
BoxOfVertices swept_boxes(const detector::SteppedMesh& motion);

// Finds the features of one mesh by their boxes. Each tree is built when it is first needed. One
// mesh may have several indices: for example, one with the boxes of the whole step and one with the
// boxes at t=0. REQUIRES that the features outlive the index.
class FeatureIndex {
 public:
  FeatureIndex(const MeshFeatures& features, BoxOfVertices box_of);
  FeatureIndex(MeshFeatures&& features, BoxOfVertices box_of) = delete;

  const MeshFeatures& features() const { return features_; }
  Box box_of(std::span<const std::int32_t> vertices) const { return box_of_(vertices); }
  const BoxTree& faces() const;
  const BoxTree& edges() const;

 private:
  template <class Features>
  std::unique_ptr<BoxTree> tree_of(const Features& features) const;

  const MeshFeatures& features_;
  BoxOfVertices box_of_;
  mutable std::unique_ptr<BoxTree> faces_, edges_;
};

// Two features whose boxes meet and that share no vertex, and the triangles that hold each feature.
struct FeaturePair {
  detector::Feature feature;
  std::span<const std::int32_t> of_first, of_second;
};

// Returns the two features as a query. REQUIRES a vertex and a face, or two edges.
inline detector::FourPoints points_of(const detector::SteppedMesh& motion,
                                      const detector::Feature& feature) {
  const auto& v = feature.vertices;
  return {{motion.path(v[0]), motion.path(v[1]), motion.path(v[2]), motion.path(v[3])},
          feature.kind == detector::FeatureKind::vertex_face ? 1 : 2};
}

// Calls the caller's stop function every few milliseconds, from one thread at a time.
class StopGate {
 public:
  explicit StopGate(detector::StopFunction stop);
  // Returns whether the stop function has demanded a stop. Calls the stop function only every few
  // milliseconds, so stopped() is cheap enough to be called for every query.
  bool stopped();
  // Returns whether the stop function has demanded a stop so far. Does not call the stop function.
  bool was_stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  using Clock = std::chrono::steady_clock;
  detector::StopFunction stop_;
  std::mutex asking_;
  std::atomic<bool> stopped_ = false;
  std::atomic<Clock::rep> next_;
};

struct Workers {
  int jobs = 1;              // threads; below 1 counts as 1
  StopGate* gate = nullptr;  // once the gate has stopped, no pair is visited; null: no stop
};

// `worker`, in [0, jobs), is the number of the calling thread. If a call throws, the function that
// visits the pairs throws the first exception again.
using VisitPair = std::function<void(const FeaturePair& pair, int worker)>;
using VisitFaces = std::function<void(std::int32_t of_a, std::int32_t of_b, int worker)>;

// Visits each pair of a vertex of a and a face of b, or of an edge of a and an edge of b, or
// (piercing) of an edge of a and a face of b, whose boxes meet and that share no vertex. If a and b
// are the same object, each pair of edges is visited once, with the lower edge first.
void for_each_pair(const FeatureIndex& a, const FeatureIndex& b, detector::FeatureKind kind,
                   const Workers& workers, const VisitPair& visit);
// Visits the pairs of faces whose boxes meet, also if the two faces share vertices. Each pair is
// visited once, with the lower face first.
void for_each_face_face(const FeatureIndex& mesh, const Workers& workers, const VisitFaces& visit);

// Says of two triangles, the lower first, whether they count.
using WantedPair = std::function<bool(std::int32_t, std::int32_t)>;

// The rest of this file finds pairs of triangles whose features meet, by a test of the caller.

// An exact test of two features: whether they meet.
using FeaturesMeet = std::function<bool(const detector::Feature& feature)>;

struct PairVisitor {
  // Says whether a contact of these two triangles matters. Two features are tested only if
  // `matters` is true for some pair of triangles that hold them. With several jobs both functions
  // are called from several threads.
  std::function<bool(std::int32_t of_a, std::int32_t of_b)> matters;
  // Called for each pair in contact that matters. Called several times for one pair if several of
  // its features meet.
  std::function<void(std::int32_t of_a, std::int32_t of_b, int worker)> meet;
};

// Finds the pairs of a triangle of a and a triangle of b that are in contact. As detector/LAWS.md
// defines, two triangles are in contact if a closed face of one (the triangle, an edge or a vertex)
// meets a closed face of the other, and the two faces share no vertex. If a and b are the same
// object, triangles with the same three vertices are in contact too. If `asks_piercing`, edges are
// also tested for piercing a face.
void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeaturesMeet& test,
                      const Workers& workers, const PairVisitor& visitor,
                      bool asks_piercing = true);

}  // namespace assay::oracle
