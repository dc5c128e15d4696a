// Marking of the partial trees: the flags after any sequence of changes, what marking costs, and
// which nodes a search skips.
#include "detector/search/pair_rule.h"
#include "detector/search/pair_search.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

std::uint8_t flags_below(const BoundingVolumeTree& tree, const std::vector<TriangleType>& types,
                         std::int32_t node) {
  if (tree.is_leaf(node)) return flags_of(types[at(tree.triangle(node))]);
  return flags_below(tree, types, tree.child(node)) |
         flags_below(tree, types, tree.child(node) + 1);
}

void expect_marked(const BoundingVolumeTree& tree, const Marks& marks,
                   const std::vector<TriangleType>& types) {
  ASSERT_EQ(marks.types, types);
  for (std::size_t n = 0; n < tree.node_count(); ++n)
    ASSERT_EQ(marks.node_flags[n], flags_below(tree, types, static_cast<std::int32_t>(n)));
}

void expect_same(const Topology& mesh, const Representatives& representatives,
                 const std::vector<TriangleType>& types) {
  Representatives fresh(mesh);
  std::vector<std::int32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  fresh.update(mesh, types, all);
  for (const auto t : all) ASSERT_EQ(representatives.of(t, mesh), fresh.of(t, mesh));
  const auto vertices = static_cast<std::int32_t>(mesh.vertex_triangles.starts.size()) - 1;
  for (std::int32_t v = 0; v < vertices; ++v)
    ASSERT_EQ(representatives.types_of_vertex(v), fresh.types_of_vertex(v));
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh.edges.size()); ++e)
    ASSERT_EQ(representatives.types_of_edge(e), fresh.types_of_edge(e));
}

std::uint64_t depth_of(const BoundingVolumeTree& tree, std::int32_t triangle) {
  std::uint64_t depth = 1;
  for (auto n = tree.leaf_of(triangle); n != BoundingVolumeTree::root; n = tree.parent(n)) ++depth;
  return depth;
}

TEST(Marking, AtFirstEverythingIsPositive) {
  Fitted fitted(SearchMeshes(1).sheets(2, 4, false));
  auto& [mesh, tree, marks] = fitted;
  const std::vector<TriangleType> positive(mesh.topology.triangles.size(), TriangleType::positive);
  expect_marked(tree, marks, positive);
  MarkingCounts counts;
  Marking().bring_to(positive, tree, marks, counts);
  EXPECT_EQ(counts.changed + counts.marked + counts.cleared, 0u);
}

// Where a quarter or more of a large mesh changes, one pass goes over all nodes. The flags and the
// counts are those of a walk upward from each triangle.
TEST(Marking, OnePassOverAllNodesCountsAsTheWalksDo) {
  SearchMeshes random(7);
  const MovingMesh mesh = random.sheets(2, 24, false);
  ASSERT_GE(mesh.topology.triangles.size(), 2048u);
  const BoundingVolumeTree tree(mesh.topology, mesh.x_t0);
  Marks at_once(tree), one_by_one(tree);
  std::vector<TriangleType> types = at_once.types;
  for (int step = 0; step < 10; ++step) {
    std::vector<Marking::Change> changes;
    for (std::size_t t = 0; t < types.size(); ++t) {
      if (step > 0 && random.below(2) == 0) continue;
      // The first time all change to one type, as in a step without views.
      types[t] = step == 0 ? TriangleType::violated : static_cast<TriangleType>(random.below(5));
      changes.push_back({static_cast<std::int32_t>(t), types[t]});
    }
    MarkingCounts counts, walked;
    Marking().bring_to(types, tree, at_once, counts);
    Marking().change(changes, tree, one_by_one, walked);
    ASSERT_EQ(at_once.node_flags, one_by_one.node_flags) << step;
    EXPECT_EQ(at_once.types, one_by_one.types) << step;
    EXPECT_EQ(at_once.changed, one_by_one.changed) << step;
    EXPECT_EQ(std::tuple(counts.changed, counts.marked, counts.cleared),
              std::tuple(walked.changed, walked.marked, walked.cleared))
        << step;
  }
}

