// Three methods that share no arithmetic answer the same queries: the oracle's rungs, the referee,
// and the detector's elementary test.
#include "detector/contact/elementary.h"
#include "oracle/query/contact.h"
#include "oracle/referee/referee.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::tests {
namespace {

using detector::Decision, detector::Want, oracle::test::QueryKind;

struct Verdicts {
  oracle::ContactAnswer oracle;
  detector::ContactResult detector;
  detector::Decision referee;
};

template <class Query>
Verdicts judge(const Query& query, oracle::ContactAnswer answer) {
  return {answer, detector::test_contact(detector::four_points(query), Want::first_time),
          oracle::referee(query)};
}

Verdicts judge(const oracle::test::Points& x, int first_group) {
  if (first_group == 1) {
    const auto query = oracle::test::vertex_face(x);
    return judge(query, oracle::vertex_face_contact(query, Want::first_time));
  }
  const auto query = oracle::test::edge_edge(x);
  return judge(query, oracle::edge_edge_contact(query, Want::first_time));
}

TEST(ThreeMethods, AgreeOnEveryKindOfQuery) {
  constexpr int queries_of_a_kind = 3000;
  for (int k = 0; k < oracle::test::query_kinds; ++k) {
    const auto kind = static_cast<QueryKind>(k);
    const std::uint64_t seed = 71 + static_cast<std::uint64_t>(k);
    oracle::test::Random random(seed);
    int contacts = 0, open = 0;
    for (int i = 0; i < queries_of_a_kind; ++i) {
      const int first_group = 1 + i % 2;
      const Verdicts v = judge(random_query(random, kind, first_group), first_group);
      contacts += v.oracle.contact ? 1 : 0;
      open += v.referee == detector::Decision::open ? 1 : 0;
      ASSERT_EQ(v.detector.contact, v.oracle.contact)
          << name_of(kind) << ", seed " << seed << ", query " << i;
      if (v.oracle.contact) {
        ASSERT_EQ(v.detector.time, v.oracle.first)
            << name_of(kind) << ", seed " << seed << ", query " << i;
      }
      if (v.referee == detector::Decision::open) continue;
      ASSERT_EQ(v.referee == detector::Decision::yes, v.oracle.contact)
          << name_of(kind) << ", seed " << seed << ", query " << i;
    }
    const double share = static_cast<double>(open) / queries_of_a_kind;
    std::printf("%-22s seed %llu: %d queries, %d contact, open %.2f %%\n", name_of(kind),
                static_cast<unsigned long long>(seed), queries_of_a_kind, contacts, 100 * share);
    EXPECT_GT(contacts, 0) << name_of(kind);
    if (kind == QueryKind::generic || kind == QueryKind::mesh_like) {
      EXPECT_LE(share, 0.05);
    }
    if (is_near_degenerate(kind)) {
      EXPECT_LE(share, 0.5);
    }
  }
}

}  // namespace
}  // namespace assay::tests
