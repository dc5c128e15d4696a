// The wide descent compared with the binary descent, and its instruction sets with each other.
#include "detector/parallel/workers.h"
#include "detector/search/pair_search.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

struct Found {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  std::size_t count = 0;
  SearchCounts counts;
};

Found found_by(const PairSearch& search, const SearchInput& input) {
  Found found;
  EXPECT_TRUE(search.search(input, found.counts, [&](std::int32_t a, std::int32_t b) {
    found.pairs.insert({std::min(a, b), std::max(a, b)});
    return ++found.count > 0;
  }));
  return found;
}

const PairTables everything = {PairTable::everything(), PairTable::everything()};

PairTables some_tables(int which) {
  PairTables tables = which % 2 == 0 ? PairRule().candidates() : EveryPair().candidates();
  if (which % 3 == 2) tables.across = PairTable();
  return tables;
}

TEST(WideSearch, L3_FindsThePairsOfTheBinaryDescentOnceEach) {
  SearchMeshes random(11);
  std::size_t candidates = 0, parts = 0;
  for (int i = 0; i < 60; ++i) {
    Fitted fitted(random.sheets(1 + i % 7, 1 + i % 6, i % 5 == 0));
    auto& [mesh, tree, marks] = fitted;
    std::vector<TriangleType> types(mesh.topology.triangles.size(), TriangleType::violated);
    if (i % 4 != 0) random.change(types, 2);
    MarkingCounts marking;
    Marking().bring_to(types, tree, marks, marking);
    const PairTables tables = some_tables(i);
    const SearchInput input{mesh.topology, tree, marks, tables};
    const Found binary = found_by(TreeSearch(), input), wide = found_by(WideSearch(), input);
    EXPECT_EQ(wide.pairs, binary.pairs) << i;
    EXPECT_EQ(wide.count, wide.pairs.size()) << i;
    EXPECT_EQ(wide.counts.candidate_pairs, wide.count) << i;
    candidates += wide.count;
    parts += mesh.topology.components.size();
  }
  EXPECT_GT(candidates, 20'000u);
  EXPECT_GT(parts, 100u);
}

TEST(WideSearch, LanesDoNotShow) {
  SearchMeshes random(12);
  const Fitted fitted(random.sheets(4, 24, false));
  const auto searched = [&](std::uint32_t threads) {
    const Workers workers(threads);
    PacedStop pace(never_stops, workers);
    std::vector<std::vector<CandidatePair>> of_lanes(workers.count());
    const SearchInput input{fitted.mesh.topology, fitted.tree, fitted.marks, everything, &pace};
    SearchCounts counts;
    const auto take = [&](std::span<const CandidatePair> pairs, std::size_t lane) {
      of_lanes[lane].insert(of_lanes[lane].end(), pairs.begin(), pairs.end());
      return true;
    };
    EXPECT_TRUE(WideSearch().search(input, counts, PairSink::in_lanes(take)));
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    for (const auto& lane : of_lanes) {
      for (const auto& [a, b] : lane) pairs.insert({a, b});
    }
    return std::tuple(pairs, counts.box_tests, counts.candidate_pairs);
  };
  const auto alone = searched(1);
  EXPECT_GT(std::get<2>(alone), 1000u);
  EXPECT_EQ(searched(2), alone);
  EXPECT_EQ(searched(3), alone);
}

TEST(WideSearch, EndsWhereTheSinkSaysSo) {
  SearchMeshes random(13);
  const Fitted fitted(random.sheets(2, 20, false));
  const SearchInput input{fitted.mesh.topology, fitted.tree, fitted.marks, everything};
  SearchCounts counts;
  std::size_t calls = 0;
  EXPECT_FALSE(
      WideSearch().search(input, counts, [&](std::int32_t, std::int32_t) { return ++calls < 5; }));
  EXPECT_EQ(calls, 5u);
}

// Each bit against the comparison of two boxes by itself, for all numbers of children.
TEST(BoxLanes, L3_EachLaneComparesTwoBoxes) {
  std::mt19937_64 engine(14);
  const auto number = [&] { return static_cast<float>(engine() % 7); };
  using Box = std::array<float, box_lanes::rows>;
  const auto apart = [](const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (a[3 + k] < b[k] && a[9 + k] < b[6 + k]) return true;
      if (b[3 + k] < a[k] && b[9 + k] < a[6 + k]) return true;
    }
    return false;
  };
  struct Side {
    std::vector<Box> boxes;
    Box bounds;
    std::vector<float> rows;
    BoxRows view() const { return {rows.data(), boxes.size()}; }
  };
  const auto side = [&](std::size_t count) {
    Side result;
    for (std::size_t i = 0; i < count; ++i) {
      Box box;
      for (std::size_t k = 0; k < box_lanes::rows; ++k)
        box[k] = k / 3 % 2 == 0 ? number() : box[k - 3] + static_cast<float>(engine() % 3);
      result.boxes.push_back(box);
    }
    result.bounds = result.boxes[0];
    result.rows.assign(box_lanes::rows * count + box_lanes::width, 0);
    for (std::size_t k = 0; k < box_lanes::rows; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        result.rows[k * count + i] = result.boxes[i][k];
        result.bounds[k] = k / 3 % 2 == 0 ? std::min(result.bounds[k], result.boxes[i][k])
                                          : std::max(result.bounds[k], result.boxes[i][k]);
      }
    }
    return result;
  };
  std::size_t meet = 0, kept_apart = 0;
  for (int round = 0; round < 3000; ++round) {
    const Side a = side(1 + engine() % 8), b = side(1 + engine() % 8);
    LaneSets sets, plain, best;
    for (std::size_t i = 0; i < box_lanes::width; ++i)
      plain[i] = best[i] = sets[i] = static_cast<std::uint8_t>(engine() % 256);
    const auto compared = plain_box_kernels().compare_all(a.view(), a.bounds.data(), b.view(),
                                                          b.bounds.data(), plain);
    EXPECT_EQ(box_kernels().compare_all(a.view(), a.bounds.data(), b.view(), b.bounds.data(), best),
              compared);
    for (std::size_t i = 0; i < a.boxes.size(); ++i) {
      std::uint32_t expected = 0;
      for (std::size_t j = 0; j < b.boxes.size(); ++j) {
        if (sets[i] >> j & 1 && !apart(a.boxes[i], b.boxes[j])) expected |= 1u << j;
      }
      ASSERT_EQ(plain[i], expected);
      ASSERT_EQ(best[i], expected);
      meet += expected != 0;
      kept_apart += expected == 0;
      const auto alone = plain_box_kernels().compare_one(a.boxes[i].data(), b.view());
      EXPECT_EQ(alone & sets[i], expected);
      EXPECT_EQ(box_kernels().compare_one(a.boxes[i].data(), b.view()), alone);
    }
  }
  EXPECT_GT(meet, 1000u);
  EXPECT_GT(kept_apart, 1000u);
}

}  // namespace
}  // namespace assay::tests