// After any sequence of markings, closures among them, flags are those marked from scratch, and the
// work is bounded by the triangles that changed.
TEST(Marking, FlagsAreThoseFromScratch) {
  SearchMeshes random(2);
  for (int round = 0; round < 20; ++round) {
    const MovingMesh mesh = random.sheets(1 + round % 4, 1 + round % 6, false);
    const BoundingVolumeTree tree(mesh.topology, mesh.x_t0);
    Marks marks(tree);
    Representatives representatives(mesh.topology);
    std::vector<TriangleType> types = marks.types;
    for (int step = 0; step < 30; ++step) {
      const std::vector<TriangleType> before = types;
      MarkingCounts counts;
      if (step % 3 == 2) {
        // What joined the closure, as changes.
        std::vector<Marking::Change> changes;
        for (std::size_t t = 0; t < types.size(); ++t) {
          if (types[t] != TriangleType::positive || random.below(4)) continue;
          types[t] = TriangleType::positive_grown;
          changes.push_back({static_cast<std::int32_t>(t), types[t]});
          changes.push_back(changes.back());  // twice does no harm
        }
        Marking().change(changes, tree, marks, counts);
      } else {
        random.change(types, 1 << random.below(6));
        Marking().bring_to(types, tree, marks, counts);
      }
      representatives.update(mesh.topology, marks.types, marks.changed);
      expect_marked(tree, marks, types);
      expect_same(mesh.topology, representatives, types);
      std::uint64_t changed = 0, path = 0;
      for (std::size_t t = 0; t < types.size(); ++t) {
        if (flags_of(types[t]) == flags_of(before[t])) continue;
        ++changed;
        path += depth_of(tree, static_cast<std::int32_t>(t));
      }
      EXPECT_EQ(counts.changed, changed);
      EXPECT_LE(counts.marked, path);
      EXPECT_LE(counts.cleared, path);
    }
  }
}

// One triangle of many: its path and no more.
TEST(Marking, WorkIsThatOfTheChange) {
  Fitted fitted(SearchMeshes(3).sheets(1, 30, false));
  auto& [mesh, tree, marks] = fitted;
  std::vector<TriangleType> types = marks.types;
  types[100] = TriangleType::zero;
  MarkingCounts first, second;
  Marking().bring_to(types, tree, marks, first);
  EXPECT_EQ(first.changed, 1u);
  EXPECT_EQ(first.marked, depth_of(tree, 100));
  EXPECT_EQ(first.cleared, 1u);  // P of the leaf; its sibling keeps P above
  types[100] = TriangleType::positive;
  Marking().bring_to(types, tree, marks, second);
  EXPECT_EQ(second.marked, 1u);
  EXPECT_EQ(second.cleared, depth_of(tree, 100));
}

// Of two flags that a triangle gets at once, the nodes above may have one already.
TEST(Marking, SeveralFlagsAtOnceAllReachTheRoot) {
  Fitted fitted(SearchMeshes(4).sheets(1, 30, false));
  auto& [mesh, tree, marks] = fitted;
  std::vector<TriangleType> types = marks.types;
  MarkingCounts counts;
  for (const auto& [t, type] :
       {std::pair(100, TriangleType::negative), std::pair(7, TriangleType::negative_grown),
        std::pair(100, TriangleType::positive_grown)}) {
    types[at(t)] = type;
    Marking().bring_to(types, tree, marks, counts);
    expect_marked(tree, marks, types);
  }
}

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

Pairs pairs_of(const PairSearch& search, const SearchInput& input, SearchCounts& counts) {
  Pairs out;
  search.search(input, counts, [&](std::int32_t a, std::int32_t b) {
    EXPECT_NE(a, b);
    EXPECT_TRUE(out.insert(std::minmax(a, b)).second) << "found twice";
    return true;
  });
  return out;
}

