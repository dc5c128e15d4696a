// `assay bench --suite peers --quick` with all peers that were built: every row has numbers, absent
// peers are named, and the row of the shipped detector has the promised values.
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

TEST(PeersSuite, EveryPeerThatIsPresentHasFigures) {
  const tests::Scratch scratch;
  const auto done =
      tests::run_assay("bench --suite peers --quick --jobs 2 --peers " ASSAY_PEER_DIR " --json " +
                       (scratch / "peers.json"));
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto json = nlohmann::json::parse(tests::read_text(scratch / "peers.json"));
  ASSERT_GE(json["subjects"].size(), 6u + 5u) << "these need no library";
  for (const auto& absent : json["absent_peers"]) {
    const std::string name = absent["name"];
    EXPECT_FALSE(absent["why"].get<std::string>().empty()) << name;
    EXPECT_TRUE(says(done.out, "absent: " + name));
  }
  for (const auto& row : json["subjects"]) {
    const std::string name = row["subject"];
    const auto& counts = row["counts"];
    EXPECT_FALSE(row["time_over_reference"].is_null()) << name;
    EXPECT_FALSE(row["bytes_a_triangle"].is_null()) << name;
    EXPECT_GT(counts["steps"], 100) << name;
    EXPECT_GT(counts["contact"], 20) << name;
    EXPECT_LE(counts["confirmed"], counts["unsafe"]) << name;
    if (!row["is_built_in"].get<bool>()) {
      // Nobody is accused by the oracle alone.
      for (const auto& answer : json["unsafe_answers"])
        EXPECT_TRUE(answer["subject"] != name || answer["what"] != "missed" ||
                    answer["confirmed"].get<bool>())
            << answer.dump();
      continue;
    }
    EXPECT_EQ(counts["undecided"], 0) << name;
    EXPECT_EQ(counts["left_out"], 0) << name;
    const bool is_exact = name.find("exact") != std::string::npos;
    const bool is_bounded = name.find("bounded") != std::string::npos;
    EXPECT_TRUE(!(is_exact || is_bounded) || counts["unsafe"] == 0) << name;
    EXPECT_TRUE(!is_exact || counts["false_alarms"] == 0) << name;
  }
}

}  // namespace
}  // namespace assay::reports
