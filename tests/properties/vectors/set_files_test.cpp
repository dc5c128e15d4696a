// A set is written and read back; verification finds what is changed in it.
#include "properties/vectors/set_files.h"

#include <gtest/gtest.h>

#include <regex>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "corpus/queries/query_csv.h"
#include "properties/queries/query_families.h"
#include "properties/vectors/mesh_facts.h"
#include "properties/vectors/methods.h"
#include "properties/vectors/query_facts.h"
#include "properties/vectors/set_reader.h"
#include "properties/worker/plugin/query_case.h"
#include "tests/corpus/scratch.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;

Vector query_vector(const std::string& family, std::uint64_t i, const std::string& id) {
  Vector v;
  v.c = make_case(*find_family(family), "vectors-test:" + std::to_string(i)).c;
  v.c.id = id;
  v.c.about = "A query.";
  v.c.source = "a test";
  const auto query = *query_of(v.c);
  v.steps = {contact_facts(query)};
  const auto flags = flags_of(query, v.steps[0], 0, VectorPrecision::float64);
  v.flags.assign(flags.begin(), flags.end());
  v.hard = hardness_of(query, v.steps[0], 0);
  return v;
}

VectorSet small_set() {
  VectorSet set;
  set.profile = "core";
  VectorGroup faces,
      edges{VectorFeatures::edge_edge, VectorQuestion::contact, VectorPrecision::float64, {}};
  const auto add = [&](const std::string& family, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      auto v = query_vector(family, i, family + "-" + std::to_string(i));
      (query_of(v.c)->first_group == 1 ? faces : edges).cases.push_back(std::move(v));
    }
  };
  add("query-small-int", 20);
  add("query-exponents", 2);
  add("query-denormals", 2);
  VectorGroup steps{VectorFeatures::mesh, VectorQuestion::contact, VectorPrecision::float64, {}};
  for (int i = 0; i < 6; ++i) {
    auto c = make_case(families()[0], "vectors-test:" + std::to_string(i)).c;
    c.id = "m-" + std::to_string(i);
    c.view.reset();
    steps.cases.push_back(*mesh_vector(c, steps.question, steps.precision));
  }
  set.groups = {faces, edges, steps};
  say_open_methods(set, 1);
  return set;
}

bool same(const Vector& a, const Vector& b) {
  return a.c.id == b.c.id && a.c.about == b.c.about && a.c.frames == b.c.frames &&
         a.c.triangles == b.c.triangles && corpus::steps_of(a.c) == corpus::steps_of(b.c) &&
         a.steps == b.steps && a.flags == b.flags && a.hard == b.hard && a.open == b.open &&
         a.breaks == b.breaks && query_word(a.c) == query_word(b.c);
}

class VectorFiles : public corpus::Scratch {
 protected:
  std::filesystem::path folder() const { return write("a_file", "").parent_path(); }
};

TEST_F(VectorFiles, AreReadBackAsTheyWereWritten) {
  const auto set = small_set();
  ASSERT_TRUE(write_set(folder(), set));
  const auto read = read_set(folder());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().digest, digest_of(set));
  EXPECT_EQ(digest_of(read.value().set), digest_of(set));
  ASSERT_EQ(read.value().set.groups.size(), set.groups.size());
  for (std::size_t g = 0; g < set.groups.size(); ++g) {
    const auto& cases = set.groups[g].cases;
    ASSERT_EQ(read.value().set.groups[g].cases.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_TRUE(same(read.value().set.groups[g].cases[i], cases[i])) << cases[i].c.id;
  }
  EXPECT_TRUE(contradictions_of(read.value().set, 2).empty());
}

TEST_F(VectorFiles, QueriesStandInRationalsToo) {
  const auto set = small_set();
  ASSERT_TRUE(write_set(folder(), set));
  const auto& faces = set.groups[0].cases;
  const auto queries = corpus::read_queries(folder() / "csv/vertex-face/double.csv");
  ASSERT_TRUE(queries) << queries.error().message;
  ASSERT_EQ(queries.value().size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto query = *query_of(faces[i].c);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(queries.value()[i].query.points[k].t0, query.points[k].t0);
      EXPECT_EQ(queries.value()[i].query.points[k].t1, query.points[k].t1);
    }
    EXPECT_EQ(queries.value()[i].truth, faces[i].result() != VectorResult::free);
  }
}