// The search finds the pairs that are asked for and whose boxes are not apart, with and without
// skipping; skipping tests fewer boxes, if not in every single search.
TEST(Search, L3_PairsAreThoseAskedForWithAndWithoutSkipping) {
  SearchMeshes random(4);
  std::uint64_t with = 0, without = 0;
  for (int round = 0; round < 60; ++round) {
    Fitted fitted(random.sheets(1 + round % 3, 2 + round % 5, round % 2 == 1));
    auto& [mesh, tree, marks] = fitted;
    const RoundedPositions points(mesh.motion());
    std::vector<TriangleType> types = marks.types;
    random.change(types, 1 + random.below(20));
    MarkingCounts marking;
    Marking().bring_to(types, tree, marks, marking);
    for (const PairTables& tables : {PairRule().candidates(), EveryPair().candidates()}) {
      const SearchInput input{mesh.topology, tree, marks, tables};
      SearchCounts on, off, exhaustive;
      const Pairs found = pairs_of(TreeSearch(TreeSearch::Skipping::on), input, on);
      EXPECT_EQ(found, pairs_of(TreeSearch(TreeSearch::Skipping::off), input, off));
      Pairs expected;
      for (const auto& [a, b] : pairs_of(ExhaustiveSearch(), input, exhaustive)) {
        const auto &ta = mesh.topology.triangles[at(a)], &tb = mesh.topology.triangles[at(b)];
        if (!apart(points.box(ta), points.box(tb))) expected.insert({a, b});
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(off.skipped + off.child_counts, 0u);
      with += on.box_tests;
      without += off.box_tests;
    }
  }
  EXPECT_LT(with, without);
}

// With one negative triangle among positive ones only pairs with it are asked for. On each level k
// of its d levels below the root the node above it meets its sibling, and goes down to it at once:
// d - k nodes are skipped, whether first or second children lead there.
TEST(Search, L3_SkippingGoesDownToTheOnlyPartnerAtOnce) {
  const Fitted fitted(SearchMeshes(4).sheets(1, 5, false));
  const auto& [mesh, tree, none] = fitted;
  const PairTables tables = PairRule().candidates();
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
    Marks marks = none;
    std::vector<TriangleType> types = marks.types;
    types[t] = TriangleType::negative;
    MarkingCounts marking;
    Marking().bring_to(types, tree, marks, marking);
    SearchCounts counts;
    pairs_of(TreeSearch(TreeSearch::Skipping::on), {mesh.topology, tree, marks, tables}, counts);
    const std::uint64_t levels = depth_of(tree, static_cast<std::int32_t>(t)) - 1;
    EXPECT_EQ(counts.skipped, levels * (levels - 1) / 2) << t;
  }
}

TEST(Search, StopsWhereTheSinkSays) {
  const Fitted fitted(SearchMeshes(5).sheets(2, 4, true));
  const auto& [mesh, tree, marks] = fitted;
  const PairTables tables = EveryPair().candidates();
  int calls = 0;
  SearchCounts counts;
  EXPECT_FALSE(TreeSearch().search({mesh.topology, tree, marks, tables}, counts,
                                   [&](auto, auto) { return ++calls < 3; }));
  EXPECT_EQ(calls, 3);
}

// Searches of the tree: by one box, and what they cost.

TEST(SearchBox, FindsWhatIsNotApartAndStopsWhenTold) {
  SearchMeshes meshes(5);
  for (int i = 0; i < 20; ++i) {
    Fitted fitted(meshes.sheets(3, 4, i % 2 == 0));
    auto& [mesh, tree, marks] = fitted;
    tree.join_boxes(nullptr);
    const auto box = tree.box_of_triangle(mesh.topology.triangles[7], mesh.motion());
    std::set<std::int32_t> expected, found;
    for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
      const auto triangle = static_cast<std::int32_t>(t);
      if (!apart(box, tree.box(tree.leaf_of(triangle)))) expected.insert(triangle);
    }
    SearchCounts counts;
    const auto all = [&](std::int32_t t) { return found.insert(t).second; };
    EXPECT_TRUE(search_box(tree, box, counts, all));
    EXPECT_EQ(found, expected);
    EXPECT_EQ(counts.candidate_pairs, expected.size());
    std::size_t calls = 0;
    const auto half = [&](std::int32_t) { return ++calls < (expected.size() + 1) / 2; };
    EXPECT_FALSE(search_box(tree, box, counts, half));
    EXPECT_EQ(calls, (expected.size() + 1) / 2);
  }
}

