// Every case of corpus/curated with its own options and with every culling: answer, first time,
// pair set, view signs.
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

TEST_P(Curated, Holds) {
  const auto c = corpus::read_case(GetParam());
  ASSERT_TRUE(c.has_value()) << c.error().message;
  ASSERT_FALSE(c.value().expected.steps.empty()) << "a case without facts checks nothing";
  const std::vector<std::string> none;
  EXPECT_EQ(check_case(c.value()).broken_facts, none);
  for (const auto culling : all_values<detector::Culling>) {
    if (culling == detector::Culling::automatic) continue;
    EXPECT_EQ(check_case(c.value(), culling).broken_facts, none) << name_of(culling);
  }
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
    if (taken > ms) std::tie(ms, where) = std::tie(taken, file);
  }
};

void time_step(const corpus::Case& c, std::size_t step, Slowest& slowest) {
  const SteppedMesh motion{c.frames[step], c.frames[step + 1]};
  const auto view = corpus::view_of_step(c, step);
  const Topology mesh = make_topology(c.triangles, motion.size());
  const auto point = [&](std::int32_t v) { return motion.path(v); };
  for (const auto& face : mesh.triangles) {
    const std::array<MovingPoint, 3> corners = {point(face[0]), point(face[1]), point(face[2])};
    for (std::int32_t v = 0; v < motion.size(); ++v) {
      if (v == face[0] || v == face[1] || v == face[2]) continue;
      const FourPoints query = four_points(VertexFace{point(v), corners});
      slowest.time(c.id, [&] { test_contact(query, Want::first_time); });
    }
    if (!view) continue;
    ViewCounts counts;
    slowest.time(c.id, [&] { view_sign(corners, *view, counts); });
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.edges.size(); ++j) {
      const auto &a = mesh.edges[i], &b = mesh.edges[j];
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) continue;
      const FourPoints query =
          four_points(EdgeEdge{{point(a[0]), point(a[1])}, {point(b[0]), point(b[1])}});
      slowest.time(c.id, [&] { test_contact(query, Want::first_time); });
    }
  }
}

TEST(CuratedTimes, NoQueryIsSlow) {
  Slowest slowest;
  for (const auto& c : tests::curated_cases())
    for (std::size_t step = 0; step + 1 < c.frames.size(); ++step) time_step(c, step, slowest);
  std::printf("%ld queries, the slowest %.2f ms, of %s\n", slowest.queries, slowest.ms,
              slowest.where.c_str());
  constexpr double most_ms = 100;
  EXPECT_LT(slowest.ms, most_ms);
}

}  // namespace
}  // namespace assay::properties
