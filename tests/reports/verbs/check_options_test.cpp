// `check` finds out the kind of its input from the content of the file, and takes each option only
// with certain kinds. The tests try every pair of a kind and an option, and all pairs of options
// that exclude each other.
#include <fmt/format.h>

#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// In the order of the letters below.
const std::string kinds = "frbclq";

// An option with a value, and the letters of the kinds that take it: frames, a mesh at rest,
// bodies, a case file, a log, queries.
struct OptionOfKinds {
  std::string words, of;
};

class CheckOptions : public testing::Test {
 protected:
  static std::string mesh(double height) {
    return fmt::format(
        "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 1 1 {0}\nv 1 2 {0}\nv 2 1 {1}\nf 1 2 3\nf 4 5 6\n", height,
        height + 1);
  }
  static std::string log() {
    const auto path = scratch / "a log";
    write_missed_contact(path);
    return "'" + path + "'";
  }

  static inline const Scratch scratch;
  const std::string a = scratch.write("a.obj", mesh(2)), b = scratch.write("b.obj", mesh(1));
  const std::string queries = example_queries();
  const std::string table = scratch.write("table.csv", "1,free,\n");
  const std::string truths = scratch.write("truths.json", "[true, false, true, true, false]");
  const std::string recorded = log();
  const std::string inputs[6] = {
      a + " " + b, a,      "--body " + a + " --body " + b, curated("A4_endpoints_only"),
      recorded,    queries};
  const char* const said[6] = {"frames",      "a mesh at rest", "bodies",
                               "a case file", "a log",          "queries"};

  std::vector<OptionOfKinds> options() const {
    const auto out = [](const char* name) { return scratch / name; };
    return {{"--apart 0,1", "b"},
            {"--rings 1", "frb"},
            {"--rest-distance 0.5", "frb"},
            {"--weld", "frb"},
            {"--share 0.5", "l"},
            {"--from 1", "l"},
            {"--follow", "l"},
            {"--truth " + truths, "q"},
            {"--method referee", "q"},
            {"--detector " + plugin("steps_and_query") + " --keep " + out("kept"), "frbcl"},
            {"--detector " + plugin("steps_and_query"), "frbcq"},
            {"--isolation limits --detector " + plugin("steps_and_query"), "frbcq"},
            {"--threads 1 --detector " + plugin("steps_and_query"), "frbcq"},
            {"--answers " + table, "frbc"},
            {"--adjacency no-shared-vertex --answers " + table, "frbc"},
            {"--culling bvh", "frbc"},
            {"--start verified", "frbc"},
            {"--pairs first", "frbc"},
            {"--arithmetic exact", "frbc"},
            {"--no-oracle", "frbc"},
            {"--second-opinion 1", "frbcl"},
            {"--separation 0.25", "frbcq"},
            {"--offset 0.1 0.2", "b"},
            {"--jobs 1", "frbcl"},
            {"--time 60", "frbcl"},
            {"--memory 6GB", "frbcl"},
            {"--fail-on-collision", "frbcl"},
            {"--keep " + out("kept"), "frbcl"},
            {"--shrink-time 1", "l"},
            {"--ply " + out("marked.ply"), "frbc"},
            {"--all-steps", "l"},
            {"--junit " + out("junit.xml"), "l"},
            {"--json " + out("report.json"), kinds}};
  }
};

std::string name_in(const std::string& words) { return words.substr(0, words.find(' ')); }

TEST_F(CheckOptions, EachIsTakenByItsKindsAloneAndTheRefusalNamesBoth) {
  for (const auto& [words, of] : options()) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto line = "check " + inputs[k] + " " + words;
      SCOPED_TRACE(line);
      const auto outcome = run_assay(line);
      const bool is_taken = of.find(kinds[k]) != std::string::npos;
      EXPECT_EQ(outcome.exit_code == 2, !is_taken) << outcome.err;
      // Of two options either may be refused, and --detector asks for another.
      const bool is_one = words.find(" --") == std::string::npos && words.find("--det") != 0;
      if (is_taken || !is_one) continue;
      expect_refused(outcome, name_in(words) + " is for ");
      expect_refused(outcome, std::string("but the input is ") + said[k]);
      expect_refused(outcome, "leave it out, or assay check ");
    }
  }
}

TEST_F(CheckOptions, AreAllInTheTable) {
  std::set<std::string> tested = {"--body"};
  for (const auto& option : options()) tested.insert(name_in(option.words));
  const auto help = run_assay("help check").out;
  const std::regex row("\n  (--[a-z-]+)");
  std::set<std::string> listed;
  for (std::sregex_iterator match(help.begin(), help.end(), row), end; match != end; ++match)
    listed.insert((*match)[1]);
  EXPECT_EQ(listed, tested);
}

