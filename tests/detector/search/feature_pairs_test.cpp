// Feature pairs at representatives: those of all candidates, each once, closure rounds included.
#include "detector/search/feature_pairs.h"

#include "detector/search/candidate_search.h"
#include "detector/search/pair_search.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

// A box along axes and diagonals at both ends of the step, in the order of FeaturePoint.
struct Box {
  std::array<float, floats_of_corner> lo, hi;

  static Box of(const FeaturePoints& points, std::span<const std::int32_t> vertices) {
    Box box;
    for (std::size_t k = 0; k < floats_of_corner; ++k) {
      box.lo[k] = box.hi[k] = points[vertices[0]].floats()[k];
      for (const auto v : vertices) {
        box.lo[k] = std::min(box.lo[k], points[v].floats()[k]);
        box.hi[k] = std::max(box.hi[k], points[v].floats()[k]);
      }
    }
    return box;
  }

  static bool apart(const Box& a, const Box& b, const FeatureMargin& margin, bool at_start) {
    constexpr std::size_t lanes = floats_of_corner / 2;
    for (std::size_t k = 0; k < lanes; ++k) {
      const float by = margin.floats()[k];
      const auto below = [&](const Box& p, const Box& q, std::size_t i) {
        return p.hi[i] + by < q.lo[i];
      };
      if (below(a, b, k) && (at_start || below(a, b, k + lanes))) return true;
      if (below(b, a, k) && (at_start || below(b, a, k + lanes))) return true;
    }
    return false;
  }
};

// All feature pairs of a triangle pair whose boxes are not apart, by the definition.
class BruteForce {
 public:
  explicit BruteForce(const MovingMesh& mesh)
      : mesh_(mesh.topology), points_({mesh.x_t0, mesh.x_t1}) {}

  void add(std::int32_t a, std::int32_t b, bool may_pierce, std::set<FeatureKey>& out) const {
    add_one_way(a, b, may_pierce, out);
    add_one_way(b, a, may_pierce, out);
    for (const auto e : mesh_.triangle_edges[at(a)]) {
      for (const auto f : mesh_.triangle_edges[at(b)]) {
        const auto &u = mesh_.edges[at(e)], &v = mesh_.edges[at(f)];
        if (u[0] == v[0] || u[0] == v[1] || u[1] == v[0] || u[1] == v[1]) continue;
        if (apart(edge_box(e), edge_box(f))) continue;
        out.insert(key_of(FeatureKind::edge_edge, std::min(e, f), std::max(e, f)));
      }
    }
  }

 private:
  Box edge_box(std::int32_t e) const { return Box::of(points_, mesh_.edges[at(e)]); }
  bool apart(const Box& a, const Box& b, bool at_start = false) const {
    return Box::apart(a, b, points_.margin(), at_start);
  }
  void add_one_way(std::int32_t a, std::int32_t b, bool may_pierce,
                   std::set<FeatureKey>& out) const {
    const auto& face = mesh_.triangles[at(b)];
    const Box face_box = Box::of(points_, face);
    const auto holds = [&](std::int32_t v) {
      return std::find(face.begin(), face.end(), v) != face.end();
    };
    for (const auto v : mesh_.triangles[at(a)]) {
      if (holds(v) || apart(Box::of(points_, {&v, 1}), face_box)) continue;
      out.insert(key_of(FeatureKind::vertex_face, v, b));
    }
    for (const auto e : mesh_.triangle_edges[at(a)]) {
      if (!may_pierce || holds(mesh_.edges[at(e)][0]) || holds(mesh_.edges[at(e)][1])) continue;
      if (apart(edge_box(e), face_box) || apart(edge_box(e), face_box, true)) continue;
      out.insert(key_of(FeatureKind::piercing, e, b));
    }
  }
  const Topology& mesh_;
  FeaturePoints points_;
};

// A search of its own beside the one under test: every triangle pair that is asked for.
class Sequence {
 public:
  Sequence(SearchMeshes& random, const MovingMesh& mesh)
      : random_(random),
        mesh_(mesh),
        tree_(mesh.topology, mesh.x_t0),
        memory_(mesh.topology, tree_),
        pairs_(mesh.topology, {mesh.x_t0, mesh.x_t1}, memory_.representatives, memory_.marks.types),
        brute_force_(mesh) {
    tree_.refit(mesh.topology, {mesh.x_t0, mesh.x_t1});
  }

