// Random meshes: every case is valid input and has the same bytes whenever it is made, and each
// family has the properties that it is made for. Rates are printed beside the wanted rates.
#include <fmt/format.h>

#include <bit>

#include "detector/mesh/mesh_checks.h"
#include "oracle/distance/step_distance.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/generators/families.h"
#include "properties/generators/parts.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/worker/plugin/query_case.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

std::string id_of(const Family& family, int index) {
  return "test:1:" + std::string(family.name) + ":" + std::to_string(index);
}

// FNV-1a over the bits of triangles, frames, view primitive and script.
class Digest {
 public:
  void add(const corpus::Case& c) {
    for (const auto v : c.triangles.reshaped()) add(static_cast<std::uint64_t>(v));
    for (const auto& x : c.frames)
      for (const auto p : x.reshaped()) add(std::bit_cast<std::uint64_t>(p));
    const auto view = c.view.value_or(corpus::CaseView{});
    for (const auto* end : {&view.q0, &view.q1})
      for (const auto& q : *end)
        for (const double p : q) add(std::bit_cast<std::uint64_t>(p));
    for (const auto& step : c.script) {
      add(static_cast<std::uint64_t>(step.from));
      add(static_cast<std::uint64_t>(step.to));
      add(step.commit ? 1 : 0);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t word) {
    for (int i = 0; i < 64; i += 8) value_ = (value_ ^ (word >> i & 0xff)) * 0x100000001b3u;
  }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Its text reads back, and its id makes the same bytes again.
void expect_kept(const Family& family, const corpus::Case& c) {
  const auto text = corpus::case_text(c);
  const auto read = corpus::parse_case(text, "case");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(corpus::case_text(read.value()), text);
  ASSERT_EQ(corpus::case_text(make_case(family, c.id).c), text);
}

TEST(Generators, EveryCaseIsValidInputAndHasATextThatReadsBack) {
  std::set<std::string_view> names;
  for (const auto& family : families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_FALSE(family.about.empty());
    EXPECT_EQ(family.is_closed, family.name.starts_with("closed"));
    for (int i = 0; i < 500; ++i) {
      const auto made = make_case(family, id_of(family, i));
      SCOPED_TRACE(made.c.id);
      ASSERT_EQ(made.c.id, id_of(family, i));
      const auto vertices = made.c.frames.front().rows();
      const auto problem = detector::check_triangles(made.c.triangles, vertices);
      ASSERT_FALSE(problem) << problem->message;
      ASSERT_GE(made.c.frames.size(), 2u);
      const std::size_t most = made.c.script.empty() ? 9 : 17;  // each step tried and shortened
      ASSERT_LE(made.c.frames.size(), most);
      for (const auto& x : made.c.frames) ASSERT_FALSE(detector::check_positions(x, vertices));
      ASSERT_GE(made.c.triangles.rows(), 1);
      ASSERT_LE(made.c.triangles.rows(), 220);
      const bool cycle = oracle::boundary_loops(made.c.triangles).empty();
      ASSERT_TRUE(cycle || !family.is_closed);
      ASSERT_FALSE(cycle && family.name.starts_with("unclosed"));
      ASSERT_TRUE(made.c.options.empty());
      expect_kept(family, made.c);
      auto other = make_case(family, id_of(family, i + 1000)).c;
      other.id = made.c.id;
      ASSERT_NE(corpus::case_text(other), corpus::case_text(made.c)) << "of another id";
    }
  }
  EXPECT_EQ(names.size(), 10u);
}

// One face was left there, and it went as invalid later.
TEST(Generators, ABrokenMeshKeepsATriangle) {
  EXPECT_GE(make_case(*find_family("broken"), "unclosed:606:broken:8351").c.triangles.rows(), 1);
}

// The generators' digest: whoever changes what they make changes it here, and a compiler or machine
// that makes other bytes is noticed.
TEST(Generators, MakeTheseBytesOnEveryMachine) {
  const std::map<std::string_view, std::uint64_t> wanted = {
      {"closed-generic", 0x603222a5e2a3683bu},
      {"closed-near-degenerate", 0x897459d4df24b6fdu},
      {"closed-degenerate", 0x3c2b27097e05d365u},
      {"closed-far-large-step", 0x24943abbc5715296u},
      {"unclosed-generic", 0x6e3f495d9d48b896u},
      {"unclosed-degenerate", 0x9192a7dcc3a39b2bu},
      {"unclosed-near-degenerate", 0x5ee572b45e6424adu},
      {"closed-everyday", 0x6659a22ea2b4848cu},
      {"unclosed-everyday", 0xd8e3e8ec974c1aa1u},
      {"broken", 0x6e09863924189366u},
  };
  for (const auto& family : families()) {
    Digest digest;
    for (int i = 0; i < 200; ++i) digest.add(make_case(family, id_of(family, i)).c);
    const auto place = wanted.find(family.name);
    EXPECT_TRUE(place != wanted.end() && place->second == digest.value())
        << "now: {\"" << family.name << "\", 0x" << std::hex << digest.value() << "u},";
  }
}

TEST(Generators, EveryTagOccurs) {
  std::map<std::string, int> tags;
  for (const auto& family : families())
    for (int i = 0; i < 1200; ++i)
      for (const auto& tag : make_case(family, id_of(family, i)).tags) ++tags[tag];
  std::vector<std::string> wanted = tests::words(
      "closed unclosed broken response orientation:inward order:shuffled mode:positive "
      "mode:aimed mode:free size:2-12 size:13-40 size:41-100 size:101-200 shape:tetrahedron "
      "shape:bipyramid shape:sphere shape:split-sphere shape:capsule shape:star shape:torus "
      "shape:sheet shape:tube shape:spiral shape:flat-ring shape:rolled-ring motion:closing "
      "pieces:apart pieces:nested pieces:cavity "
      "pieces:at-a-vertex pieces:at-an-edge holes:1 holes:2 holes:3 holes:4 "
      "holes:vertex-twice broken:missing-faces broken:turned-faces broken:leaves broken:zero-area "
      "broken:open-seam broken:doubled-vertex broken:unused-vertices broken:any-faces "
      "motion:positive motion:and-back motion:large-step close:dent close:edge-on "
      "close:below-surface view:own view:point view:line view:ends-apart view:moving "
      "view:inside view:outside view:anywhere view:pierced view:on-a-vertex view:on-an-edge "
      "view:on-a-face aim:vertex aim:edge aim:face aim:edge-edge aim:grazing aim:simultaneous "
      "aim:coplanar aim:region-border aim:start aim:end aim:mid-step menu:small-integers "
      "menu:dyadics menu:ulp menu:sliver menu:near-coincidence menu:far menu:mixed-scales "
      "menu:wide-scales menu:denormal shape:box shape:flat shape:triangle "
      "shape:floor "
      "lands:on-an-edge lands:on-a-vertex lands:at-start lands:at-end lands:within lands:sliding "
      "numbers:full numbers:decimals numbers:inches numbers:quotient numbers:float32 "
      "numbers:turned numbers:level");
  for (const auto& motion : motions()) wanted.push_back(std::string("motion:") + motion.name);
  for (int steps = 1; steps <= 8; ++steps) wanted.push_back("steps:" + std::to_string(steps));
  for (const auto& tag : wanted) EXPECT_GE(tags[tag], 5) << tag;
  // And no other: a new tag belongs into the list.
  EXPECT_EQ(tags.size(), wanted.size());
}

// Random cases with a relation: each is valid, is the same whenever it is made, and leaves
// something out.

TEST(RelationCases, AreValidAndHaveATextThatReadsBack) {
  const Family& family = counted_families()[0];
  EXPECT_EQ(find_family("counted"), &family);
  std::map<std::string, int> tags;
  for (int i = 0; i < 400; ++i) {
    const auto id = id_of(family, i);
    const auto made = make_case(family, id);
    SCOPED_TRACE(id);
    ASSERT_TRUE(made.c.counted && !made.c.counted->pairs.count_all());
    const auto wrong = detector::check_counted_pairs(made.c.counted->pairs, made.c.triangles,
                                                     made.c.frames[0].rows());
    ASSERT_FALSE(wrong) << wrong->message;
    expect_kept(family, made.c);
    EXPECT_TRUE(std::is_sorted(made.tags.begin(), made.tags.end()));
    for (const auto& tag : made.tags) ++tags[tag];
  }
  for (const auto* kind : {"relation:triangles", "relation:features", "relation:bodies",
                           "relation:rings", "relation:rest-distance"})
    EXPECT_GT(tags[kind], 50) << kind;
}

TEST(RelationCases, ContactsThatCountAndOthersAreFrequent) {
  int counted = 0, ignored = 0;
  for (int i = 0; i < 200; ++i) {
    auto c = make_case(counted_families()[0], "test:2:counted:" + std::to_string(i)).c;
    const auto what_counts = judge_case(c);
    c.counted.reset();
    const auto all = judge_case(c);
    for (std::size_t s = 0; s < all.size(); ++s) {
      counted += what_counts[s].pairs.empty() ? 0 : 1;
      ignored += what_counts[s].pairs.size() < all[s].pairs.size() ? 1 : 0;
    }
  }
  std::printf("of 200 cases %d steps have contacts that count, %d others\n", counted, ignored);
  EXPECT_GT(counted, 50);
  EXPECT_GT(ignored, 50);
}

// Each drawn approach is at the distance that it was made for, by the oracle.

corpus::Case two_triangles(const Approach& approach) {
  corpus::Case c;
  c.id = "approach";
  c.triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  c.frames.assign(2, detector::Positions(6, 3));
  for (int i = 0; i < 6; ++i) {
    const auto& point = i < 3 ? approach.a[static_cast<std::size_t>(i)]
                              : approach.b[static_cast<std::size_t>(i - 3)];
    c.frames[0].row(i) << point.t0[0], point.t0[1], point.t0[2];
    c.frames[1].row(i) << point.t1[0], point.t1[1], point.t1[2];
  }
  return c;
}

// How the least distance of an approach compares with d.
std::string place_of(double least, double d) {
  if (least == d) return "at d";
  if (least == std::nextafter(d, 0.0)) return "the double before d";
  if (least == std::nextafter(d, std::numeric_limits<double>::infinity()))
    return "the double after d";
  return least == d / 2 ? "half of d" : least == d - d * 0x1p-20 ? "just inside" : "elsewhere";
}

TEST(Approaches, AreAtTheDistanceThatTheyAreMadeFor) {
  for (const double d : {0.01, 1.0, 3e-7, 12345.678, 0x1p-890, 0x1p890}) {
    std::map<std::string, int> places;
    std::map<bool, int> near, near_at_start;
    for (std::uint64_t i = 0; i < 400; ++i) {
      Random random(7, i);
      const auto c = two_triangles(draw_approach(random, d));
      const auto least = oracle::least_distance({c.frames[0], c.frames[1]}, c.triangles).distance;
      ++places[place_of(least, d)];
      const Contract within = {.adjacency = Adjacency::no_shared_vertex, .separation = d};
      const auto truth = truth_of(c, judge_case(c, within).front(), within);
      ASSERT_EQ(truth.first.has_value(), least <= d) << i;
      ++near[truth.first.has_value()];
      ++near_at_start[truth.starts_near];
    }
    EXPECT_EQ(places.count("elsewhere"), 0u) << d;
    EXPECT_EQ(places.size(), 5u) << d;
    for (const bool is : {false, true}) {
      EXPECT_GT(near[is], 60) << d;
      EXPECT_GT(near_at_start[is], 5) << d;
    }
  }
}

TEST(Approaches, AreAddedToAMeshOrTakeTheirPlaceAsAQuery) {
  Random random(3, 1);
  const auto mesh = make_case(families().front(), "tiny:1:closed-generic:4").c;
  const auto with = with_approach(mesh, 0.5, random);
  EXPECT_EQ(with.triangles.rows(), mesh.triangles.rows() + 2);
  EXPECT_EQ(with.frames.size(), mesh.frames.size());
  EXPECT_EQ(with.frames.front().rows(), mesh.frames.front().rows() + 6);
  EXPECT_FALSE(with.view || with.ghosts || with.expected.answer);
  // The case's relation speaks of the new vertices too, and lets the two triangles meet.
  for (int i = 0; i < 40; ++i) {
    auto related = make_case(counted_families().front(), fmt::format("tiny:1:counted:{}", i)).c;
    ASSERT_TRUE(related.counted);
    const auto met = with_approach(related, 0.5, random);
    const auto vertices = met.frames.front().rows();
    EXPECT_FALSE(detector::check_counted_pairs(met.counted->pairs, met.triangles, vertices)) << i;
    EXPECT_TRUE(met.counted->steps.empty());
  }
  const auto query = case_of_query({{}, 2}, "query");
  const auto aimed = query_of(with_approach(query, 0.5, random));
  ASSERT_TRUE(aimed);
  EXPECT_EQ(aimed->first_group, 2);
}

}  // namespace
}  // namespace assay::properties
