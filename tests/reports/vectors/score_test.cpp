// `assay score`, and that corpus/vectors/vectors.py counts the same.
#include <random>

#include "tests/reports/json_schema.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

const std::string room = ASSAY_SOURCE_DIR "/corpus/vectors";
const std::string mini = ASSAY_SOURCE_DIR "/tests/corpus/vectors/mini_set";

SchemaJson json_of(const std::string& file) { return SchemaJson::parse(read_text(file)); }

// Answers to the mini set, an object an id.
SchemaJson good_answers() {
  return SchemaJson::parse(R"({
    "vf-d-0001": {"answer": "collision", "time": [0.5, 0.5]},
    "vf-d-0002": {"answer": "collision", "time": [0.25, 0.5]},
    "vf-d-0003": {"answer": "free"},
    "vf-d-0004": {"answer": "collision"},
    "ee-d-0001": {"answer": "collision"},
    "ee-d-0002": {"answer": "free"},
    "ee-d-0003": {"answer": "collision"},
    "vd-f-0001": {"answer": "free"},
    "vd-f-0002": {"answer": "collision"},
    "st-d-0001": {"steps": [{"answer": "free"}, {"answer": "collision", "pairs": [[0, 1]]},
                            {"answer": "free"}]},
    "lm-d-0001": {"steps": [{"answer": "share", "share": 0.25}]}})");
}

class Score : public testing::Test {
 protected:
  // A results file. `product` is its name.
  std::string results(const std::string& product, const SchemaJson& answers) const {
    const auto set = json_of(mini + "/set.json");
    SchemaJson json = {{"schema", "assay-results/1"},
                       {"set", SchemaJson::object()},
                       {"product", {{"name", product}, {"version", "1"}, {"settings", "s"}}},
                       {"seconds", 0.5},
                       {"answers", answers}};
    for (const auto* key : {"version", "profile", "digest"}) json["set"][key] = set[key];
    return scratch.write(product + ".json", json.dump());
  }
  Outcome score(const std::string& arguments) const {
    return run_assay("score --set " + mini + " " + arguments);
  }
  // The same by Python, on the same files.
  Outcome score_in_python(const std::string& arguments) const {
    const std::string command = "python3 " + room + "/vectors.py score --set " + mini + " " +
                                arguments + " >" + (scratch / "out") + " 2>" + (scratch / "err");
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_text(scratch / "out"), read_text(scratch / "err")};
  }
  SchemaJson with(const std::string& id, const SchemaJson& answer) const {
    auto answers = good_answers();
    answers[id] = answer;
    return answers;
  }
  void expect_refused(const std::string& file, const std::string& line) const {
    const auto outcome = score(file);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(line), std::string::npos) << outcome.err;
  }

  const Scratch scratch;
};