// Triangles of no common vertex, each of size one, at the places given.
struct Scattered {
  explicit Scattered(const std::vector<Eigen::RowVector3d>& places) {
    const auto n = static_cast<Eigen::Index>(places.size());
    triangles.resize(n, 3);
    x.resize(3 * n, 3);
    std::iota(triangles.data(), triangles.data() + 3 * n, 0);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& place = places[static_cast<std::size_t>(i)];
      x.middleRows(3 * i, 3) << place, place + Eigen::RowVector3d(1, 0, 0),
          place + Eigen::RowVector3d(0, 1, 1);
    }
  }
  Triangles triangles;
  Positions x;
};

// All triangles are violated, as in a step without views.
SearchCounts searched(const Topology& mesh, const Positions& x, TreeSearch::Skipping skipping) {
  BoundingVolumeTree tree(mesh, x);
  tree.refit(mesh, {x, x});
  Marks marks(tree);
  MarkingCounts marking;
  Marking().bring_to(std::vector(mesh.triangles.size(), TriangleType::violated), tree, marks,
                     marking);
  const PairTable all = PairTable().add(flag::violated, flag::violated);
  SearchCounts counts;
  const auto sink = [](std::int32_t, std::int32_t) { return true; };
  EXPECT_TRUE(TreeSearch(skipping).search({mesh, tree, marks, {all, all}}, counts, sink));
  return counts;
}

// Two groups of two: the boxes of the groups are apart, and in each group those of its two.
TEST(TreeSearch, GroupsThatAreApartTakeOneBoxTest) {
  const Scattered four({{0, 0, 0}, {4, 0, 0}, {100, 0, 0}, {104, 0, 0}});
  const Topology mesh = make_topology(four.triangles, four.x.rows());
  EXPECT_EQ(searched(mesh, four.x, TreeSearch::Skipping::on).box_tests, 3u);
}

TEST(TreeSearch, NoChildrenAreCountedWhereEveryTriangleIsAskedFor) {
  const MovingMesh mesh = SearchMeshes(3).sheets(3, 6, false);
  const auto counts = searched(mesh.topology, mesh.x_t0, TreeSearch::Skipping::on),
             without = searched(mesh.topology, mesh.x_t0, TreeSearch::Skipping::off);
  EXPECT_EQ(counts.child_counts, 0u);
  EXPECT_EQ(counts.skipped, 0u);
  EXPECT_EQ(counts.box_tests, without.box_tests);
}

// The centre of a triangle is a sum over its corners, which must not overflow.
TEST(BoundingVolumeTree, SplitsTheLargestCoordinatesAsItSplitsSmallOnes) {
  const MovingMesh mesh = SearchMeshes(4).sheets(1, 8, false);
  // Between 13 and 15 sixteenths of one, and the same of the power that is no double any more.
  const Positions x = mesh.x_t0.array() / (16 * mesh.x_t0.cwiseAbs().maxCoeff()) + .875;
  const Positions huge = x * 0x1p512 * 0x1p512;
  ASSERT_GE(huge.cwiseAbs().maxCoeff(), .5 * std::numeric_limits<double>::max());
  ASSERT_TRUE(huge.allFinite());
  const BoundingVolumeTree small(mesh.topology, x), large(mesh.topology, huge);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.topology.triangles.size()); ++t)
    EXPECT_EQ(small.leaf_of(t), large.leaf_of(t));
}

}  // namespace
}  // namespace assay::tests
