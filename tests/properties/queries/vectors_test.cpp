// Proves each case of corpus/vectors again. A query is decided by the oracle, by CGAL's algebraic
// kernel and by the referee, which uses no polynomials. A step of a mesh is decided by the oracle,
// by the referee and by the detector in exact arithmetic. The digests of set.json are computed
// anew.
#include <fmt/format.h>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "corpus/json_fields.h"
#include "detector/detector.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact_events.h"
#include "oracle/query/times/times.h"
#include "oracle/referee/second_opinion.h"
#include "properties/queries/query_methods.h"
#include "properties/random.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using corpus::Json;
using detector::FeatureKind;

const std::string folder = ASSAY_SOURCE_DIR "/corpus/vectors/";

std::string text_of(const std::string& name) { return corpus::read_bytes(folder + name).value(); }
Json json_of(const std::string& name) { return corpus::parse_json(text_of(name), name).value(); }

detector::Positions positions_of(const Json& points) {
  return tests::matrix_of<detector::Positions>(points.get<std::vector<detector::Point>>());
}

std::optional<TimeEnclosure> first_time(const Json& facts) {
  if (!facts.contains("first_time")) return std::nullopt;
  return TimeEnclosure{facts["first_time"][0], facts["first_time"][1]};
}

bool is_referee_open(const Json& one) { return one.contains("open"); }

FourPoints query_of_vertices(const detector::SteppedMesh& motion,
                             const std::array<std::int32_t, 4>& vertices, int first_group) {
  FourPoints query;
  query.first_group = first_group;
  for (std::size_t i = 0; i < 4; ++i) query.points[i] = motion.path(vertices[i]);
  return query;
}

// Whether, inside of the step, the features meet while the cubic changes its sign.
bool passes(const FourPoints& query) {
  oracle::ContactPolynomials polynomials(query);
  const auto& f = polynomials.coplanarity();
  if (f.degree() < 1) return false;
  const oracle::AlgebraicTimes times({&f, 1});
  const auto slope = derivative(f), bend = derivative(slope);
  for (int i = 0; i < times.size(); ++i) {
    const bool is_inside = times.enclosure(i).hi > 0 && times.enclosure(i).lo < 1;
    // The zero is of odd order, which is 3 at most.
    const bool changes_sign = times.sign(slope, i) != 0 || times.sign(bend, i) == 0;
    if (is_inside && changes_sign && contact_at(polynomials, times, i)) return true;
  }
  return false;
}

bool passes(const detector::SteppedMesh& motion, const Eigen::RowVector3i& a,
            const Eigen::RowVector3i& b) {
  const auto pass = [&](const std::array<std::int32_t, 4>& vertices, int first_group) {
    return std::set(vertices.begin(), vertices.end()).size() == 4 &&
           passes(query_of_vertices(motion, vertices, first_group));
  };
  for (int i = 0; i < 3; ++i) {
    if (pass({a[i], b[0], b[1], b[2]}, 1) || pass({b[i], a[0], a[1], a[2]}, 1)) return true;
    for (int j = 0; j < 3; ++j)
      if (pass({a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]}, 2)) return true;
  }
  return false;
}

const char* word_of(bool meets, bool passes) {
  return !meets ? "free" : passes ? "collision" : "acceptable";
}

void check_by_all(const QueryTask& asked, const Json& one) {
  QueryTally tally;
  const auto wrong = check_query(asked, Random::hash(one["id"].get<std::string>()), tally);
  EXPECT_EQ(wrong.value_or(""), "");
  EXPECT_EQ(tally.open > 0, is_referee_open(one));
}

void prove_contact(const FourPoints& query, const Json& one) {
  check_by_all({query}, one);
  const auto answer = oracle::contact_of(query, detector::Want::first_time);
  EXPECT_EQ(one["result"], word_of(answer.contact, answer.contact && passes(query)));
  EXPECT_EQ(first_time(one), answer.contact ? std::optional(answer.first) : std::nullopt);
}

void prove_distance(const FourPoints& query, const Json& one) {
  const double d = one["distance"];
  check_by_all({query, {}, detector::Separation{d, 0}}, one);
  const auto near = oracle::first_time_within(query, {d, 0});
  const auto less = oracle::first_time_within(query, {d, -d * 0x1p-60}, detector::Want::yes_no);
  EXPECT_EQ(one["result"], word_of(near.contact, less.contact));
  EXPECT_EQ(first_time(one), near.contact ? std::optional(near.first) : std::nullopt);
  EXPECT_EQ(one.value("least_distance", std::numeric_limits<double>::infinity()),
            oracle::least_distance(query));
}

