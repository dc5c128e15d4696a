// The pending facts of corpus/curated. The oracle alone checks cycles and ghosts, Vv, K, embedding,
// layers and view primitives; the planted fault checks what a fact says about a mutant. Facts
// without a check are counted and listed.
#include "tests/curated_cases.h"
#include "tests/properties/curated/curated_checks.h"

namespace assay::properties::test {
namespace {

// Checked and left, by kind, over all cases.
struct Tally {
  std::map<std::string, int> checked;
  std::map<std::string, std::set<std::string>> pending;  // fact, cases
};

// Words about where a case came from: nothing to check.
const std::set<std::string> remarks = {"mutant", "mesh", "title", "allplus", "tip_faces", "facts"};

// Stated in a file and false, by case and name; a test below says why.
const std::set<std::pair<std::string, std::string>> disproved_facts = {
    {"D7_ghost_not_moved", "frozen_finds_nothing"}};

void check_named_facts(const Facts& f, Tally& tally) {
  static const auto known = checks();
  const json facts = f.stored.value("facts", json::object());
  for (const auto& [name, stated] : facts.items()) {
    const auto check = known.find(name);
    const auto holds = check == known.end() ? std::nullopt : check->second(f);
    if (!holds) {
      tally.pending[name].insert(f.id);
      continue;
    }
    ++tally.checked[name];
    const bool disproved = disproved_facts.count({f.id, name}) > 0;
    EXPECT_EQ(*holds, stated.get<bool>() != disproved) << f.id << ": " << name;
  }
}

// A fact with a value: what the oracle has for it, nothing when this case has not what it needs.
std::optional<json> value_of(const Facts& f, const std::string& name) {
  const CuratedStep& s = f.last();
  if (name == "boundary_edges_of_M_plus_ghost") return distinct_unmatched_edges(with_ghosts(s));
  if (name == "in_K") {
    json pairs = json::array();
    for (const auto& [pair, time, feature] : s.pairs_of(s.k(), true))
      pairs.push_back({pair.a, pair.b});
    return pairs;
  }
  if (name == "Vv" || name == "Vv_swept") return members(s.swept());
  if (name == "Vv_B_alone") return members(s.swept_alone());
  if (name == "Vv_frozen") return members(s.by_frozen_ghosts());
  if (name == "Vv_after_A" && f.two_steps()) return members(f.first().swept());
  if (name == "first_B") return s.judgement.first.lo;
  if (name == "penetrates")
    return oracle::meets_primitive({s.x_t0, s.x_t1}, s.triangles, s.primitive);
  if (name == "flipped_triangle") {
    // The triangle that, turned over, makes the mesh a cycle.
    for (Eigen::Index t = 0; t < s.triangles.rows(); ++t) {
      detector::Triangles turned = s.triangles;
      std::swap(turned(t, 0), turned(t, 1));
      if (oracle::closes(turned, detector::Triangles(0, 3))) return t;
    }
  }
  return std::nullopt;
}

void check_values(const Facts& f, Tally& tally) {
  for (const auto& [name, stated] : f.stored.items()) {
    if (remarks.count(name)) continue;
    const auto value = value_of(f, name);
    if (!value) {
      tally.pending[name].insert(f.id);
      continue;
    }
    ++tally.checked[name];
    EXPECT_EQ(*value, stated) << f.id << ": " << name;
  }
}

TEST(CuratedFacts, Hold) {
  Tally tally;
  for (const auto& path : tests::curated_files()) {
    const auto c = corpus::read_case(path);
    ASSERT_TRUE(c.has_value()) << c.error().message;
    const Facts facts(c.value());
    check_named_facts(facts, tally);
    check_values(facts, tally);
  }
  int checked = 0, pending = 0;
  for (const auto& [name, count] : tally.checked) {
    std::printf("checked: %3d %s\n", count, name.c_str());
    checked += count;
  }
  for (const auto& [name, cases] : tally.pending) {
    std::printf("pending: %3zu %s (%s ...)\n", cases.size(), name.c_str(), cases.begin()->c_str());
    pending += static_cast<int>(cases.size());
  }
  std::printf("%d facts checked, %d pending\n", checked, pending);
  EXPECT_GE(checked, 360);
}

// What the files say in words only.
CuratedStep step_of(const std::string& id) { return {tests::curated_case(id), 0}; }

// D7 says that K finds nothing with the Vv of ghosts that stay at their places of t=0. That Vv, as
// the file itself has it, holds all triangles of the box, and every contact is one of the box: all
// are in (U,Vv). The same with ghosts of which only the apex stays. What does hold, and makes the
// case: such ghosts leave the tetrahedron clean (frozen_ghost_does_not_taint_tetra).
TEST(CuratedFacts, D7_FrozenGhostsStillFindThroughTheBox) {
  const CuratedStep s = step_of("D7_ghost_not_moved");
  const Flags frozen = s.by_frozen_ghosts();
  EXPECT_EQ(members(frozen), (Set{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  ASSERT_FALSE(s.judgement.pairs.empty());
  for (const auto& contact : s.judgement.pairs) EXPECT_LT(contact.pair.a, 10);
  EXPECT_FALSE(s.k_finds_nothing(frozen));
  EXPECT_FALSE(s.k_finds_nothing(s.touched(s.apexes_t0, s.apexes_t0)));
}

int winding_at_view(const CuratedStep& s) {
  const oracle::Instant start(oracle::with_apexes(s.x_t0, s.apexes_t0));
  return oracle::WindingField(start, with_ghosts(s)).at(s.primitive.q0.t0).value();
}

TEST(CuratedFacts, L5_WindingTwoIsNoRelease) {
  for (const char* id :
       {"A1_winding2_allpositive", "A2_nested_outward", "L9_shared_edge_two_layers"})
    EXPECT_EQ(winding_at_view(step_of(id)), 2) << id;
}

TEST(CuratedFacts, L9_TwoLayersInOneComponent) {
  const oracle::LayerState state = layers(step_of("L9_shared_edge_two_layers"));
  const oracle::Layer outer{1, 0}, inner{2, 1};
  for (int t = 0; t < 8; ++t) {
    EXPECT_EQ(state.touched[t], 0);
    EXPECT_EQ(state.layer[t], t < 4 ? outer : inner);
    EXPECT_EQ(state.piece[t], t < 4 ? 0 : 1);
    EXPECT_EQ(state.clean[t], t < 4 ? 1 : 0);  // a tie: the layer of the lowest triangle
  }
}

TEST(CuratedFacts, L10_NestedComponentsAreCleanEach) {
  const oracle::LayerState state = layers(step_of("A2_nested_outward"));
  EXPECT_EQ(state.common.size(), 2u);
  EXPECT_EQ(members(state.clean).size(), state.clean.size());
}

TEST(CuratedFacts, L11_LayersShowTheTipInside) {
  // D8, step B alone: the tip is past the ghosts without touching them, so on the wrong side.
  const CuratedStep b = step_of("D8_release_arm_stepB");
  const oracle::LayerState state = layers(b);
  for (const int tip : {33, 34, 35}) {
    EXPECT_EQ(state.touched[tip], 0);
    EXPECT_EQ(state.clean[tip], 0);
  }
  EXPECT_EQ(state.clean[0], 1);
}

}  // namespace
}  // namespace assay::properties::test
