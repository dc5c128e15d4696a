// Long work on a mesh, in preprocessing or at the start of a step, calls the stop function after
// every fixed amount of work, and ends if the function says so. The tests count work, not time.
#include "detector/mesh/for_all.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/surface.h"
#include "detector/search/feature_pairs.h"
#include "detector/traditional/traditional.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::detector {
namespace {

constexpr std::uint64_t interval = 2'000;

// Asks so often that between two askings lies no more than `interval` and a piece of a loop, if its
// work is at least `work`; and nothing is asked after the answer that ends it.
void expect_paced(std::uint64_t work, const std::function<void(PacedStop&)>& make) {
  std::uint64_t calls = 0;
  const StopFunction count = [&] { return ++calls, false; };
  PacedStop goes_on(count, interval);
  make(goes_on);
  constexpr std::uint64_t largest_piece = 1024 * 25;
  EXPECT_GE(calls, work / (interval + largest_piece));
  ASSERT_GE(calls, 3u);
  const std::uint64_t all = calls;
  for (const std::uint64_t n : {std::uint64_t{1}, all / 2, all}) {
    calls = 0;
    const StopFunction end = [&] { return ++calls >= n; };
    PacedStop ends(end, interval);
    make(ends);
    EXPECT_TRUE(ends.stopped());
    EXPECT_EQ(calls, n);
  }
}

class Paced : public testing::Test {
 protected:
  tests::SearchMeshes random_{7};
  const tests::MovingMesh mesh_ = random_.sheets(2, 60, false);  // 14,400 triangles
  const Topology& topology_ = mesh_.topology;
  const Triangles rows_ = mesh_.rows();
  const Eigen::Index vertices_ = mesh_.x_t0.rows();
  const std::uint64_t count_ = topology_.triangles.size();
};

// More items than one worker takes at once, each in up to three of the rows.
TEST(ListByRow, IsAscendingDoesNotDependOnTheWorkersAndCanBeEnded) {
  constexpr std::size_t count = 70'000, rows = 300;
  std::mt19937_64 engine(3);
  std::vector<std::vector<std::int32_t>> rows_of(count);
  std::vector<std::vector<std::int32_t>> expected(rows);
  for (std::size_t item = 0; item < count; ++item) {
    std::set<std::int32_t> some;
    for (std::uint64_t n = engine() % 4; n-- > 0;)
      some.insert(static_cast<std::int32_t>(engine() % (rows - 1)));
    rows_of[item].assign(some.begin(), some.end());
    for (const auto row : some) expected[at(row)].push_back(static_cast<std::int32_t>(item));
  }
  const auto of = [&](std::size_t item) -> const auto& { return rows_of[item]; };
  for (const std::uint32_t threads : {1, 3}) {
    const Workers workers(threads);
    PacedStop pace(never_stops, workers);
    Incidence lists;
    ASSERT_TRUE(list_by_row(count, rows, of, lists, pace));
    ASSERT_EQ(lists.starts.size(), rows + 1);
    for (std::size_t row = 0; row < rows; ++row)
      EXPECT_TRUE(std::ranges::equal(lists.row(static_cast<std::int32_t>(row)), expected[row]));
  }
  expect_paced(12 * count, [&](PacedStop& pace) {
    Incidence lists;
    const bool is_done = list_by_row(count, rows, of, lists, pace);
    EXPECT_EQ(is_done, !pace.stopped());
  });
}

TEST_F(Paced, ATreeDoesNotDependOnTheWorkers) {
  const BoundingVolumeTree alone(topology_, mesh_.x_t0);
  const Workers workers(3);
  PacedStop pace(never_stops, workers);
  const BoundingVolumeTree shared(topology_, mesh_.x_t0, &pace);
  ASSERT_EQ(shared.node_count(), alone.node_count());
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(alone.node_count()); ++node) {
    ASSERT_EQ(shared.child(node), alone.child(node)) << node;
    ASSERT_EQ(shared.component(node), alone.component(node)) << node;
  }
}

TEST_F(Paced, ChecksOfTheMesh) {
  expect_paced(11 * count_, [&](PacedStop& pace) {
    const auto problem = check_repeated(rows_, vertices_, pace);
    EXPECT_EQ(problem.has_value(), pace.stopped());
    EXPECT_TRUE(!problem || problem->error == InputError::stopped);
  });
}

