// Case files: what is read and written, which files are refused, and the curated cases.
#include "corpus/cases/case_file.h"

#include "corpus/files.h"
#include "tests/corpus/scratch.h"
#include "tests/curated_cases.h"

namespace assay::corpus {
namespace {

class CaseFile : public Scratch {};

// Every field in use.
Case full_case() {
  Case c;
  c.id = "full";
  c.about = "a \"quoted\" line";
  c.source = "hand";
  c.triangles = tests::triangles_of("0 1 2, 1 0 3");
  detector::Positions x(4, 3);
  x << 0.1, -0.0, 5e-324, 1.0 / 3, 1e22, -1.7976931348623157e308, 1, 0, 0, 0, 1, 0;
  c.frames = {x, 0.5 * x, x};
  c.view = CaseView{{{0, 0, 0}, {0, 0.5, 0}, {1, 1, 1}}, {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}};
  c.ghosts = CaseGhosts{{{{0, 0, 4}}, {{0, 0, 5}}, {{0, 0, 6}}}, tests::triangles_of("0 1 4")};
  c.options = {{"culling", "view-line"}, {"start", "verified"}};
  ExpectedStep step;
  step.answer = detector::Answer::collision;
  step.first_time = detector::TimeEnclosure{0.25, std::nextafter(0.25, 1)};
  step.pairs = std::vector<ExpectedPair>{{{0, 1}, *step.first_time}};
  step.view_signs = {detector::ViewSign::positive, detector::ViewSign::negative};
  step.ghost_view_signs = {detector::ViewSign::zero};
  c.expected = {detector::Answer::collision, {step, ExpectedStep{}}};
  c.pending = R"({"facts":{"closed":true,"t":0.1},"in_K":[[0,1]],"z":null,"a":1})";
  return c;
}

// The parser would take the last of two.
TEST_F(CaseFile, AKeyThatStandsTwiceIsRefusedByItsPlace) {
  const auto path = folder() / "full.json";
  ASSERT_TRUE(write_case(path, full_case()));
  const std::string whole = read_bytes(path).value();
  const auto problem_with = [&](std::string_view key, const std::string& before) {
    const auto at = whole.find("\"" + std::string(key) + "\":", whole.find("\"expected\""));
    write("twice.json", std::string(whole).insert(at, before));
    const auto read = read_case(folder() / "twice.json");
    return read ? "none" : read.error().message;
  };
  EXPECT_TRUE(says(problem_with("first_time", "\"first_time\": [0.25, 0.5], "),
                   "expected.steps[0].first_time occurs twice"));
  EXPECT_TRUE(says(problem_with("steps", "\"\\u0073teps\": [], "), "expected.steps occurs twice"))
      << "spelt otherwise, and the same";
  EXPECT_TRUE(says(problem_with("expected", "\"id\": \"other\", "), "id occurs twice"));
  EXPECT_EQ(problem_with("expected", ""), "none");
}

TEST_F(CaseFile, RoundTripKeepsEveryFieldAndEveryBit) {
  const Case c = full_case();
  const auto path = folder() / "full.json";
  ASSERT_TRUE(write_case(path, c));
  const Case d = value_of(read_case(path));
  const auto words = [](const Case& x) { return std::tie(x.id, x.about, x.source, x.pending); };
  EXPECT_EQ(words(d), words(c));
  EXPECT_EQ(d.triangles, c.triangles);
  ASSERT_EQ(d.frames.size(), c.frames.size());
  for (std::size_t f = 0; f < c.frames.size(); ++f)
    EXPECT_EQ(0, std::memcmp(d.frames[f].data(), c.frames[f].data(), 12 * sizeof(double)));
  EXPECT_EQ(std::tie(d.view->q0, d.view->q1), std::tie(c.view->q0, c.view->q1));
  EXPECT_EQ(d.ghosts->apexes, c.ghosts->apexes);
  EXPECT_EQ(d.ghosts->triangles, c.ghosts->triangles);
  EXPECT_EQ(d.options, c.options);
  EXPECT_EQ(d.expected.answer, c.expected.answer);
  ASSERT_EQ(d.expected.steps.size(), 2U);
  const auto facts = [](const ExpectedStep& step) {
    return std::tie(step.first_time, step.pairs, step.view_signs, step.ghost_view_signs);
  };
  EXPECT_TRUE(facts(d.expected.steps[0]) == facts(c.expected.steps[0]));
  EXPECT_FALSE(d.expected.steps[1].pairs);
  EXPECT_EQ(case_text(d), case_text(c));
}

TEST_F(CaseFile, WhatCouldNotBeReadIsNotWritten) {
  Case c = full_case();
  c.frames[1](0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(write_case(folder() / "a.json", c), "not JSON"));
  c = full_case();
  c.triangles(0, 0) = 4;
  EXPECT_TRUE(says(write_case(folder() / "a.json", c), "4 is not in [0, 4)"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "a.json"));
}

TEST_F(CaseFile, ViewOfStep) {
  Case c = full_case();
  const auto line = view_of_step(c, 1);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->q0.t0, (detector::Point{0, 0.5, 0}));
  EXPECT_EQ(line->q1.t1, (detector::Point{0, 0, 3}));
  EXPECT_FALSE(line->is_point());
  EXPECT_FALSE(view_of_step(c, 2));
  c.view->q1.clear();
  EXPECT_TRUE(view_of_step(c, 0)->is_point());
  c.view.reset();
  EXPECT_FALSE(view_of_step(c, 0));
}

TEST_F(CaseFile, AScriptNamesItsSteps) {
  Case c = full_case();
  EXPECT_EQ(steps_of(c), (std::vector<CaseStep>{{0, 1, true}, {1, 2, true}}));
  c.script = {{0, 2, false}, {0, 1, true}};
  const auto read = value_of(parse_case(case_text(c), "x"));
  EXPECT_EQ(read.script, c.script);
  EXPECT_EQ(case_text(read), case_text(c));
  EXPECT_EQ(view_of_step(c, 0)->q1.t1, (detector::Point{0, 0, 3}));
  EXPECT_EQ(start_of(c, c.script[0]), c.frames[0]);
  EXPECT_EQ(end_of(c, c.script[0]), c.frames[2]);
  c.script[1].to = 3;
  EXPECT_FALSE(parse_case(case_text(c), "x"));
}

// Everything that a relation may say, of triangles.
Case related_case() {
  Case c = full_case();
  CaseRelation relation;
  relation.pairs.body = {0, 0, 0, 0};
  relation.pairs.apart = {{0, 0}};
  relation.pairs.rings = 2;
  relation.pairs.rest_distance = 1.0 / 3;
  relation.pairs.rest.assign(4, {0.1, -0.0, 5e-324});
  relation.pairs.triangle_pairs = {{1, 0}};
  ExpectedStep step = c.expected.steps[0];
  step.view_signs.reset();
  step.ghost_view_signs.reset();
  relation.steps = {step, ExpectedStep{}};
  c.counted = relation;
  return c;
}

TEST_F(CaseFile, ARelationIsKeptAsItIs) {
  Case c = related_case();
  const auto kept = [&] {
    Case read = value_of(parse_case(case_text(c), "x"));
    EXPECT_EQ(read.counted->pairs, c.counted->pairs);
    EXPECT_EQ(case_text(read), case_text(c));
    return read.counted->steps;
  };
  ASSERT_EQ(kept().size(), 2U);
  EXPECT_EQ(kept()[0].pairs, c.counted->steps[0].pairs);

  // Places at rest that are those of frame 0 are not written.
  c.counted->pairs.rest = points_of(c.frames[0]);
  EXPECT_FALSE(says(case_text(c), "\"rest\""));
  kept();

  c.counted->pairs = {};
  c.counted->pairs.level = detector::CountedLevel::features;
  c.counted->pairs.vertex_faces = {{3, 0}, {2, 1}};
  c.counted->pairs.edge_pairs = {{{2, 0}, {3, 1}}};
  c.counted->steps.clear();
  EXPECT_TRUE(kept().empty());
}

TEST_F(CaseFile, AWrongRelationIsRefusedByName) {
  const auto names = [](const auto& change, const std::string& words) {
    Case c = related_case();
    change(*c.counted);
    EXPECT_TRUE(says(parse_case(case_text(c), "x"), words));
  };
  names([](auto& r) { r.pairs.body = {0, 0}; }, "counted: wrong_frame_size");
  names([](auto& r) { r.pairs.body = {0, 0, 0, 1, 1}; }, "counted.bodies: more than 4 vertices");
  names([](auto& r) { r.pairs.body = {0, 0, 0, 1}; }, "counted: triangle_of_two_bodies");
  names([](auto& r) { r.pairs.apart = {{0, 4}}; }, "counted.apart[0][1]: 4 is not in [0, 4)");
  names([](auto& r) { r.pairs.apart = {{0, 3}}; }, "counted: index_out_of_range");
  names([](auto& r) { r.pairs.rings = -1; }, "counted.rings: -1 is not in");
  names([](auto& r) { r.pairs.rest_distance = -0.5; }, "counted: wrong_relation");
  names([](auto& r) { r.pairs.rest.pop_back(); }, "counted: wrong_frame_size");
  names([](auto& r) { r.pairs.triangle_pairs = {{0, 2}}; }, "counted.triangle_pairs[0][1]");
  names([](auto& r) { r.pairs.triangle_pairs = {{1, 1}}; }, "counted: wrong_relation");
  names([](auto& r) { r.pairs.vertex_faces = {{3, 0}}; }, "counted: wrong_relation");
  names([](auto& r) { r.steps.pop_back(); }, "counted.steps: 2 items expected, not 1");
}

TEST_F(CaseFile, SmallestCase) {
  Case c;
  c.triangles = tests::triangles_of("0 1 2");
  c.frames = {detector::Positions::Zero(3, 3)};
  const auto read = value_of(parse_case(case_text(c), "small"));
  EXPECT_EQ(read.pending, "{}");
  EXPECT_FALSE(read.view);
  EXPECT_FALSE(read.ghosts);
  EXPECT_TRUE(read.expected.steps.empty());
}

TEST_F(CaseFile, ARefusedMeshMayBeACase) {
  Case c;
  c.triangles = tests::triangles_of("0 1 1");
  c.frames = {detector::Positions::Zero(3, 3)};
  EXPECT_TRUE(says(parse_case(case_text(c), "x"), "the triangle names a vertex twice"));
  c.expected.answer = detector::Answer::error;
  EXPECT_TRUE(parse_case(case_text(c), "x"));
}

TEST_F(CaseFile, ProblemsNameTheField) {
  const std::string good = case_text(full_case());
  const auto expect = [&](std::string_view words, std::string_view field, std::string_view from,
                          std::string_view to) {
    std::string text = good;
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    const auto read = parse_case(text, "bad.json");
    ASSERT_FALSE(read) << to;
    EXPECT_TRUE(says(read, words));
    EXPECT_TRUE(says(read, "bad.json"));
    EXPECT_TRUE(says(read, field));
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
  };
  expect("assay-case/1 expected", "schema", "assay-case/1", "assay-case/2");
  expect("is missing", "schema", "\"schema\"", "\"scheme\"");
  expect("is missing", "about", "\"about\"", "\"abbot\"");
  expect("is missing", "frames", "\"frames\"", "\"shots\"");
  expect("is missing", "expected", "\"expected\"", "\"wanted\"");
  expect("is missing", "pending", "\"pending\"", "\"later\"");
  expect("is missing", "view.q0", "\"q0\"", "\"p0\"");
  expect("is missing", "ghosts.apexes", "\"apexes\"", "\"tops\"");
  expect("is missing", "expected.steps[0].answer", "{\n        \"answer\": \"collision\",", "{\n");
  expect("a text expected", "id", "\"full\"", "7");
  expect("3 items expected, not 2", "triangles[1]", "[1, 0, 3]", "[1, 0]");
  expect("a whole number expected", "triangles[1][0]", "[1, 0, 3]", "[1.5, 0, 3]");
  expect("is not in [0, 4)", "triangles[1][2]", "[1, 0, 3]", "[1, 0, 4]");
  expect("is not in [0, 4)", "triangles[1][2]", "[1, 0, 3]", "[1, 0, -1]");
  expect("is not in [0, 4)", "triangles[1][2]", "[1, 0, 3]", "[1, 0, 18446744073709551615]");
  expect("is not in [0, 5)", "ghosts.triangles[0]", "[0, 1, 4]", "[0, 1, 5]");
  expect("3 items expected, not 2", "frames[0][2]", "[1, 0, 0]", "[1, 0]");
  expect("a number expected", "frames[0][2][0]", "[1, 0, 0]", "[\"1\", 0, 0]");
  expect("a number is too large for a double", "too large", "[1, 0, 0]", "[1e999, 0, 0]");
  expect("not JSON", "not JSON", "[1, 0, 0]", "[nan, 0, 0]");
  expect("vertices, but frame 0 has", "frames[1]", ",\n      [1, 0, 0]", "");
  expect("3 items expected, not 2", "view.q1", ",\n      [0, 0, 3]", "");
  expect("1 items expected, not 0", "ghosts.apexes", "[\n        [0, 0, 6]\n      ]", "[]");
  expect("a text expected", "options.start", "\"verified\"", "1");
  expect("free, collision, undecided or error expected", "expected.steps[0].answer",
         "{\n        \"answer\": \"collision\"", "{\n        \"answer\": \"crash\"");
  expect("times with 0 <= lo <= hi <= 1", "first_time", "\"first_time\": [0.25,",
         "\"first_time\": [0.5,");
  expect("2 items expected, not 3", "view_signs", "[1, -1]", "[1, -1, 0]");
  expect("-2 is not in [-1, 2)", "view_signs[1]", "[1, -1]", "[1, -2]");
  expect("1 is not in [0, 1)", "pairs[0]", "[0, 1, 0.25,", "[1, 1, 0.25,");
  expect("an object expected", "pending", "\"pending\": {", "\"pending\": [], \"x\": {");
}

TEST_F(CaseFile, NotJson) {
  EXPECT_TRUE(says(parse_case("{", "a"), "byte 2: not JSON"));
  EXPECT_TRUE(says(parse_case("}", "a"), "byte 1: not JSON"));
  EXPECT_TRUE(says(parse_case("7", "a"), "an object expected"));
  EXPECT_TRUE(says(parse_case("\xff", "a"), "byte 1: not JSON"));
  // Deep nesting would exhaust the stack of whoever prints it.
  EXPECT_TRUE(says(parse_case(std::string(1 << 20, '['), "a"), "byte 1048577: not JSON"));
  EXPECT_TRUE(says(parse_case(std::string(1 << 20, '[') + std::string(1 << 20, ']'), "a"),
                   "the JSON is nested too deeply"));
}

TEST_F(CaseFile, FoldersOfCases) {
  write("b.json", "{}");
  write("a.json", "{}");
  write("notes.txt", "");
  const auto files = value_of(case_files(folder()));
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].filename(), "a.json");
  EXPECT_TRUE(says(case_files(folder() / "absent"), "absent: No such file"));
}

