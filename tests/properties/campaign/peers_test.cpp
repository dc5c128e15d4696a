// Detectors of others (corpus/peers) in a small campaign. Each detector shows the failures that
// corpus/peers/README.md expects and none that its contract leaves out, and each failure keeps its
// cause when it is shrunk.
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/families.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/exam.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

constexpr std::uint64_t peer_cases_a_family = 80;

struct JudgedPeer {
  Counts outcomes;                     // "H", "D", ...
  std::uint64_t everyday_defects = 0;  // trials of the two families of everyday numbers
  std::vector<FailureRecord> failures;
  Counts met;
  DetectorUnderTest detector;
  std::filesystem::path library;

  // Failures whose signature holds the word, shrunk or not.
  std::uint64_t met_with(std::string_view word = "") const {
    std::uint64_t count = 0;
    for (const auto& [signature, times] : met) count += says(signature, word) ? times : 0;
    return count;
  }
};

class Peers : public testing::Test {
 protected:
  // Judges the peer, or skips where its library was not there when this was built. A machine that
  // has to pass all tests has it.
  void judge(const std::string& name, std::uint64_t most_unanswered = 0) {
    peer_.library = library_of(name);
    if (!std::filesystem::exists(peer_.library)) {
      const char* ci = std::getenv("CI");
      ASSERT_STRNE(ci ? ci : "", "true") << name << " was not built";
      GTEST_SKIP() << name << " was not built: its library is not installed";
    }
    CampaignRequest request = request_of();
    Store store = test::with_all_trials(request, scratch_ / name);
    // By calls alone, so that no clock decides how small a mesh becomes.
    constexpr double hour = 3600;
    constexpr std::uint64_t calls = 400;
    shrink_failures(request, store, {hour, calls},
                    deadline_in(std::chrono::steady_clock::now(), hour), {});
    store.for_each_trial([&](const TrialRecord& r) {
      ++peer_.outcomes[r.outcomes];
      if (r.outcomes == "D" && r.family.ends_with("-everyday")) ++peer_.everyday_defects;
      ++trials_;
    });
    peer_.failures = store.failures();
    peer_.met = store.signatures();
    expect_the_contract_kept(most_unanswered);
    expect_causes_kept();
  }

  // The same, and expects failures with each of these words.
  void judge_and_find(const std::string& name, const std::vector<std::string>& words) {
    ASSERT_NO_FATAL_FAILURE(judge(name));
    if (IsSkipped()) return;
    for (const auto& word : words) EXPECT_GT(peer_.met_with(word), 0u) << word;
  }

  static std::filesystem::path library_of(const std::string& name) {
    return std::string(ASSAY_PEER_DIR) + "/" + name + ".so";
  }

  static std::optional<Failure> failure_in(const corpus::Case& c, const DetectorUnderTest& detector,
                                           const std::filesystem::path& library) {
    WorkerProcess worker(ASSAY_WORKER, library, {.seconds = 20});
    return examine({detector, detector.configurations, &worker}, c).verdicts[0].failure;
  }

  // Which claim the peer breaks in the mesh of corpus/peers/meshes, or none.
  static std::optional<Claim> broken_by(const std::string& name, const std::string& mesh) {
    auto request = test::request_of(0);
    test::set_plugin(request, library_of(name));
    const auto& detector = request.detector;
    const auto c =
        corpus::read_case(std::string(ASSAY_SOURCE_DIR) + "/corpus/peers/meshes/" + mesh + ".json");
    const auto seen = contract_case(c.value(), detector.contract);
    if (!seen) throw std::runtime_error(mesh + " is not within the contract of " + name);
    const auto failure = failure_in(*seen, detector, library_of(name));
    return failure ? std::optional(failure->claim) : std::nullopt;
  }

  // What holds of every one of them.
  void expect_the_contract_kept(std::uint64_t most_unanswered) {
    EXPECT_GE(trials_, families().size() * peer_cases_a_family * 9 / 10);
    EXPECT_LE(peer_.outcomes["U"], most_unanswered) << "no answer within the limit";
    EXPECT_GT(peer_.outcomes["H"], trials_ / 2);
    EXPECT_GT(peer_.outcomes["D"], 0u);
    EXPECT_EQ(peer_.outcomes["D"], peer_.met_with());
    // Steps that start in contact are not put to it.
    EXPECT_EQ(peer_.met_with(", t at 0"), 0u);
    for (const std::string kind : {"crashed", "error", "refused", "two runs differ"})
      EXPECT_EQ(peer_.met_with(kind), 0u) << kind;
    const auto& contract = peer_.detector.contract;
    ASSERT_EQ(contract.start, StartRule::free);
    ASSERT_TRUE(contract.has_range());
    ASSERT_FALSE(peer_.failures.empty());
    for (const auto& failure : peer_.failures) {
      for (const auto& text : {failure.mesh, failure.smallest}) {
        if (text.empty()) continue;
        const auto c = corpus::parse_case(text, failure.id()).value();
        for (const auto& frame : c.frames)
          EXPECT_EQ(beyond_range(frame, edges_of(c), contract), "") << failure.id();
        const auto seen = contract_case(c, contract);
        EXPECT_TRUE(seen && seen->frames == c.frames) << failure.id();
      }
    }
  }