TEST_F(Paced, AdjacencyOfAnOpenMesh) {
  expect_paced(50 * count_, [&](PacedStop& pace) { make_surface(rows_, vertices_, pace); });
  expect_paced(40 * count_, [&](PacedStop& pace) { make_topology(rows_, vertices_, pace); });
}

TEST_F(Paced, LoopsOfASoup) {
  const auto soup_count = static_cast<Eigen::Index>(count_);
  Triangles soup(soup_count, 3);
  for (Eigen::Index t = 0; t < soup_count; ++t) soup.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  expect_paced(100 * count_, [&](PacedStop& pace) { make_surface(soup, 3 * soup_count, pace); });
  const Topology topology = make_topology(soup, 3 * soup_count);
  expect_paced(10 * count_, [&](PacedStop& pace) { boundary_loops(topology, pace); });
}

TEST_F(Paced, TreeAndItsBoxes) {
  expect_paced(80 * count_, [&](PacedStop& pace) {
    const BoundingVolumeTree tree(topology_, mesh_.x_t0, &pace);
  });
  BoundingVolumeTree tree(topology_, mesh_.x_t0);
  expect_paced(8 * count_, [&](PacedStop& pace) {
    const bool is_done = tree.refit(topology_, mesh_.motion(), pace);
    EXPECT_EQ(is_done, !pace.stopped());
  });
  // What a stop leaves behind does not stay.
  tree.refit(topology_, mesh_.motion());
  BoundingVolumeTree fresh(topology_, mesh_.x_t0);
  fresh.refit(topology_, mesh_.motion());
  tree.join_boxes(nullptr);
  fresh.join_boxes(nullptr);
  const auto &box = tree.box(BoundingVolumeTree::root), &same = fresh.box(BoundingVolumeTree::root);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(box.lo_t0[k], same.lo_t0[k]);
    EXPECT_EQ(box.hi_t1[k], same.hi_t1[k]);
  }
}

TEST_F(Paced, PointsAndRepresentatives) {
  expect_paced(3 * count_,
               [&](PacedStop& pace) { const FeaturePoints points(mesh_.motion(), &pace); });
  expect_paced(6 * count_, [&](PacedStop& pace) { const Representatives all(topology_, &pace); });
  Representatives some(topology_);
  std::vector<TriangleType> types(count_, TriangleType::dirty);
  std::vector<std::int32_t> changed(count_);
  for (std::size_t t = 0; t < count_; ++t) changed[t] = static_cast<std::int32_t>(t);
  for (std::size_t t = 0; t < count_; t += 9) types[t] = TriangleType::violated;
  some.update(topology_, types, changed);  // from one type to several less has to be chosen
  expect_paced(24 * count_, [&](PacedStop& pace) {
    const bool is_done = some.update(topology_, types, changed, &pace);
    EXPECT_EQ(is_done, !pace.stopped());
  });
}

TEST_F(Paced, NormalCones) {
  const NormalConeSearch search;
  BoundingVolumeTree tree(topology_, mesh_.x_t0);
  ContourMaker maker(topology_);
  expect_paced(60 * count_, [&](PacedStop& pace) {
    const PatchContours contours(topology_, tree, maker, &pace);
  });
  PacedStop never(never_stops);
  const auto of_mesh = search.prepare(topology_, tree, never);
  const Marks marks(tree);
  const PairTables tables = EveryPair().candidates();
  of_mesh->fit(tree, topology_, mesh_.motion(), never);
  SearchCounts first_counts;  // of the search that finds the contours
  ASSERT_TRUE(of_mesh->search({topology_, tree, marks, tables, &never}, first_counts,
                              [](std::int32_t, std::int32_t) { return true; }));
  expect_paced(30 * count_, [&](PacedStop& pace) {
    SearchCounts counts;
    const auto sink = [&](std::int32_t, std::int32_t) {
      EXPECT_FALSE(pace.stopped()) << "a pair after the end";
      return true;
    };
    const SearchInput input{topology_, tree, marks, tables, &pace};
    const bool is_done = of_mesh->search(input, counts, sink);
    EXPECT_EQ(is_done, !pace.stopped());
  });
}

}  // namespace
}  // namespace assay::detector
