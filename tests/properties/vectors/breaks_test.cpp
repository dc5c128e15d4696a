// The conformance set keeps what was found of public detectors, and each of them still answers it
// wrongly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"
#include "properties/vectors/answers.h"

namespace assay::properties {
namespace {

const std::filesystem::path folder = ASSAY_SOURCE_DIR "/corpus/vectors";

// Two cases with the same text have the same motion.
std::string motion_of(const corpus::Case& c) {
  corpus::Case kept;
  kept.triangles = c.triangles;
  kept.frames = c.frames;
  kept.script = c.script;
  return case_text(kept);
}

// By closed sets, which is what the peers claim: what only touches is a contact.
bool is_wrong(const VectorAnswer& answer, const VectorFacts& facts) {
  if (facts.result == VectorResult::free) return answer.answer == "collision";
  if (answer.answer == "free") return true;
  if (answer.answer != "collision") return false;
  if (answer.time && answer.time->lo > facts.first->hi) return true;
  if (!answer.pairs || !facts.pairs) return false;
  std::vector<detector::TrianglePair> wanted;
  for (const auto& contact : *facts.pairs) wanted.push_back(contact.pair);
  auto given = *answer.pairs;
  std::sort(given.begin(), given.end());
  return given != wanted;
}

struct Found {
  std::string product, cause, motion;
};

const std::vector<Found>& all_found() {
  static const auto found = [] {
    const auto path = folder / "found.json";
    const auto json = corpus::parse_json(corpus::read_bytes(path).value(), path).value();
    std::vector<Found> list;
    for (const auto& item : json.at("found")) {
      const auto c = corpus::parse_case(item.at("case").dump(), path.string()).value();
      list.push_back({item.at("breaks"), item.at("cause"), motion_of(c)});
    }
    return list;
  }();
  return found;
}

const VectorSet& shipped_set() {
  static const auto read = read_set(folder).value();
  return read.set;
}

// A case that two detectors fail on stands in the set once, and names both.
TEST(FoundCases, EachCauseThatWasFoundIsInTheSet) {
  std::map<std::string, std::vector<std::string>> named;  // by motion
  for (const auto& group : shipped_set().groups) {
    for (const auto& v : group.cases) {
      auto& names = named[motion_of(v.c)];
      names.insert(names.end(), v.breaks.begin(), v.breaks.end());
    }
  }
  ASSERT_GT(all_found().size(), 300u);
  for (const auto& one : all_found()) {
    const auto& names = named[one.motion];
    EXPECT_EQ(std::count(names.begin(), names.end(), one.product), 1)
        << one.product << ": " << one.cause;
  }
}

class BreaksPeers : public testing::TestWithParam<const char*> {};

TEST_P(BreaksPeers, ThePeerAnswersWrongly) {
  const auto library = std::string(ASSAY_PEER_DIR) + "/" + GetParam() + ".so";
  if (!std::filesystem::exists(library)) {
    const char* ci = std::getenv("CI");
    ASSERT_STRNE(ci ? ci : "", "true") << library << " was not built";
    GTEST_SKIP() << library << " was not built: what it needs is not installed";
  }
  const auto subject = Subject::open(ASSAY_WORKER, library, DetectorPart::by_library, {});
  ASSERT_TRUE(subject) << subject.error().message;
  const std::string product = subject.value().description.name;
  VectorSet asked;
  for (const auto& group : shipped_set().groups) {
    auto part = group;
    std::erase_if(part.cases, [&](const Vector& v) {
      return std::count(v.breaks.begin(), v.breaks.end(), product) == 0;
    });
    asked.groups.push_back(std::move(part));
  }
  const auto results = answers_of_plugin(asked, subject.value(), 1);
  ASSERT_TRUE(results) << results.error().message;
  std::size_t i = 0;
  for (const auto& group : asked.groups) {
    for (const auto& v : group.cases) {
      const auto& [id, answers] = results.value().answers.at(i++);
      ASSERT_EQ(id, v.c.id);
      bool wrong = false;
      for (std::size_t s = 0; s < answers.size(); ++s)
        wrong = wrong || is_wrong(answers[s], v.steps.at(s));
      EXPECT_TRUE(wrong) << product << " answers " << id << " as it is: " << v.c.source;
    }
  }
  EXPECT_GT(i, 0u) << product;
}

INSTANTIATE_TEST_SUITE_P(Peers, BreaksPeers,
                         testing::Values("cubic_double", "cubic_float", "cubic_eigen",
                                         "fcl_elementary", "bullet_bernstein"),
                         [](const auto& peer) { return std::string(peer.param); });

}  // namespace
}  // namespace assay::properties
