// The public data sets through the program: real meshes and every labelled query. Skipped where
// ASSAY_DATA names no folder.
#include "tests/public_data.h"

#include "corpus/queries/query_csv.h"
#include "detector/contact/elementary.h"
#include "detector/contact/rungs.h"
#include "oracle/query/contact.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using nlohmann::json;

class PublicMeshes : public testing::Test {
 protected:
  void SetUp() override {
    if (!public_data()) GTEST_SKIP() << "no public data";
    data = public_data();
  }
  json check(const std::string& arguments) {
    expect_ended("check " + arguments + " --time 280 --memory 6GB --json " + (scratch / "r.json"),
                 0, {"detector and oracle agree"});
    return json::parse(read_text(scratch / "r.json"));
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
  const auto made = run_assay("scene bend --mesh " + data +
                              "/ipc-toolkit/bunny.ply --frames 6 --out " + (scratch / "bunny"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const std::string culling : {"view-point", "view-line"}) {
    check((scratch / "bunny") + "/frame_*.ply --culling " + culling);
  }
}

class PublicQueries : public PublicMeshes {};

TEST_F(PublicQueries, NoDifferenceFromTheTruth) {
  for (const std::string method : {"oracle", "detector-exact"}) {
    const std::string json_file = scratch / "q.json";
    const auto outcome = expect_ended(
        "check --method " + method + " " + data + "/sample-queries/*/*/*.csv --json " + json_file,
        0);
    EXPECT_EQ(json::parse(read_text(json_file))["count"], 2324);
    EXPECT_EQ(json::parse(read_text(json_file))["differences"].size(), 0u) << outcome.out;
    const std::string rods = data + "/scalable-ccd/rod-twist/";
    const auto simulation =
        expect_ended("check --method " + method + " " + rods + "queries/3036ee.csv " + rods +
                         "queries/3036vf.csv --truth " + rods + "mma_bool/3036ee_mma_bool.json " +
                         rods + "mma_bool/3036vf_mma_bool.json --json " + json_file,
                     0);
    const auto report = json::parse(read_text(json_file));
    EXPECT_EQ(report["count"], 5171);
    EXPECT_EQ(report["unlabelled"], 0);
    EXPECT_EQ(report["differences"].size(), 0u) << simulation.out;
  }
}

TEST_F(PublicQueries, RefereeContradictsNothing) {
  const std::string rods = data + "/scalable-ccd/rod-twist/";
  const std::string truths = " --truth " + rods + "mma_bool/3036ee_mma_bool.json " + rods +
                             "mma_bool/3036vf_mma_bool.json";
  for (const std::string& files :
       {data + "/sample-queries/*/*/*.csv",
        rods + "queries/3036ee.csv " + rods + "queries/3036vf.csv" + truths}) {
    const auto outcome =
        expect_ended("check --method referee " + files + " --json " + (scratch / "q.json"), 0);
    const auto report = json::parse(read_text(scratch / "q.json"));
    EXPECT_GT(report["count"], 2000);
    EXPECT_EQ(report["contradictions"], 0);
    EXPECT_EQ(report["differences"].size(), 0u) << outcome.out;
    std::printf("%s", outcome.out.c_str());
  }
}

// Labels of queries that are coplanar for the whole step were never checked by their makers. Both
// exact methods settle each of them, and confirm every label.
TEST_F(PublicQueries, CoplanarThroughoutAreSettled) {
  int coplanar = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(data + "/sample-queries")) {
    if (entry.path().extension() != ".csv") continue;
    const auto queries = corpus::read_queries(entry.path());
    ASSERT_TRUE(queries.has_value()) << queries.error().message;
    for (std::size_t i = 0; i < queries.value().size(); ++i) {
      const auto& q = queries.value()[i];
      if (!detector::coplanar_throughout(q.query)) continue;
      ++coplanar;
      const auto ours = detector::exact_contact(q.query);
      const auto judged = oracle::contact_of(q.query, detector::Want::first_time);
      EXPECT_EQ(ours.contact, judged.contact) << entry.path() << " query " << i;
      if (ours.contact && judged.contact) {
        EXPECT_EQ(ours.time, judged.first) << entry.path() << " query " << i;
      }
      EXPECT_EQ(q.truth, judged.contact) << entry.path() << " query " << i;
    }
  }
  std::printf("%d queries are coplanar throughout\n", coplanar);
  EXPECT_EQ(coplanar, 33);
}

}  // namespace
}  // namespace assay::tests