TEST_F(VectorFiles, RefuseWhatTheDigestsDoNotName) {
  ASSERT_TRUE(write_set(folder(), small_set()));
  const auto file = folder() / "steps-double.json";
  auto text = corpus::read_bytes(file).value();
  text.replace(text.find("free"), 4, "FREE");
  std::ofstream(file) << text;
  const auto read = read_set(folder());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("steps-double.json"), std::string::npos);
}

TEST_F(VectorFiles, RefuseADigestThatIsNotThatOfTheGroups) {
  const auto set = small_set();
  ASSERT_TRUE(write_set(folder(), set));
  const auto file = folder() / "set.json";
  auto text = corpus::read_bytes(file).value();
  const auto digest = digest_of(set);
  text.replace(text.find(digest), digest.size(), std::string(digest.size(), '0'));
  std::ofstream(file) << text;
  const auto read = read_set(folder());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("its digest"), std::string::npos) << read.error().message;
}

TEST_F(VectorFiles, RefuseAnIdThatIsThereTwice) {
  auto set = small_set();
  set.groups[0].cases[1].c.id = set.groups[0].cases[0].c.id;
  ASSERT_TRUE(write_set(folder(), set));
  const auto read = read_set(folder());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("twice"), std::string::npos) << read.error().message;
}

// Writes the small set with its meshes edited, and digests that are again those of the files.
Expected<ReadSet> read_edited(const fs::path& folder, const std::string& what,
                              const std::string& by) {
  const auto set = small_set();
  EXPECT_TRUE(write_set(folder, set));
  const auto text_of = [&](const std::string& name) {
    return corpus::read_bytes(folder / name).value();
  };
  auto said = text_of("set.json");
  const auto say = [&](const std::string& old, const std::string& now) {
    said.replace(said.find(old), old.size(), now);
  };
  const auto before = text_of("steps-double.json");
  const auto after = std::regex_replace(before, std::regex(what), by);
  EXPECT_NE(before, after) << what;
  std::ofstream(folder / "steps-double.json") << after;
  say(corpus::sha256_of(before), corpus::sha256_of(after));
  std::string lines;
  for (const auto& group : set.groups)
    lines += corpus::sha256_of(text_of(group.name() + ".json")) + "  " + group.name() + ".json\n";
  say(digest_of(set), corpus::sha256_of(lines));
  std::ofstream(folder / "set.json") << said;
  return read_set(folder);
}

TEST_F(VectorFiles, MayLeaveOutWhatIsNotJudgedBy) {
  const auto read = read_edited(
      folder(),
      R"re(,"(pairs|polynomial|flags|hard|source|about)":(\[\[.*?\]\]|\[.*?\]|\{.*?\}|".*?"))re",
      "");
  ASSERT_TRUE(read) << read.error().message;
  int contacts = 0;
  for (const auto& v : read.value().set.groups[2].cases) {
    EXPECT_EQ(v.c.about + v.c.source + v.hard.kind, "");
    EXPECT_TRUE(v.flags.empty());
    for (const auto& facts : v.steps) {
      contacts += facts.first ? 1 : 0;
      EXPECT_FALSE(facts.pairs) << "absent is not empty";
    }
  }
  EXPECT_GT(contacts, 0);
  const auto empty = read_edited(folder(), R"re("pairs":\[\[.*?\]\])re", "\"pairs\":[]");
  ASSERT_TRUE(empty) << empty.error().message;
  int stated = 0;
  for (const auto& v : empty.value().set.groups[2].cases)
    for (const auto& facts : v.steps) stated += facts.pairs && facts.pairs->empty() ? 1 : 0;
  EXPECT_EQ(stated, contacts);
}

TEST_F(VectorFiles, RefusePairsTimesAndSchemasThatCannotBe) {
  for (const auto& [what, by, message] :
       {std::array{R"re("pairs":\[\[[0-9]+,[0-9]+)re", "\"pairs\":[[0,999", "pairs[0]"},
        {R"re("pairs":\[\[[0-9]+,[0-9]+)re", "\"pairs\":[[0,0", "the lesser one first"},
        {R"re("first_time":\[[^\]]*\])re", "\"first_time\":[1,0]", "the lesser one first"},
        {"assay-vectors/1", "assay-vectors/9", "assay-vectors/9"}}) {
    const auto read = read_edited(folder(), what, by);
    ASSERT_FALSE(read) << by;
    EXPECT_NE(read.error().message.find(message), std::string::npos) << read.error().message;
  }
}