TEST_F(Score, RightAnswersEndWithZero) {
  const auto outcome = score(results("good", good_answers()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const auto* line :
       {"set 0.1.0 (mini), 11 cases, digest ", "A  good 1, s     11       0     0       0",
        "\nDoubleRoot            0/1\n", "\nA where features only touch: 0 closed, 1 open\n",
        "\nA pairs: 0 missing, 0 spurious\n",
        "\nA limits: 1 safe, the median uses 50.0 % of the way\n"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << "\n" << outcome.out;
  }
}

TEST_F(Score, ExitCodesSayTheWorst) {
  EXPECT_EQ(score(results("miss", with("vf-d-0001", {{"answer", "free"}}))).exit_code, 1);
  EXPECT_EQ(score(results("alarm", with("vf-d-0003", {{"answer", "collision"}}))).exit_code, 1);
  EXPECT_EQ(
      score(results("late", with("vf-d-0001", {{"answer", "collision"}, {"time", {0.75, 0.75}}})))
          .exit_code,
      1);
  for (const auto* word : {"undecided", "error", "crash", "timeout"})
    EXPECT_EQ(score(results(word, with("vf-d-0001", {{"answer", word}}))).exit_code, 3) << word;
  EXPECT_EQ(score(results("not", with("vf-d-0001", {{"answer", "unsupported"}}))).exit_code, 0);
  const auto both = results("miss", with("vf-d-0001", {{"answer", "free"}})) + " " +
                    results("crash", with("vf-d-0001", {{"answer", "crash"}}));
  EXPECT_EQ(score(both).exit_code, 1);
}

// Random answers of every kind: both programs print the same text and end alike.
TEST_F(Score, PythonCountsTheSame) {
  std::mt19937 random(7);
  const auto any = [&](auto... of) {
    const std::array list = {SchemaJson(of)...};
    return list[random() % list.size()];
  };
  const auto answer = [&](bool is_limit, bool is_mesh) {
    SchemaJson one = {{"answer", any("free", "collision", "collision", "undecided", "unsupported",
                                     "error", "crash", "timeout")}};
    if (is_limit && random() % 4 != 0)
      return SchemaJson{{"answer", "share"}, {"share", any(0.0, 0.25, 0.5, 1.0)}};
    if (is_limit) one["answer"] = any("undecided", "crash");
    if (one["answer"] == "collision" && random() % 2 == 0) {
      const double lo = any(0.0, 0.5, 0.75, 1.0, 1.0 / 3).get<double>();
      one["time"] = {lo, std::max(lo, any(0.5, 0.625).get<double>())};
    }
    if (one["answer"] == "collision" && is_mesh)
      one["pairs"] = any(SchemaJson::array(), SchemaJson::parse("[[0, 1]]"));
    return one;
  };
  std::set<int> codes;
  for (int round = 0; round < 6; ++round) {
    std::string files;
    for (int product = 0; product < 1 + 5 * (round % 2); ++product) {
      auto answers = good_answers();
      for (auto& [id, given] : answers.items()) {
        if (random() % 3 == 0) continue;
        if (!given.contains("steps")) {
          given = answer(false, false);
        } else {
          for (auto& step : given["steps"]) step = answer(id.starts_with("lm"), true);
        }
      }
      if (random() % 4 == 0) answers.erase("st-d-0001");
      files += " " + results("p" + std::to_string(product), answers);
    }
    const auto own = score(files), python = score_in_python(files);
    EXPECT_EQ(own.out, python.out);
    EXPECT_EQ(own.exit_code, python.exit_code) << own.err << python.err;
    codes.insert(own.exit_code);
  }
  EXPECT_TRUE(codes.contains(1));
}

TEST_F(Score, WhatDoesNotFitTheSetIsRefused) {
  expect_refused(scratch / "none", "none");
  expect_refused(scratch.write("text.json", "free"), "not JSON");
  expect_refused(results("id", with("vf-d-9999", {{"answer", "free"}})), "no such case");
  expect_refused(results("word", with("vf-d-0001", {{"answer", "maybe"}})), "answers.vf-d-0001");
  expect_refused(results("share", with("vf-d-0001", {{"answer", "share"}, {"share", 0.5}})),
                 "another question");
  expect_refused(results("steps", with("lm-d-0001", {{"steps", SchemaJson::array()}})),
                 "1 steps expected");
  expect_refused(results("time", with("vf-d-0001", {{"answer", "collision"}, {"time", {1, 0}}})),
                 "the lesser one first");
  auto pairs = with("st-d-0001", good_answers()["st-d-0001"]);
  pairs["st-d-0001"]["steps"][1]["pairs"] = SchemaJson::parse("[[0, 2]]");
  expect_refused(results("pairs", pairs), "pairs[0]");
  auto other = json_of(results("other", good_answers()));
  other["set"]["digest"] = std::string(64, '0');
  expect_refused(scratch.write("other.json", other.dump()),
                 "results of another set (0.1.0 mini, digest 000000000000)");
}

TEST_F(Score, ASetThatWasChangedIsRefused) {
  const auto folder = scratch / "set";
  std::filesystem::copy(mini, folder);
  std::ofstream(folder + "/steps-double.json", std::ios::app) << "\n";
  const auto outcome = run_assay("score --set " + folder + " " + results("a", good_answers()));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("steps-double.json: changed"), std::string::npos) << outcome.err;
}

TEST_F(Score, ThePageShowsMissesByFlagsAndNothingFromElsewhere) {
  auto answers = with("ee-d-0003", {{"answer", "free"}});
  answers["vf-d-0003"] = {{"answer", "collision"}};
  answers["lm-d-0001"]["steps"][0]["share"] = 0.5;
  const auto bad = results("bad", answers), good = results("good", good_answers());
  const auto page = scratch / "page.html", again = scratch / "again.html";
  EXPECT_EQ(score(bad + " " + good + " --out " + page).exit_code, 1);
  EXPECT_EQ(score(bad + " " + good + " --out " + again).exit_code, 1);
  const auto text = read_text(page);
  EXPECT_EQ(text, read_text(again)) << "same input, same bytes";
  for (const auto* part :
       {"<tr><th scope=\"row\">CoplanarThroughout<br><small>The cubic is zero, and a solver that "
        "divides by it answers free.</small></th><td class=\"bad\" data-of=\"A\"><b>&#x2717; 1/1"
        "</b></td><td class=\"good\" data-of=\"B\"><b>&#x2713; 0/1</b></td></tr>",
        "<td class=\"open\" data-of=\"A\"><b>! 0/1</b><small>1 alarm</small></td>",
        "<h3>A bad 1: 2 misses</h3>", "<h3>B good 1: no miss</h3>",
        "<code>ee-d-0003</code> Two edges slide along one line, in one plane throughout, and meet "
        "half way.<br><small>contact at t = 0.5; answered free. CoplanarThroughout, "
        "ParallelEdges</small>",
        "answered share 0.5", "<p>Alarms (1): <code>vf-d-0003</code></p>",
        "<li>A bad: 0 called contact, 1 free</li>", "prefers-color-scheme: dark"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  for (const auto* part : {"<script", "http:", "https:", "url(", "src=", "href="})
    EXPECT_EQ(text.find(part), std::string::npos) << part;
}

TEST_F(Score, WhatAProductCallsItselfStaysText) {
  auto json = json_of(results("plain", good_answers()));
  json["product"]["name"] = "<script>alert(\"1\")</script>&";
  const auto page = scratch / "page.html";
  const auto file = scratch.write("hostile.json", json.dump());
  EXPECT_EQ(score(file + " --out " + page).exit_code, 0);
  EXPECT_EQ(read_text(page).find("<script"), std::string::npos);
  EXPECT_NE(read_text(page).find("&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;"),
            std::string::npos);
}

void expect_schema(const std::string& schema_file, const SchemaJson& value, bool holds = true) {
  const auto schema = json_of(room + "/schema/" + schema_file);
  std::vector<std::string> wrong;
  check_schema(schema, schema, value, "", wrong);
  EXPECT_EQ(wrong.empty(), holds);
  for (const auto& line : wrong)
    if (holds) ADD_FAILURE() << line;
}

// Of the mini set, and of the committed one once it is there.
TEST_F(Score, SetsAndResultsAreAsTheirSchemasSay) {
  for (const auto& folder : {mini, room}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".json" || entry.path().filename() == "found.json") continue;
      SCOPED_TRACE(entry.path());
      auto value = json_of(entry.path());
      expect_schema("vectors.schema.json", value);
      if (folder == mini) {
        value.erase("schema");
        expect_schema("vectors.schema.json", value, false);
      }
    }
  }
  auto value = json_of(results("good", good_answers()));
  expect_schema("results.schema.json", value);
  value["answers"]["vf-d-0001"]["answer"] = "perhaps";
  expect_schema("results.schema.json", value, false);
}

}  // namespace
}  // namespace assay::tests
