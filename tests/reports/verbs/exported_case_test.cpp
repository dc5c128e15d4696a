// The source file that `assay replay --export` writes compiles with the detector alone, and its
// program passes.
#include "reports/steps/exported_case.h"

#include "properties/claims/claims.h"
#include "tests/reports/tiny_campaign.h"
#include "tests/sinking_corner.h"

namespace assay::tests {
namespace {

class ExportedCase : public testing::Test {
 protected:
  // Exports the case, compiles its test and runs it: what it prints, or nothing.
  void expect_passes(const std::string& id_or_file) const {
    SCOPED_TRACE(id_or_file);
    expect_ended("replay " + id_or_file + " --export " + (scratch / "case"), 0);
    ASSERT_EQ(compile(), 0) << read_text(scratch / "compiler");
    EXPECT_EQ(exit_code_of((scratch / "test >") + (scratch / "printed")), 0)
        << read_text(scratch / "printed");
    EXPECT_TRUE(says(read_text(scratch / "printed"), "1 test from"));
  }
  int compile() const {
    return exit_code_of(std::string(ASSAY_COMPILER) +
                        " -std=c++20 -Wall -Werror -I " ASSAY_SOURCE_DIR " -isystem " ASSAY_EIGEN
                        " " +
                        (scratch / "case/case_test.cpp") +
                        " " ASSAY_DETECTOR " " ASSAY_DETECTOR_LINKS
                        " -lgtest_main -lgtest "
                        "-pthread -o " +
                        (scratch / "test") + " >" + (scratch / "compiler") + " 2>&1");
  }
  const Scratch scratch;
};

TEST_F(ExportedCase, CompilesAndPasses) {
  expect_passes("tiny:1:unclosed-generic:3");
  // In floats, which claim no answer at all, so that a miss is none by its own test.
  std::string text = read_text(curated("B1_one_vertex_own_nearest"));
  const std::string options = "\"options\": {";
  text.insert(text.find(options) + options.size(), "\"arithmetic\": \"float\", ");
  expect_passes(scratch.write("float.json", text));
  EXPECT_TRUE(contains(read_text(scratch / "case/case.cpp"),
                       "{{Claim::deterministic, \"deterministic\"}, {Claim::total, \"total\"}},"));
  // With a line as its view, given, and several steps.
  expect_passes(curated("B1_one_vertex_own_nearest"));
}

TEST_F(ExportedCase, SaysWhichPairsCount) {
  expect_passes(curated("F_ignored_contact"));
  // A relation of every part, whose lists name what counts anyway.
  std::string text = read_text(curated("F_ignored_contact"));
  const std::string level = "\"level\": \"";
  const auto begin = text.find(level);
  ASSERT_NE(begin, std::string::npos);
  text.replace(begin, text.find("\"", begin + level.size()) - begin, level + "features");
  text.insert(text.find(",", begin),
              ", \"bodies\": [[9, 0]], \"rest_distance\": 0.5, \"vertex_faces\": [[0, 1], [0, 2]], "
              "\"edge_pairs\": [[0, 1, 1, 2]]");
  text.erase(text.find(",\n    \"steps\"", begin), std::string::npos);
  text += "\n  },\n  \"pending\": {}\n}\n";
  expect_passes(scratch.write("every_part.json", text));
}

TEST_F(ExportedCase, AsksForTheSeparationOfTheCase) {
  const auto c = sinking_corner(1, {{"culling", "bvh"}, {"separation", "2"}});
  expect_passes(scratch.write("within.json", corpus::case_text(c)));
  EXPECT_TRUE(contains(read_text(scratch / "case/case.cpp"),
                       "// Contract: neighbours no-shared-vertex, within 2.\n"));
}

TEST_F(ExportedCase, FailsWhereTheDetectorDiffers) {
  expect_passes(curated("A4_endpoints_only"));
  // The same test asked of another answer.
  std::string text = read_text(scratch / "case/case.cpp");
  const std::string collides = "{0, 1, true, true, ", is_free = "{0, 1, true, false, ";
  ASSERT_NE(text.find(collides), std::string::npos);
  text.replace(text.find(collides), collides.size(), is_free);
  scratch.write("case/case.cpp", text);
  ASSERT_EQ(compile(), 0) << read_text(scratch / "compiler");
  EXPECT_EQ(exit_code_of(scratch / "test >/dev/null"), 1);
}

// Of a plug-in: arrays that compile with nothing beside them, a function to fill in, and the same
// arrays through the library.
class ExportedPlugIn : public testing::Test {
 protected:
  // Exports what is wrong with the plug-in of this name under these words in its environment.
  Outcome export_case(const std::string& file, const std::string& name,
                      const std::string& words) const {
    return run_assay(
        "replay " + file + " --detector " + plugin(name) + " --export " + (scratch / "case"),
        words + " ");
  }
  void compile(const std::string& file, const std::string& more = "") const {
    EXPECT_EQ(exit_code_of(std::string(ASSAY_COMPILER) + " -std=c++17 -Wall -Wextra -Werror " +
                           (scratch / ("case/" + file)) + more + " -o " + (scratch / "program") +
                           " >" + (scratch / "compiler") + " 2>&1"),
              0)
        << read_text(scratch / "compiler");
  }
  void compile_plugin() const { compile("case_plugin.cpp", " -I " ASSAY_SOURCE_DIR " -ldl"); }
  int judged(const std::string& name, const std::string& words) const {
    return exit_code_of(words + " " + (scratch / "program ") + plugin(name) + " >" +
                        (scratch / "printed"));
  }
  // Fills in the function of the exported source and runs it.
  int filled_in(const std::string& lines) const {
    std::string text = read_text(scratch / "case/case.cpp");
    const std::string unfilled = "  return found;";
    EXPECT_TRUE(says(text, unfilled));
    text.replace(text.find(unfilled), unfilled.size(),
                 "  found.filled_in = true;\n" + lines + "\n  return found;");
    scratch.write("case/filled.cpp", text);
    compile("filled.cpp");
    return exit_code_of((scratch / "program >") + (scratch / "printed"));
  }
  std::string printed() const { return read_text(scratch / "printed"); }
  const Scratch scratch;
};

TEST_F(ExportedPlugIn, IsPlainArrays) {
  expect_ended(
      export_case("slow:1:closed-generic:19", "by_contract", "ASSAY_BY_CONTRACT=miss-inside"), 1);
  EXPECT_FALSE(std::filesystem::exists(scratch / "case/case_test.cpp"));
  EXPECT_FALSE(contains(read_text(scratch / "case/case.json"), "\"answer\""))
      << "nobody stated what is expected";
  compile("case.cpp");
  EXPECT_EQ(exit_code_of(scratch / "program >/dev/null"), 2);
  EXPECT_EQ(filled_in(""), 1);
  expect_says(printed(), {"breaks free-sound\n", "answered free, exact collision at "});
  compile_plugin();
  EXPECT_EQ(judged("by_contract", "ASSAY_BY_CONTRACT=claims=255"), 0) << printed();
  EXPECT_EQ(judged("by_contract", "ASSAY_BY_CONTRACT=miss-inside"), 1);
  EXPECT_EQ(judged("by_contract", "ASSAY_BY_CONTRACT=late=0.1"), 0) << "another claim";
  EXPECT_EQ(exit_code_of(scratch / "program ./none.so >/dev/null"), 2);
}

TEST_F(ExportedPlugIn, IsToldWhichPairsCount) {
  expect_ended(
      export_case(curated("F_ignored_contact"), "takes_relations", "ASSAY_TAKES_RELATIONS=ignores"),
      1);
  compile_plugin();
  EXPECT_EQ(judged("takes_relations", "ASSAY_TAKES_RELATIONS="), 0) << printed();
  EXPECT_EQ(judged("takes_relations", "ASSAY_TAKES_RELATIONS=ignores"), 1) << printed();
  // One that cannot be told has no answer.
  EXPECT_EQ(judged("wrapped_builtin", ""), 0) << "which another claim is about\n" << printed();
  EXPECT_TRUE(contains(printed(), "no answer: ")) << printed();
}

// In each step the triangles 0 and 1 meet at 0.5. Each answer breaks one claim, and another keeps
// it.
TEST(ExportedAnswers, AreAskedForEveryClaim) {
  namespace x = exported_case;
  const double frames[] = {0, 0, 0, 1, 1, 1};
  const x::Step meets{0, 1, true, true, 0.5, 0.5, "1/2", "1/2", {{0, 1, 0.5, 0.5, 0}}, {}};
  const x::Step free{0, 1, true, false, 0, 0, "0", "0", {}, {}};
  const x::Case c{0, nullptr, 2, 1, frames, {}, {}, 0, 0.9, 0x1p-52, false};
  x::Found right;
  right.collision = true;
  right.lo = right.hi = 0.5;
  right.pairs = right.candidates = {{0, 1, 0.5, 0.5, -1}};
  right.share = 0.49;
  right.stop = {0.49, 0.49, 0.49};
  const auto changed = [&](const auto& change) {
    auto found = right;
    change(found);
    return found;
  };
  const auto to_the_end = changed([](auto& found) { found.stop = {1, 1, 1}; });
  const auto silent = changed([](auto& found) { found.pairs.clear(); });
  const auto more = changed([](auto& found) { found.pairs.push_back({0, 2, 0, 1, -1}); });
  using enum properties::Claim;
  const std::map<properties::Claim, x::Found> wrong = {
      {free_sound, x::Found()},
      {not_late, changed([](auto& found) { found.lo = found.hi = 0.75; })},
      {first_time, changed([](auto& found) { found.lo = found.hi = 0.25; })},
      {first_pairs, silent},
      {all_pairs, changed([](auto& found) { found.pairs[0].lo = 0.75; })},
      {no_spurious, more},
      {total, changed([](auto& found) { found.error = "none"; })},
      {candidates, changed([](auto& found) { found.candidates.clear(); })},
      {commit_free, to_the_end},
      {path_free, changed([](auto& found) { found.share = 0.5; })},
      {progress, changed([](auto& found) { found.share = 0.4; })},
      {times_unique, changed([](auto& found) { found.lo = 0.25; })}};
  for (const auto claim : all_values<properties::Claim>) {
    SCOPED_TRACE(name_of(claim));
    const auto asked = static_cast<x::Claim>(claim);
    EXPECT_TRUE(x::holds(asked, c, meets, right));
    if (claim == properties::Claim::whole) {
      EXPECT_FALSE(x::holds(asked, c, free, right));
      EXPECT_TRUE(x::holds(asked, c, free, to_the_end));
    } else if (claim == deterministic) {
      EXPECT_NE(x::text_of(right), x::text_of(silent));
      EXPECT_EQ(x::text_of(right), x::text_of(right));
    } else {
      ASSERT_TRUE(wrong.count(claim));
      EXPECT_FALSE(x::holds(asked, c, meets, wrong.at(claim)));
    }
  }
}

// For each claim alone: a plug-in that breaks it, and one that keeps it.
TEST_F(ExportedPlugIn, AsksForEachClaim) {
  struct Wrong {
    const char *claim, *plugin, *wrong, *right_plugin, *right;
  };
  const char *contract = "by_contract", *candidates = "candidates_alone";
  for (const auto& [claim, name, wrong, right_name, right] :
       std::vector<Wrong>{{"free-sound", contract, "claims=1 miss-inside", contract, "claims=1"},
                          {"not-late", contract, "claims=2 late=0.1", contract, "claims=2"},
                          {"first-time", contract, "claims=4 early=0.1", contract, "claims=4"},
                          {"first-pairs", contract, "claims=8 miss-inside", contract, "claims=8"},
                          {"all-pairs", contract, "claims=16 drop-last", contract, "claims=16"},
                          {"no-spurious", contract, "claims=32 early=0.1", contract, "claims=32"},
                          {"deterministic", contract, "claims=64 changing", contract, "claims=64"},
                          {"deterministic", "wrong_wrapper", "10", "wrapped_builtin", "none"},
                          {"total", contract, "claims=128 no-interval", contract, "claims=128"},
                          {"total", contract, "claims=128 abort", contract, "claims=128"},
                          {"total", "exit", "none", "wrapped_builtin", "none"},
                          {"candidates", candidates, "every-second", candidates, "none"}}) {
    SCOPED_TRACE(std::string(claim) + " " + name);
    const auto words = [](const std::string& given) {
      return "ASSAY_BY_CONTRACT='" + given + "' ASSAY_TEST_WRONG='" + given +
             "' ASSAY_CANDIDATES=" + given.substr(0, given.find(' '));
    };
    expect_ended(export_case(curated("D6_fast_passage"), name, words(wrong)), 1,
                 {std::string("DEFECT ") + claim});
    expect_says(read_text(scratch / "case/case.cpp"), {std::string(", \"") + claim + "\"}},\n"});
    compile_plugin();
    EXPECT_EQ(judged(name, words(wrong)), 1) << printed();
    EXPECT_TRUE(contains(printed(), std::string("breaks ") + claim)) << printed();
    EXPECT_EQ(judged(right_name, words(right)), 0) << printed();
  }
}

TEST_F(ExportedPlugIn, WhoClaimsLittleDoesNotFailByItsOwnTest) {
  const std::string words = "ASSAY_BY_CONTRACT='claims=1 whenever'";
  expect_ended(export_case(curated("A4_endpoints_only"), "by_contract", words), 0);
  EXPECT_EQ(filled_in("  found.collision = true;"), 0) << printed();
  compile_plugin();
  EXPECT_EQ(judged("by_contract", words), 0) << printed();
}

// It reports what comes within 0.5, and may report what comes within 0.25 and the margin.
TEST_F(ExportedPlugIn, MayReportWhatComesWithinItsSlack) {
  const auto words = [](const std::string& margin) {
    return "ASSAY_KEEPS_DISTANCE='separation=0.25 squares-it margin=" + margin + "'";
  };
  for (const double z : {0.4, 0.1}) {
    SCOPED_TRACE(z);
    const auto file = scratch.write("case.json", corpus::case_text(sinking_corner(z)));
    ASSERT_EQ(export_case(file, "keeps_distance", words("0.3")).exit_code, 0);
    compile_plugin();
    EXPECT_EQ(judged("keeps_distance", words("0.3")), 0) << printed();
    ASSERT_EQ(export_case(file, "keeps_distance", words("0.1")).exit_code, 1);
    compile_plugin();
    EXPECT_EQ(judged("keeps_distance", words("0.1")), 1) << printed();
    EXPECT_TRUE(contains(printed(), "breaks no-spurious\n")) << printed();
  }
}

TEST_F(ExportedPlugIn, LeavesOutWhatTheContractDoes) {
  const std::string words = "ASSAY_BY_CONTRACT=strangers";
  expect_ended(export_case(curated("A1_winding2_allpositive"), "by_contract", words), 0,
               {" left out by the contract, the first at t = "});
  compile_plugin();
  EXPECT_EQ(judged("by_contract", words), 0) << printed();
  EXPECT_EQ(judged("wrapped_builtin", ""), 0) << "who reports them is not wrong\n" << printed();
  EXPECT_EQ(judged("by_contract", "ASSAY_BY_CONTRACT='strangers drop-last'"), 1) << printed();
}

}  // namespace
}  // namespace assay::tests
