// Every case of corpus/curated with its own options and with every culling: answer, first time,
// pair set, view signs. Facts that later work builds on are listed as pending.
#include <nlohmann/json.hpp>

#include "corpus/cases/case_file.h"
#include "detector/contact/elementary.h"
#include "detector/mesh/topology.h"
#include "detector/view/view_signs.h"
#include "properties/judging/exam.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

class Curated : public testing::TestWithParam<std::filesystem::path> {};

std::string lines(const CaseCheck& report) {
  std::string out;
  for (const auto& line : report.broken_facts) out += "  " + line + "\n";
  return out;
}

TEST_P(Curated, Holds) {
  const auto c = corpus::read_case(GetParam());
  ASSERT_TRUE(c.has_value()) << c.error().message;
  ASSERT_FALSE(c.value().expected.steps.empty()) << "a case without facts checks nothing";
  const auto report = check_case(c.value());
  EXPECT_TRUE(report.broken_facts.empty()) << lines(report);
  for (const auto culling :
       {detector::Culling::view_auto, detector::Culling::view_point, detector::Culling::view_line,
        detector::Culling::normal_cone, detector::Culling::bvh, detector::Culling::none}) {
    const auto other = check_case(c.value(), culling);
    EXPECT_TRUE(other.broken_facts.empty()) << name_of(culling) << ":\n" << lines(other);
  }
  std::string pending;
  const auto facts = nlohmann::json::parse(c.value().pending);
  for (const auto& [name, value] : facts.items()) pending += " " + name;
  if (!pending.empty()) std::printf("pending:%s\n", pending.c_str());
}

INSTANTIATE_TEST_SUITE_P(Corpus, Curated, testing::ValuesIn(tests::curated_files()),
                         [](const auto& file) { return file.param.stem().string(); });

TEST(CuratedCorpus, IsComplete) { EXPECT_GE(tests::curated_files().size(), 50u); }

// No single query of a stored case takes long: every vertex and face, every two edges, the view of
// every triangle, whether or not a step would ask for them.

using namespace detector;

// Processor time of this thread.
double milliseconds_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// The slowest query so far.
struct Slowest {
  double ms = 0;
  std::string where;
  long queries = 0;

  template <class Call>
  void time(const std::string& file, Call call) {
    const double begin = milliseconds_now();
    call();
    const double taken = milliseconds_now() - begin;
    ++queries;
    if (taken <= ms) return;
    ms = taken;
    where = file;
  }
};

void time_step(const std::string& file, const corpus::Case& c, const SteppedMesh& motion,
               const std::optional<ViewPrimitive>& view, Slowest& slowest) {
  const Topology mesh = make_topology(c.triangles, motion.size());
  const auto point = [&](std::int32_t v) { return motion.path(v); };
  for (const auto& face : mesh.triangles) {
    const std::array<MovingPoint, 3> corners = {point(face[0]), point(face[1]), point(face[2])};
    for (std::int32_t v = 0; v < motion.size(); ++v) {
      if (v == face[0] || v == face[1] || v == face[2]) continue;
      const FourPoints query = four_points(VertexFace{point(v), corners});
      slowest.time(file, [&] { test_contact(query, Want::first_time); });
    }
    if (!view) continue;
    ViewCounts counts;
    slowest.time(file, [&] { view_sign(corners, *view, counts); });
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.edges.size(); ++j) {
      const auto &a = mesh.edges[i], &b = mesh.edges[j];
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) continue;
      const FourPoints query =
          four_points(EdgeEdge{{point(a[0]), point(a[1])}, {point(b[0]), point(b[1])}});
      slowest.time(file, [&] { test_contact(query, Want::first_time); });
    }
  }
}

TEST(CuratedTimes, NoQueryIsSlow) {
  Slowest slowest;
  for (const auto& c : tests::curated_cases()) {
    for (std::size_t step = 0; step + 1 < c.frames.size(); ++step) {
      time_step(c.id, c, {c.frames[step], c.frames[step + 1]}, corpus::view_of_step(c, step),
                slowest);
    }
  }
  std::printf("%ld queries, the slowest %.2f ms, of %s\n", slowest.queries, slowest.ms,
              slowest.where.c_str());
  constexpr double most_ms = 100;
  EXPECT_LT(slowest.ms, most_ms);
}

}  // namespace
}  // namespace assay::properties