using PairTimes = std::map<std::pair<int, int>, std::pair<double, double>>;

PairTimes pair_times(const std::vector<detector::PairContact>& contacts) {
  PairTimes times;
  for (const auto& [pair, time, feature] : contacts) times[{pair.a, pair.b}] = {time.lo, time.hi};
  return times;
}

void prove_mesh(const Json& one, const std::string& question) {
  const auto triangles = tests::triangles(one["triangles"].get<std::vector<tests::Corners>>());
  std::vector<detector::Positions> frames;
  for (const auto& frame : one["frames"]) frames.push_back(positions_of(frame));
  auto built_in = detector::Detector::create(triangles, frames[0], {}).value();
  bool is_open = false;
  for (const auto& step : one["steps"]) {
    const auto &x_t0 = frames.at(step["from"]), &x_t1 = frames.at(step["to"]);
    const detector::SteppedMesh motion{x_t0, x_t1};
    const auto truth = oracle::judge_step(motion, triangles, {});
    const auto second = oracle::second_opinion(motion, triangles, truth, {});
    EXPECT_TRUE(second.contradictions.empty());
    is_open = is_open || second.open > 0;
    PairTimes pairs;
    for (const auto& p : step.value("pairs", Json::array())) pairs[{p[0], p[1]}] = {p[2], p[3]};
    EXPECT_EQ(pairs, pair_times(truth.pairs));
    const bool meets = !truth.pairs.empty();
    const bool passing = std::any_of(truth.pairs.begin(), truth.pairs.end(), [&](const auto& p) {
      return p.feature.kind == FeatureKind::piercing ||
             (p.feature.kind != FeatureKind::same_vertices &&
              passes(motion, triangles.row(p.pair.a), triangles.row(p.pair.b)));
    });
    EXPECT_EQ(step["result"], word_of(meets, passing));
    EXPECT_EQ(first_time(step), meets ? std::optional(truth.first) : std::nullopt);
    EXPECT_TRUE(question != "limit" || !meets || truth.first.hi > 0);
    const auto own = built_in.evaluate(x_t0, x_t1);
    EXPECT_EQ(pair_times(own.pairs), pairs);
    if (step["commit"]) built_in.commit();
  }
  EXPECT_EQ(is_open, is_referee_open(one));
}

class Vectors : public testing::TestWithParam<const char*> {};

TEST_P(Vectors, AreProvedAgain) {
  const auto group = json_of(std::string(GetParam()) + ".json");
  ASSERT_FALSE(group["cases"].empty());
  for (const auto& one : group["cases"]) {
    SCOPED_TRACE(one["id"]);
    if (group["features"] == "mesh") {
      prove_mesh(one, group["question"]);
      continue;
    }
    const auto t0 = positions_of(one["t0"]), t1 = positions_of(one["t1"]);
    const auto query =
        query_of_vertices({t0, t1}, {0, 1, 2, 3}, group["features"] == "vertex-face" ? 1 : 2);
    group["question"] == "distance" ? prove_distance(query, one) : prove_contact(query, one);
  }
}

constexpr const char* groups[] = {"vertex-face-double",   "vertex-face-distance-double",
                                  "edge-edge-double",     "edge-edge-distance-double",
                                  "steps-double",         "limits-double",
                                  "vertex-face-float32",  "vertex-face-distance-float32",
                                  "edge-edge-float32",    "edge-edge-distance-float32",
                                  "steps-float32",        "limits-float32",
                                  "vertex-face-findings", "vertex-face-distance-findings",
                                  "edge-edge-findings",   "steps-findings",
                                  "limits-findings",      "vertex-face-float32-findings"};
INSTANTIATE_TEST_SUITE_P(Groups, Vectors, testing::ValuesIn(groups), [](const auto& group) {
  std::string name = group.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(VectorSet, HasTheDigestsOfItsGroups) {
  const auto set = json_of("set.json");
  std::string lines;
  std::size_t cases = 0, place = 0;
  ASSERT_EQ(set["groups"].size(), std::size(groups));
  for (const auto& group : set["groups"]) {
    const std::string file = group["file"];
    EXPECT_EQ(file, groups[place++] + std::string(".json"));
    EXPECT_EQ(corpus::sha256_of(text_of(file)), group["sha256"]);
    lines += fmt::format("{}  {}\n", group["sha256"].get<std::string>(), file);
    EXPECT_EQ(json_of(file)["cases"].size(), group["cases"]);
    cases += group["cases"].get<std::size_t>();
  }
  EXPECT_EQ(corpus::sha256_of(lines), set["digest"]);
  EXPECT_EQ(cases, set["cases"]);
}

}  // namespace
}  // namespace assay::properties
