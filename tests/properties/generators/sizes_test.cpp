// Large cases: each shape of a size family is valid, starts without contact, and shows what it is
// for. Numbers are printed beside the wanted ones.
#include <map>

#include "detector/detector.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/topology.h"
#include "oracle/instant/instant.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

constexpr int shape_count = 10;

RandomCase made_by(const Family& family, int index) {
  return make_case(family, "test:1:" + std::string(family.name) + ":" + std::to_string(index));
}

std::string shape_of(const RandomCase& made) {
  for (const auto& tag : made.tags) {
    if (tag.starts_with("large:")) return tag.substr(6);
  }
  return "";
}

int most_at_a_vertex(const corpus::Case& c) {
  std::vector<int> count(static_cast<std::size_t>(c.frames[0].rows()));
  for (const auto v : c.triangles.reshaped()) ++count[static_cast<std::size_t>(v)];
  return *std::max_element(count.begin(), count.end());
}

TEST(Sizes, FamiliesAreKnownByTheirNames) {
  std::uint64_t triangles = 1000;
  for (const auto& family : size_families()) {
    EXPECT_EQ(family.triangles, triangles);
    EXPECT_TRUE(is_size_family(family.name));
    EXPECT_EQ(find_family(family.name), &family);
    triangles *= 10;
  }
  EXPECT_FALSE(is_size_family("closed-generic"));
}

TEST(Sizes, ShapesTakeTurnsAndAreValidAndAboutAsLarge) {
  for (const auto& family : size_families().first(3)) {
    std::map<std::string, int> shapes;
    for (int i = 0; i < shape_count; ++i) {
      const auto made = made_by(family, i);
      const auto& c = made.c;
      ++shapes[shape_of(made)];
      EXPECT_FALSE(detector::check_triangles(c.triangles, c.frames[0].rows())) << shape_of(made);
      for (const auto& frame : c.frames) EXPECT_TRUE(frame.allFinite()) << shape_of(made);
      const auto n = static_cast<double>(c.triangles.rows());
      const auto wanted = static_cast<double>(family.triangles);
      EXPECT_NEAR(n, wanted, 0.2 * wanted) << shape_of(made);
    }
    EXPECT_EQ(shapes.size(), static_cast<std::size_t>(shape_count)) << family.name;
    // A contract that cannot have a shape is given the next one.
    const auto id = "test:1:" + std::string(family.name) + ":3";
    EXPECT_NE(shape_of(make_case(family, id)), shape_of(make_case(family, id + "~1")));
  }
}

TEST(Sizes, EachShapeStartsFreeAndShowsWhatItIsFor) {
  const auto& family = size_families()[0];
  for (int i = 0; i < shape_count; ++i) {
    const auto made = made_by(family, i);
    const auto& c = made.c;
    const auto name = shape_of(made);
    const auto touching = oracle::any_nearer_than(c.frames[0], c.triangles, 0,
                                                  [](std::int32_t, std::int32_t) { return true; });
    EXPECT_FALSE(touching) << name;
    const auto truth = judge_case(c);
    const auto components = detector::make_topology(c.triangles, c.frames[0].rows()).components;
    std::printf("%-13s %5d triangles, %4d components, %4d at a vertex, %7d candidates, %6d pairs\n",
                name.c_str(), static_cast<int>(c.triangles.rows()),
                static_cast<int>(components.size()), most_at_a_vertex(c),
                static_cast<int>(truth[0].feature_candidates),
                static_cast<int>(truth[0].pairs.size()));
    const auto pairs = truth[0].pairs.size();
    if (name == "sphere") {
      EXPECT_EQ(pairs, 0u);
    } else {
      EXPECT_GT(pairs, 0u) << name;
    }
    if (name == "far-corner") {
      EXPECT_LT(pairs, 60u);
      for (const auto& contact : truth[0].pairs)
        EXPECT_GE(contact.pair.b, c.triangles.rows() - 4) << "one of the last four";
    }
    if (name == "valence") {
      EXPECT_EQ(most_at_a_vertex(c), 1000);
    }
    if (name == "components" || name == "soup") {
      EXPECT_EQ(components.size(), 250u);
    }
    if (name == "cloth" || name == "soup" || name == "crumpled" || name == "tubes") {
      EXPECT_GT(pairs, 300u) << name;
    }
    if (name == "one-place") {
      EXPECT_GT(truth[0].feature_candidates, 500'000u);
    }
  }
}

// What a buffer of 65,536 candidates and a product of 32 bits need to go wrong.
TEST(Sizes, OneOf10000FillsBuffersAndProducts) {
  std::uint64_t most = 0;
  for (int i = 0; i < shape_count; ++i) {
    const auto made = made_by(size_families()[1], i);
    const auto& c = made.c;
    auto detector =
        detector::Detector::create(c.triangles, c.frames[0], {.culling = detector::Culling::bvh});
    ASSERT_TRUE(detector);
    const auto result = detector.value().evaluate(c.frames[0], c.frames[1]);
    const auto product =
        result.counts.search.candidate_pairs * static_cast<std::uint64_t>(c.triangles.rows());
    std::printf("%-13s %6d triangles, %8d candidates, %7d pairs\n", shape_of(made).c_str(),
                static_cast<int>(c.triangles.rows()),
                static_cast<int>(result.counts.search.candidate_pairs),
                static_cast<int>(result.pairs.size()));
    most = std::max(most, product);
  }
  EXPECT_GT(most, std::uint64_t{1} << 32);
}

}  // namespace
}  // namespace assay::properties
