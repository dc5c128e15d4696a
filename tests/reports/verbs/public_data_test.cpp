// The public data sets through the program: real meshes, and every labelled query. Skipped if
// ASSAY_DATA names no folder.
#include "tests/public_data.h"

#include "corpus/queries/query_csv.h"
#include "detector/contact/elementary.h"
#include "detector/contact/rungs.h"
#include "oracle/query/contact.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

class PublicMeshes : public testing::Test {
 protected:
  void SetUp() override {
    if (!public_data()) GTEST_SKIP() << "no public data";
    data = public_data();
  }
  auto check(const std::string& arguments) const {
    expect_ended("check " + arguments + " --time 280 --memory 6GB --json " + (scratch / "r.json"),
                 0, {"detector and oracle agree"});
    return read_json(scratch / "r.json");
  }
  std::string data;
  const Scratch scratch;
};

TEST_F(PublicMeshes, RodTwist) {
  const std::string frames = data + "/scalable-ccd/rod-twist/frames/3036.ply " + data +
                             "/scalable-ccd/rod-twist/frames/3037.ply";
  for (const std::string culling : {"view-auto", "view-point", "view-line", "normal-cone", "bvh"}) {
    const auto report = check(frames + " --culling " + culling);
    ASSERT_EQ(report["steps"].size(), 1u);
    EXPECT_EQ(report["steps"][0]["pairs"].size(), 13145u) << culling;
  }
}

TEST_F(PublicMeshes, ClothedDancer) {
  const auto report = check(data + "/codim-ipc-kick/shell*.obj.gz --culling view-auto");
  EXPECT_EQ(report["steps"].size(), 6u);
  EXPECT_EQ(report["components"], 8);
}

TEST_F(PublicMeshes, ThickCloth) {
  check(data + "/ipc-toolkit/thick-cloth/t0.ply " + data + "/ipc-toolkit/thick-cloth/t1.ply" +
        " --culling view-auto");
}

TEST_F(PublicMeshes, TwoCubes) {
  const std::string cubes = data + "/ipc-toolkit/two-cubes-";
  check(cubes + "close.ply " + cubes + "intersecting.ply");
  check(cubes + "intersecting.ply " + cubes + "intersecting.ply");
}

TEST_F(PublicMeshes, BentBunny) {
  expect_ended("scene bend --mesh " + data + "/ipc-toolkit/bunny.ply --frames 6 --out " +
                   (scratch / "bunny"),
               0);
  for (const std::string culling : {"view-point", "view-line"})
    check((scratch / "bunny") + "/frame_*.ply --culling " + culling);
}

class PublicQueries : public PublicMeshes {
 protected:
  auto ask(const std::string& method, const std::string& files) const {
    expect_ended("check --method " + method + " " + files + " --json " + (scratch / "q.json"), 0);
    auto report = read_json(scratch / "q.json");
    EXPECT_EQ(report["differences"].size(), 0u) << method << " " << files;
    return report;
  }
  std::string samples() const { return data + "/sample-queries/*/*/*.csv"; }
  std::string simulation() const {
    const std::string rods = data + "/scalable-ccd/rod-twist/";
    return rods + "queries/3036ee.csv " + rods + "queries/3036vf.csv --truth " + rods +
           "mma_bool/3036ee_mma_bool.json " + rods + "mma_bool/3036vf_mma_bool.json";
  }
};

TEST_F(PublicQueries, NoDifferenceFromTheTruth) {
  for (const std::string method : {"oracle", "detector-exact"}) {
    EXPECT_EQ(ask(method, samples())["count"], 2324);
    const auto report = ask(method, simulation());
    EXPECT_EQ(report["count"], 5171);
    EXPECT_EQ(report["unlabelled"], 0);
  }
}

TEST_F(PublicQueries, RefereeContradictsNothing) {
  for (const auto& files : {samples(), simulation()}) {
    const auto report = ask("referee", files);
    EXPECT_GT(report["count"], 2000);
    EXPECT_EQ(report["contradictions"], 0);
  }
}

// Labels of queries that are coplanar for the whole step were never checked by their makers. Both
// exact methods settle each of them, and confirm every label.
TEST_F(PublicQueries, CoplanarThroughoutAreSettled) {
  int coplanar = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(data + "/sample-queries")) {
    if (entry.path().extension() != ".csv") continue;
    const auto queries = value_of(corpus::read_queries(entry.path()));
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto& q = queries[i];
      if (!detector::coplanar_throughout(q.query)) continue;
      ++coplanar;
      const auto ours = detector::exact_contact(q.query);
      const auto judged = oracle::contact_of(q.query, detector::Want::first_time);
      EXPECT_EQ(ours.contact, judged.contact) << entry.path() << " query " << i;
      EXPECT_TRUE(!ours.contact || ours.time == judged.first) << entry.path() << " query " << i;
      EXPECT_EQ(q.truth, judged.contact) << entry.path() << " query " << i;
    }
  }
  EXPECT_EQ(coplanar, 33);
}

}  // namespace
}  // namespace assay::tests