  void mark(const std::vector<TriangleType>& types) {
    MarkingCounts counts;
    Marking().bring_to(types, tree_, memory_.marks, counts);
    memory_.representatives.update(mesh_.topology, memory_.marks.types, memory_.marks.changed);
  }

  // Every feature pair found is new in this step; returns how many.
  std::size_t search(const PairTables& tables) {
    const Topology& mesh = mesh_.topology;
    const auto& types = memory_.marks.types;
    const auto may_pierce = [&](std::int32_t a, std::int32_t b) {
      return mesh.component_of_triangle[at(a)] != mesh.component_of_triangle[at(b)] ||
             (types[at(a)] == TriangleType::dirty && types[at(b)] == TriangleType::dirty);
    };
    const SearchInput input{mesh, tree_, memory_.marks, tables};
    SearchCounts counts;
    std::vector<FeatureKey> found;
    WideSearch().search(input, counts, [&](std::int32_t a, std::int32_t b) {
      const std::size_t before = found.size();
      if (random_.below(2)) std::swap(a, b);
      pairs_.append(a, b, may_pierce(a, b), found);
      EXPECT_LE(found.size() - before, FeaturePairs::max_keys);
      return true;
    });
    std::set<FeatureKey> wanted;
    ExhaustiveSearch().search(input, counts, [&](std::int32_t a, std::int32_t b) {
      brute_force_.add(a, b, may_pierce(a, b), wanted);
      return true;
    });
    std::set<FeatureKey> fresh;
    for (const auto key : wanted) {
      if (known_.insert(key).second) fresh.insert(key);
    }
    EXPECT_EQ(std::set<FeatureKey>(found.begin(), found.end()), fresh);
    EXPECT_EQ(found.size(), fresh.size()) << "some feature pair twice";
    return found.size();
  }

  // A step: K, then rounds of the closure in which random triangles join H.
  std::size_t step(const PairRule& rule, const std::vector<TriangleType>& start) {
    known_.clear();
    mark(start);
    std::vector<TriangleType> types = start;
    pairs_.ask(AskedTypes::in_first_search(rule.candidates()));
    std::size_t found = search(rule.candidates());
    pairs_.ask(AskedTypes::in_closure(rule.candidates(), rule.closure()));
    for (int round = 0; round < 3; ++round) {
      for (auto& type : types) {
        if (type == TriangleType::positive_grown) type = TriangleType::positive_joined;
        if (type == TriangleType::negative_grown) type = TriangleType::negative_joined;
        if (random_.below(10)) continue;
        if (type == TriangleType::positive) type = TriangleType::positive_grown;
        if (type == TriangleType::negative) type = TriangleType::negative_grown;
      }
      mark(types);
      found += search(rule.closure());
    }
    return found;
  }

 private:
  SearchMeshes& random_;
  const MovingMesh& mesh_;
  BoundingVolumeTree tree_;
  SearchMemory memory_;
  FeaturePairs pairs_;
  BruteForce brute_force_;
  std::set<FeatureKey> known_;
};

TEST(FeaturePairs, L7_AreThoseOfAllCandidatesEachOnce) {
  SearchMeshes random(11);
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round) {
    const MovingMesh mesh = random.sheets(1 + round % 3, 2 + round % 4, round % 2 == 1);
    Sequence sequence(random, mesh);
    std::vector<TriangleType> types(mesh.topology.triangles.size(), TriangleType::positive);
    for (int step = 0; step < 4; ++step) {
      random.change(types, 1 + random.below(12));
      found += sequence.step(PairRule(), types);
    }
  }
  EXPECT_GT(found, 10000u);
}

TEST(FeaturePairs, OfEveryPairEachOnce) {
  SearchMeshes random(12);
  std::size_t found = 0;
  for (int round = 0; round < 10; ++round) {
    const MovingMesh mesh = random.sheets(1 + round % 3, 5, round % 2 == 1);
    Sequence sequence(random, mesh);
    const std::vector<TriangleType> all_dirty(mesh.topology.triangles.size(), TriangleType::dirty);
    sequence.mark(all_dirty);
    found += sequence.search(EveryPair().candidates());
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace assay::tests