TEST_F(CheckOptions, TwoThatDoNotGoTogetherAreRefused) {
  const std::string library = " --detector " + plugin("always_free"),
                    answers = " --answers " + table;
  const std::vector<std::string> of_built_in = {" --culling bvh", " --start verified",
                                                " --pairs first", " --arithmetic exact"};
  std::vector<std::vector<std::string>> pairs = {{library, answers},
                                                 {" --no-oracle", " --second-opinion 1"}};
  for (const auto& option : of_built_in) {
    pairs.push_back({library, option});
    pairs.push_back({answers, option});
  }
  for (const std::string distance : {" --separation 1", " --offset 1 1"}) {
    for (const auto& option : of_built_in) pairs.push_back({distance, option});
    for (const auto& option :
         {library, answers, std::string(" --no-oracle"), std::string(" --second-opinion 1"),
          " --keep " + (scratch / "no"), " --ply " + (scratch / "no.ply")})
      pairs.push_back({distance, option});
  }
  pairs.push_back({" --offset 1 1", " --separation 1"});
  for (const auto& pair : pairs) {
    for (const auto& [first, second] : {std::pair(pair[0], pair[1]), {pair[1], pair[0]}}) {
      const auto outcome = run_assay("check " + inputs[2] + first + second);
      expect_refused(outcome, " do not go together");
      for (const auto& option : pair) expect_refused(outcome, name_in(option.substr(1)));
    }
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "no"));
  expect_refused("check " + queries + " --method oracle" + library, "--method do not go together");
  // Of queries a plug-in says by itself which distance it is asked for.
  expect_ended("check " + queries + " --separation 0 --detector " + plugin("steps_and_query"), 0);
}

TEST_F(CheckOptions, WhatMeansNothingByItselfIsRefused) {
  expect_ended("check " + a + " --threads 1", 0);
  expect_refused("check " + a + " --isolation limits",
                 "--isolation means nothing without --detector");
  expect_refused("check " + recorded + " --threads 2",
                 "--threads means nothing without --detector");
  expect_refused("check " + queries + " --threads 2", "--threads means nothing without --detector");
  expect_refused("check " + a + " " + b + " --adjacency all",
                 "--adjacency means nothing without --answers");
  for (const char* among : {" --share 0.5", " --from 2"})
    expect_refused("check '" + (scratch / "a log") + "#1'" + among, "choose among all");
}

TEST_F(CheckOptions, InputsThatAreNotOfOneKindAreRefused) {
  const auto bare = curated("A4_endpoints_only");
  const auto expect_one_by_one = [&](const std::string& words, const std::string& next) {
    SCOPED_TRACE(words);
    expect_refused("check " + words, "check one by one: assay check " + next);
  };
  expect_one_by_one(a + " " + recorded, recorded);
  expect_one_by_one(recorded + " " + a, recorded);
  expect_one_by_one(a + " " + bare, bare);
  expect_one_by_one(bare + " " + bare, bare);
  expect_one_by_one(queries + " " + a, queries);
  expect_one_by_one(queries + " --body " + a, queries);
  expect_one_by_one("--body " + a + " --body " + recorded, recorded);
  for (const auto& [file, name] : {std::pair(queries, "a query file"), {bare, "a case file"}})
    expect_refused("check --body " + file,
                   "--body takes frames, but " + file + " is " + name + ": assay check " + file);
  expect_refused("check " + a + " --body " + b,
                 a + " and --body do not go together: assay check --body FRAME... --body FRAME...");
  expect_ended("check " + queries + " " + queries, 0, {"oracle: 10 queries"});
}

TEST_F(CheckOptions, TheBytesTellTheKindAndThenTheName) {
  const auto copied = [&](const std::string& name, const std::string& file) {
    return scratch.write(name, read_text(file));
  };
  expect_ended("check " + copied("case.obj", curated("A4_endpoints_only")), 0);
  expect_ended("check " + copied("log.ply", scratch / "a log"), 1, {"recorded of "});
  expect_ended("check " + copied("posted_vf.txt", queries), 0, {"oracle: 5 queries"});
  expect_ended("check " + copied("mesh_vf.obj", a), 0, {"at rest: free"});
  std::string blanks = read_text(queries);
  std::ranges::replace(blanks, ',', ' ');
  expect_ended("check " + scratch.write("blanks_vf.txt", blanks), 0, {"oracle: 5 queries"});
  for (const char* rows :
       {"1,free,\n", "step,answer,time\n1,free,\n", "# mine\n2,collision,0.5\n"}) {
    const auto file = scratch.write("answers.csv", rows);
    expect_refused("check " + file, file +
                                        " is a table of answers, which needs frames: "
                                        "assay check FRAME... --answers " +
                                        file);
  }
  expect_refused("check " + scratch.write("none.bin", "noise\n"), "it begins with \"noise\": ");
  expect_refused("check " + scratch.write("none", "\x01\x02"), "it is no text: ");
  expect_refused("check " + scratch.write("none.log", "no log"),
                 "and it is no case file, log or query file (assay check --help)");
  expect_refused("check " + scratch.write("cloud.xyz", "0 0 0\n1 0 0\n"),
                 "it begins with \"0 0 0\"");
  expect_refused("check " + scratch.write("a.gltf", "{\"asset\": {}}"), "a glTF file");
  expect_refused("check " + (scratch / "absent.log"), "absent.log: cannot be read");
}

}  // namespace
}  // namespace assay::tests
