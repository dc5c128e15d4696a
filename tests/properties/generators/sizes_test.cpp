// Large cases: each shape of a size family is valid, starts without contact, and has the property
// that it is made for. Numbers are printed beside the wanted numbers.
#include <fmt/format.h>

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
  return make_case(family, fmt::format("test:1:{}:{}", family.name, index));
}

std::string shape_of(const RandomCase& made) {
  for (const auto& tag : made.tags)
    if (tag.starts_with("large:")) return tag.substr(6);
  return "";
}

int most_at_a_vertex(const corpus::Case& c) {
  std::vector<int> count(static_cast<std::size_t>(c.frames[0].rows()));
  for (const auto v : c.triangles.reshaped()) ++count[static_cast<std::size_t>(v)];
  return *std::max_element(count.begin(), count.end());
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
    const auto fourth = made_by(family, 3);
    EXPECT_NE(shape_of(fourth), shape_of(make_case(family, fourth.c.id + "~1")));
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
    const auto pairs = truth[0].pairs.size();
    fmt::print(
        "{:13} {:5} triangles, {:4} components, {:4} at a vertex, {:7} candidates, {:6} pairs\n",
        name, c.triangles.rows(), components.size(), most_at_a_vertex(c),
        truth[0].feature_candidates, pairs);
    const auto is_one_of = [&](const std::set<std::string>& names) { return names.contains(name); };
    EXPECT_EQ(pairs == 0, is_one_of({"sphere"})) << name;
    EXPECT_TRUE(pairs > 300 || !is_one_of({"cloth", "soup", "crumpled", "tubes"})) << name << pairs;
    EXPECT_TRUE(components.size() == 250 || !is_one_of({"components", "soup"})) << name;
    EXPECT_TRUE(most_at_a_vertex(c) == 1000 || !is_one_of({"valence"}));
    EXPECT_TRUE(truth[0].feature_candidates > 500'000 || !is_one_of({"one-place"}));
    if (name != "far-corner") continue;
    EXPECT_LT(pairs, 60u);
    for (const auto& contact : truth[0].pairs)
      EXPECT_GE(contact.pair.b, c.triangles.rows() - 4) << "one of the last four";
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
    const auto candidates = result.counts.search.candidate_pairs;
    fmt::print("{:13} {:6} triangles, {:8} candidates, {:7} pairs\n", shape_of(made),
               c.triangles.rows(), candidates, result.pairs.size());
    most = std::max(most, candidates * static_cast<std::uint64_t>(c.triangles.rows()));
  }
  EXPECT_GT(most, std::uint64_t{1} << 32);
}

}  // namespace
}  // namespace assay::properties
