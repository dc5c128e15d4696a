// Merging stores: associative, repeatable, and refused where two stores contradict each other.
#include "properties/campaign/ledger/merge.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/store.h"
#include "tests/problem_words.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using tests::read_text, tests::Scratch;
using Paths = std::vector<std::filesystem::path>;

CampaignRequest request_of(Shard shard) {
  CampaignRequest request;
  request.plan.name = "test";
  request.plan.strata = {{"broken", 9, 0}};
  request.plan.seconds = 60;
  request.detector = built_in_detector();
  request.worker = "/bin/true";
  request.shard = shard;
  return request;
}

TrialRecord record(std::uint64_t i) {
  return {"test:1:broken:" + std::to_string(i),
          "broken",
          i,
          "HD",
          1,
          2,
          3,
          4,
          50,
          60,
          {{{"x", i}}, {}, {}, {}},
          ~i};
}

StoredFailure failure(std::uint64_t i, const std::string& smallest = "") {
  return {record(i).id, "bvh", "s", "what", "mesh of " + record(i).id, smallest, false};
}

class Merged : public testing::Test {
 protected:
  const Scratch scratch;
  Paths shards;

  // Nine trials, each with a failure, in three shards.
  void SetUp() override {
    for (std::uint64_t s = 1; s <= 3; ++s) {
      const Shard shard{s, 3};
      Store store = open("shard" + std::to_string(s), binding_of(request_of(shard)));
      for (std::uint64_t i = s - 1; i < 9; i += 3) store.add(record(i), {failure(i)}, met(i));
      store.set({"canary", "c", text_of(shard), 1, "{}"});
      store.set_note("shrunk " + std::to_string(s), "done");
      shards.push_back(scratch / ("shard" + std::to_string(s)));
    }
  }
  static std::vector<MetFailure> met(std::uint64_t i) {
    return {{"bvh", "s"}, {"view-point", i % 2 ? "t" : "s"}};
  }
  Store open(const std::string& name, const std::string& binding) const {
    auto store = Store::open(scratch / name, binding);
    EXPECT_TRUE(store) << store.error().message;
    return std::move(store.value());
  }
  std::string merge(const Paths& files, const std::string& out) const {
    const auto merged = merge_stores(files, scratch / out);
    EXPECT_TRUE(merged) << merged.error().message;
    return read_text(scratch / out);
  }
  // The store is refused beside the first shard, in a line that holds each word, and what is there
  // stays.
  void expect_refused(const std::filesystem::path& other, const std::string& word) const {
    const auto before = merge({shards[0]}, "kept");
    for (const auto& files : {Paths{shards[0], other}, Paths{other, shards[0]}, Paths{other}}) {
      const auto merged = merge_stores(files, scratch / "kept");
      ASSERT_FALSE(merged);
      EXPECT_TRUE(says(merged.error(), word));
      EXPECT_FALSE(says(merged.error(), "\n"));
      EXPECT_EQ(read_text(scratch / "kept"), before);
    }
    for (const auto& file : std::filesystem::directory_iterator(scratch / "")) {
      EXPECT_EQ(file.path().string().find("kept."), std::string::npos) << file.path();
    }
  }
};

TEST_F(Merged, HoldAllOfEach) {
  merge(shards, "all");
  const auto read = Store::read(scratch / "all");
  ASSERT_TRUE(read) << read.error().message;
  const Store* const all = &read.value();
  EXPECT_EQ(all->trial_count(), 9u);
  std::uint64_t i = 0;
  all->for_each_trial([&](const TrialRecord& r) {
    EXPECT_EQ(r.id, record(i).id);
    EXPECT_EQ(r.mesh, ~i);
    EXPECT_EQ(r.oracle_us, 50u);
    EXPECT_EQ(r.counts, record(i).counts);
    ++i;
  });
  const auto failures = all->failures();
  ASSERT_EQ(failures.size(), 9u);
  EXPECT_EQ(failures[4].mesh, "mesh of " + record(4).id);
  EXPECT_EQ(all->signatures(), (Counts{{"s", 14}, {"t", 4}}));
  EXPECT_EQ(all->evidence().size(), 3u);
  EXPECT_EQ(all->note("shrunk 2"), "done");
  EXPECT_EQ(all->binding(), with_shard(binding_of(request_of({1, 3})), merged_shard));
}

TEST_F(Merged, InAnyOrderAndGroupingAreTheSameBytes) {
  const std::string all = merge(shards, "all");
  Paths order = shards;
  int n = 0;
  while (std::next_permutation(order.begin(), order.end()))
    EXPECT_EQ(merge(order, "order" + std::to_string(n++)), all);
  merge({shards[0], shards[1]}, "left");
  EXPECT_EQ(merge({scratch / "left", shards[2]}, "left-first"), all);
  merge({shards[1], shards[2]}, "right");
  EXPECT_EQ(merge({shards[0], scratch / "right"}, "right-first"), all);
  // Again, and again of parts that are in it already.
  EXPECT_EQ(merge(shards, "all"), all);
  EXPECT_EQ(merge({scratch / "all", shards[1], scratch / "left"}, "again"), all);
  // One after the other into the same file.
  for (const auto& shard : shards) merge({shard}, "grown");
  EXPECT_EQ(read_text(scratch / "grown"), all);
}