  // Each kind is shrunk once, and fails alike before and after: its signature names the cause.
  void expect_causes_kept() {
    std::set<std::string> shrunk;
    for (const auto& failure : peer_.failures) {
      if (failure.smallest.empty()) continue;
      EXPECT_TRUE(shrunk.insert(failure.signature()).second);
      auto most = std::numeric_limits<Eigen::Index>::max();
      for (const auto& text : {failure.mesh, failure.smallest}) {
        const auto c = corpus::parse_case(text, failure.id()).value();
        EXPECT_LE(c.triangles.rows(), std::exchange(most, c.triangles.rows()));
        const auto again = failure_in(c, peer_.detector, peer_.library);
        EXPECT_EQ(again ? again->signature() : "holds", failure.signature()) << failure.id();
      }
    }
    EXPECT_EQ(shrunk.size(), peer_.met.size());
  }

  JudgedPeer peer_;

 private:
  CampaignRequest request_of() {
    auto request = test::request_of(0, 2);
    request.plan.name = "peers";
    request.seed = default_seed;
    request.plan.strata.clear();
    for (const auto& family : families())
      request.plan.strata.push_back({std::string(family.name), peer_cases_a_family, 0});
    request.plan.laws_every = 0;
    request.plan.case_seconds = 2;
    test::set_plugin(request, peer_.library);
    peer_.detector = request.detector;
    return request;
  }

  std::uint64_t trials_ = 0;
  tests::Scratch scratch_;
};

TEST_F(Peers, TheCubicMissesMotionWithinAPlane) {
  judge_and_find("cubic_double",
                 {"coplanar throughout", "without area", "edge-edge", "vertex-face"});
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GE(peer_.everyday_defects, 2 * peer_cases_a_family / 20) << "five of 100";
}

TEST_F(Peers, TheCubicAsALimiterLetsPassWhatItMisses) {
  judge_and_find("cubic_double_limit",
                 {"commit-free: contact on the way", "coplanar throughout", "without area"});
}

// Those that need no library are always there.
TEST_F(Peers, ALimiterGoesThroughItsStoredMesh) {
  EXPECT_EQ(broken_by("cubic_double_limit", "cubic_double"), Claim::commit_free);
  for (const std::string name : {"ipc_trust_region", "ipc_tutorial", "ipc_planar"}) {
    if (!std::filesystem::exists(library_of(name))) continue;
    EXPECT_EQ(broken_by(name, name), Claim::commit_free) << name;
    EXPECT_EQ(broken_by("ipc_warm_start", name), std::nullopt) << "it stays free on the same mesh";
  }
}

// What of Tight-Inclusion and the toolkit takes no part in suite peers, since it keeps a distance.
TEST_F(Peers, WhatKeepsADistanceLetsItsStoredMeshComeNearer) {
  std::size_t present = 0;
  for (const std::string name : {"tight_inclusion_within", "ipc_tight_inclusion_within"}) {
    if (!std::filesystem::exists(library_of(name))) continue;
    ++present;
    EXPECT_EQ(broken_by(name, name), Claim::free_sound) << name;
  }
  if (present == 0) GTEST_SKIP() << "they were not built: their libraries are not there";
}

TEST_F(Peers, TheCubicInFloatsMissesMore) {
  judge_and_find("cubic_float", {"coplanar throughout", "moving, generic"});
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(peer_.detector.contract.coordinates, Coordinates::float32);
}

TEST_F(Peers, TheCubicByEigenMissesMotionWithinAPlane) {
  judge_and_find("cubic_eigen", {"coplanar throughout", "vertex-face"});
}
TEST_F(Peers, FclMissesMotionWithinAPlaneAndMore) {
  judge_and_find("fcl_elementary", {"coplanar throughout", "moving, generic", "edge-edge"});
}

TEST_F(Peers, BulletIsAskedForVerticesAndFacesInFloatsAlone) {
  // Its SolveP3 has no end for some coefficients (corpus/peers/FINDINGS.md).
  ASSERT_NO_FATAL_FAILURE(judge("bullet_bernstein", 3));
  if (IsSkipped()) return;
  EXPECT_EQ(peer_.detector.contract.features, TestedFeatures::vertex_face);
  EXPECT_EQ(peer_.detector.contract.coordinates, Coordinates::float32);
  EXPECT_EQ(peer_.met_with("edge-edge"), 0u);
  EXPECT_EQ(peer_.met_with("piercing"), 0u);
  EXPECT_EQ(peer_.met_with("vertex-face"), peer_.met_with());
  // Most of what it misses is nothing special.
  EXPECT_GT(peer_.met_with("t inside, moving, generic"), peer_.met_with() / 2);
}

}  // namespace
}  // namespace assay::properties