// The curated cases are well-formed and consistent. Whether their facts are true is judged where
// the oracle is at hand.

std::vector<Case> curated() {
  std::vector<Case> cases;
  for (const auto& file : tests::curated_files()) {
    const auto read = read_case(file);
    EXPECT_TRUE(read) << read.error().message;
    EXPECT_EQ(read.value().id, file.stem().string());
    // In canonical form, byte by byte.
    EXPECT_EQ(read_bytes(file).value(), case_text(read.value())) << file;
    cases.push_back(read.value());
  }
  return cases;
}

// How often each directed edge occurs without its reverse.
int unmatched(const detector::Triangles& triangles, std::map<std::pair<int, int>, int>& excess) {
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int u = triangles(i, k), v = triangles(i, (k + 1) % 3);
      ++excess[{u, v}];
      --excess[{v, u}];
    }
  }
  int count = 0;
  for (const auto& [edge, n] : excess) count += n > 0 ? n : 0;
  return count;
}

TEST(Curated, WellFormedCanonicalAndConsistent) {
  const std::vector<Case> cases = curated();
  EXPECT_GE(cases.size(), 90U);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.id);
    EXPECT_FALSE(c.about.empty());
    ASSERT_EQ(c.expected.steps.size(), steps_of(c).size());
    auto answer = detector::Answer::free;
    for (const ExpectedStep& step : c.expected.steps) {
      if (step.answer == detector::Answer::collision) answer = step.answer;
      ASSERT_TRUE(step.pairs);
      EXPECT_EQ(step.answer == detector::Answer::collision, !step.pairs->empty());
      EXPECT_EQ(step.first_time.has_value(), !step.pairs->empty());
      for (std::size_t i = 0; i < step.pairs->size(); ++i) {
        const ExpectedPair& pair = (*step.pairs)[i];
        EXPECT_LT(pair.pair.a, pair.pair.b);
        EXPECT_LE(*step.first_time, pair.time);
        EXPECT_TRUE(pair.time.lo == pair.time.hi ||
                    std::nextafter(pair.time.lo, 2.0) == pair.time.hi);
        EXPECT_TRUE(i == 0 || (*step.pairs)[i - 1].pair < pair.pair);
      }
      EXPECT_EQ(step.view_signs.has_value(), c.view.has_value());
      EXPECT_EQ(step.ghost_view_signs.has_value(), c.ghosts.has_value());
    }
    EXPECT_EQ(c.expected.answer, answer);
    const auto culling = c.options.find("culling");
    ASSERT_NE(culling, c.options.end());
    EXPECT_TRUE(!c.view || culling->second == (c.view->q1.empty() ? "view-point" : "view-line"));
  }
}

TEST(Curated, GhostsCloseTheirMesh) {
  std::set<std::string> unclosed;
  for (const Case& c : curated()) {
    SCOPED_TRACE(c.id);
    std::map<std::pair<int, int>, int> excess;
    const int before = unmatched(c.triangles, excess);
    if (c.ghosts) {
      EXPECT_GT(before, 0);
      EXPECT_EQ(unmatched(c.ghosts->triangles, excess), 0);
    } else if (before > 0 && c.id.substr(0, 2) != "F_" && c.id.substr(0, 2) != "R_" &&
               c.id.substr(0, 2) != "V_" && c.id.substr(0, 2) != "X_") {
      // Those found by search, made to break a reader or a root, made after a fault that nothing
      // found, or about what a detector carries from step to step, leave it to the detector to
      // close their mesh.
      unclosed.insert(c.id);
    }
  }
  // Of the rest these two show what happens when nothing closes the mesh.
  EXPECT_EQ(unclosed, (std::set<std::string>{"A5_one_face_flipped", "E1_free_membrane"}));
}

}  // namespace
}  // namespace assay::corpus