TEST_F(Merged, JoinWhatMayRightlyDiffer) {
  // The same shard once more, faster, with a mesh shrunk and evidence that came farther.
  const std::string binding = binding_of(request_of({1, 3}));
  {
    Store store = open("again", binding);
    auto faster = record(0);
    faster.oracle_us = 5;
    faster.detector_us = 600;
    store.add(faster, {failure(0, "small")}, met(0));
    store.set({"canary", "c", "1/3", 2, R"({"more": 1})"});
  }
  const auto joined = merge({shards[0], scratch / "again"}, "joined");
  EXPECT_EQ(merge({scratch / "again", shards[0]}, "other"), joined);
  EXPECT_EQ(merge({scratch / "other", shards[0]}, "other"), joined);
  const auto read = Store::read(scratch / "joined");
  ASSERT_TRUE(read) << read.error().message;
  const Store* const store = &read.value();
  EXPECT_EQ(store->trial_count(), 3u);
  store->for_each_trial([](const TrialRecord& r) {
    EXPECT_EQ(r.oracle_us, r.index == 0 ? 5u : 50u);
    EXPECT_EQ(r.detector_us, 60u);
  });
  EXPECT_EQ(store->failures()[0].smallest, "small");
  ASSERT_EQ(store->evidence().size(), 1u);
  EXPECT_EQ(store->evidence()[0].fields, R"({"more": 1})");
}

TEST_F(Merged, OtherRunsAreRefused) {
  auto other = request_of({2, 3});
  const auto refused = [&](const std::string& name, const std::string& word) {
    { open(name, binding_of(other)); }
    const auto before = merge({shards[0]}, "kept");
    const auto merged = merge_stores(Paths{shards[0], scratch / name}, scratch / "kept");
    ASSERT_FALSE(merged) << name;
    EXPECT_TRUE(says(merged.error(), "different runs: " + word));
    EXPECT_EQ(read_text(scratch / "kept"), before);
    other = request_of({2, 3});
  };
  other.seed = 2;
  refused("seed", "seed 1 and 2");
  other.plan.strata[0].cases = 10;
  refused("plan", "campaign/strata/0/cases 9 and 10");
  other.worker = "/bin/false";
  refused("digest", "another build of assay");
  other.detector.configurations.pop_back();
  refused("configurations", "detector/configurations/");
}

TEST_F(Merged, ContradictionsAreRefused) {
  const std::string binding = binding_of(request_of({1, 3}));
  const auto other = [&](const std::string& name) { return open(name, binding); };
  const auto trial = [&](const std::string& name, const auto& change) {
    {
      Store store = other(name);
      auto r = record(3);
      change(r);
      store.add(r);
    }
    expect_refused(scratch / name, "trial test:1:broken:3 differs");
  };
  trial("outcome", [](TrialRecord& r) { r.outcomes = "HH"; });
  trial("steps", [](TrialRecord& r) { r.steps = 3; });
  trial("counts", [](TrialRecord& r) { r.counts.tags["y"] = 1; });
  trial("mesh", [](TrialRecord& r) { r.mesh = 1; });
  {
    auto changed = failure(3);
    changed.mesh = "another";
    other("failure").add(changed);
  }
  expect_refused(scratch / "failure", "failure test:1:broken:3, bvh differs");
  { other("met").add(record(3), {}, {{"bvh", "u"}}); }
  expect_refused(scratch / "met", "met test:1:broken:3, bvh differs");
  { other("evidence").set({"canary", "c", "1/3", 1, R"({"found": 3})"}); }
  expect_refused(scratch / "evidence", "canary c, 1/3 differs");
}

// A merge that is killed leaves its parts; the next one leaves none, whoever made them.
TEST_F(Merged, NoPartsAreLeft) {
  scratch.write("all.building", "x");
  scratch.write("all.whole", "x");
  const auto before = merge(shards, "all");
  EXPECT_EQ(merge(shards, "all"), before);
  for (const auto& file : std::filesystem::directory_iterator(scratch / "")) {
    EXPECT_FALSE(file.path().filename().string().starts_with("all.")) << file.path();
  }
}

TEST_F(Merged, OneAtATimeInAFolder) {
  const int folder = ::open((scratch / "").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(folder, LOCK_EX), 0);
  const auto merged = merge_stores(shards, scratch / "all");
  ::close(folder);
  ASSERT_FALSE(merged);
  EXPECT_TRUE(says(merged.error(), "another merge is writing into it"));
  EXPECT_TRUE(merge_stores(shards, scratch / "all"));
}

TEST_F(Merged, FilesThatAreNoStores) {
  expect_refused(scratch / "none", "none: no such file");
  expect_refused(scratch.write("text", std::string(5000, 'x')), "not a database");
  { open("unbound", "no binding"); }
  expect_refused(scratch / "unbound", "not the store of a shard");
  EXPECT_FALSE(merge_stores(shards, scratch / "no/such/folder"));
}

}  // namespace
}  // namespace assay::properties