TEST(Verification, FindsEachWrongStatement) {
  const auto sound = small_set();
  ASSERT_TRUE(contradictions_of(sound, 2).empty());
  const auto one_is_found = [&](const std::function<bool(Vector&)>& change) {
    auto set = sound;
    for (auto& group : set.groups) {
      for (auto& v : group.cases) {
        if (!change(v)) continue;
        const auto found = contradictions_of(set, 2);
        EXPECT_EQ(found.size(), 1u);
        if (!found.empty()) {
          EXPECT_EQ(found[0].id, v.c.id);
        }
        return;
      }
    }
    ADD_FAILURE() << "no case to change";
  };
  one_is_found([](Vector& v) {
    if (v.result() != VectorResult::collision) return false;
    v.steps[0].result = VectorResult::acceptable;
    return true;
  });
  one_is_found([](Vector& v) {
    if (v.steps[0].polynomial.size() < 3) return false;
    v.steps[0].polynomial[0] += "1";
    return true;
  });
  one_is_found([](Vector& v) {
    if (!v.steps[0].first || v.steps[0].first->hi == 1) return false;
    v.steps[0].first->hi = 1;
    return true;
  });
  one_is_found([](Vector& v) {
    if (!v.steps[0].pairs || v.steps[0].pairs->size() < 2) return false;
    v.steps[0].pairs->pop_back();
    return true;
  });
  one_is_found([](Vector& v) {
    v.flags.push_back(VectorFlag::sequence);
    return true;
  });
  one_is_found([](Vector& v) {
    v.open = {"referee"};
    return true;
  });
}

// A vertex that passes a face at rest in the second half of the step.
VectorSet split_set() {
  const auto moved = [](double from, double to, const std::string& id, const std::string& of) {
    detector::FourPoints query;
    query.points = {{{{0, 0, from}, {0, 0, to}},
                     {{-1, -1, 0}, {-1, -1, 0}},
                     {{3, -1, 0}, {3, -1, 0}},
                     {{-1, 3, 0}, {-1, 3, 0}}}};
    auto v = query_vector(case_of_query(query, id), 0, VectorPrecision::float64);
    v.flags.push_back(VectorFlag::split_invariant);
    std::sort(v.flags.begin(), v.flags.end());
    v.split_of = of;
    return v;
  };
  VectorSet set;
  set.groups.emplace_back();
  set.groups[0].cases = {moved(3, -1, "whole", ""), moved(3, 1, "one", "whole"),
                         moved(1, -1, "two", "whole")};
  return set;
}

TEST(Verification, LooksAtHalves) {
  EXPECT_TRUE(contradictions_of(split_set(), 1).empty());
  const auto found_by = [](const std::function<void(std::vector<Vector>&)>& change) {
    auto set = split_set();
    change(set.groups[0].cases);
    const auto found = contradictions_of(set, 1);
    return found.size() == 1 ? found[0].id + " " + found[0].text : std::string("nothing");
  };
  EXPECT_EQ(found_by([](auto& cases) { cases.pop_back(); }), "whole has not two halves");
  EXPECT_EQ(found_by([](auto& cases) { std::swap(cases[1], cases[2]); }),
            "whole its halves are none");
  EXPECT_EQ(found_by([](auto& cases) { std::erase(cases[0].flags, VectorFlag::split_invariant); }),
            "whole has halves unsaid");
}

TEST(Neighbours, AreAskedOfAllMethods) {
  const auto tally = check_neighbours(small_set(), 500, 2);
  EXPECT_EQ(tally.queries, 500u);
  EXPECT_TRUE(tally.contradictions.empty());
  Random random("neighbour");
  const auto query = query_generators()[0].make(1, 0).query;
  const auto moved = neighbour_of(query, VectorPrecision::float32, random);
  int changed = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      changed += moved.points[i].t0[k] != query.points[i].t0[k] ? 1 : 0;
      changed += moved.points[i].t1[k] != query.points[i].t1[k] ? 1 : 0;
      EXPECT_EQ(static_cast<float>(moved.points[i].t0[k]), moved.points[i].t0[k]);
    }
  }
  EXPECT_GE(changed, 1);
  EXPECT_LE(changed, 3);
}

}  // namespace
}  // namespace assay::properties
