// Queries in lanes: each instruction set is compared with the plain form, and both are compared
// with single queries.
#include "detector/contact/lanes/query_lanes.h"

#include "detector/contact/contact_pieces.h"
#include "detector/contact/rungs.h"
#include "detector/geometry/orientation.h"
#include "tests/detector/contact/query_draw.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// A step of single points, five for each query, and the queries.
struct Batch {
  SteppedMesh motion() const { return {x_t0, x_t1}; }
  FourPoints query(std::size_t i, int first_group) const {
    const auto& v = queries[i].v;
    const auto path = [&](std::size_t p) { return motion().path(v[p]); };
    return {{path(0), path(1), path(2), path(3)}, first_group};
  }
  Positions x_t0, x_t1;
  std::vector<QueryVertices> queries;
};

template <class Coordinate>
Batch make_batch(std::size_t count, const Coordinate& coordinate) {
  const auto n = static_cast<Eigen::Index>(5 * count);
  Batch batch{Positions(n, 3), Positions(n, 3), {}};
  for (auto* x : {&batch.x_t0, &batch.x_t1})
    *x = x->unaryExpr([&](double) { return coordinate(); });
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i)
    batch.queries.push_back({{5 * i, 5 * i + 1, 5 * i + 2, 5 * i + 3, 5 * i + 4}});
  return batch;
}

std::vector<LaneRung> rungs_of(QueryKernel kernel, const Batch& batch) {
  std::vector<LaneRung> rungs(batch.queries.size() + 1, LaneRung::axis);
  const std::size_t count = batch.queries.size();
  kernel(query_input(batch.motion()), batch.queries.data(), count, rungs.data());
  EXPECT_EQ(rungs.back(), LaneRung::axis) << "written beyond the end";
  rungs.pop_back();
  return rungs;
}

struct NeverHalves {
  bool may_halve(int, bool) { return false; }
  bool open(const ContactPiece<double>&) { return is_open = true; }
  void contact(const ContactPiece<double>&, double, int) { is_open = true; }
  bool is_open = false;
};

// What a lane has to say: what the filter says of the whole step, unless the coordinates have to be
// brought into its range first.
LaneRung expected(const FourPoints& query) {
  if (separated_along_an_axis(query)) return LaneRung::axis;
  Vector magnitude = {0, 0, 0};
  for (std::size_t j = 1; j < 4; ++j) grow(magnitude, difference(query.points[j], query.points[0]));
  if (!in_range(magnitude)) return LaneRung::open;
  NeverHalves search;
  ContactPieces<ProvedBounds, NeverHalves>(query, search).run();
  return search.is_open ? LaneRung::open : LaneRung::filter;
}

struct Settled {
  std::size_t queries = 0, by_axis = 0, by_filter = 0, piercings = 0, pierced = 0;
};

void ask_about(const Batch& batch, Settled& settled) {
  const QueryKernels &best = query_kernels(), &plain = plain_query_kernels();
  for (const int group : {1, 2}) {
    const auto kernel = group == 1 ? &QueryKernels::vertex_face : &QueryKernels::edge_edge;
    const auto rungs = rungs_of(plain.*kernel, batch);
    ASSERT_EQ(rungs_of(best.*kernel, batch), rungs);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const FourPoints query = batch.query(i, group);
      ASSERT_EQ(rungs[i], expected(query)) << "query " << i << ", first group " << group;
      settled.by_axis += rungs[i] == LaneRung::axis;
      settled.by_filter += rungs[i] == LaneRung::filter;
      ++settled.queries;
    }
  }
  const auto rungs = rungs_of(plain.piercing, batch);
  ASSERT_EQ(rungs_of(best.piercing, batch), rungs);
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    const auto& v = batch.queries[i].v;
    const auto point = [&](std::size_t p) { return batch.motion().start(v[p]); };
    const bool pierces =
        segment_pierces_triangle(point(0), point(1), {point(2), point(3), point(4)});
    ASSERT_NE(rungs[i], LaneRung::axis);
    ASSERT_FALSE(pierces && rungs[i] == LaneRung::filter) << "query " << i;
    settled.piercings += rungs[i] == LaneRung::filter;
    settled.pierced += pierces;
  }
}

TEST(QueryLanes, SayWhatTheFilterSaysOfTheWholeStep) {
  tests::QueryDraw draw(2112);
  Settled fine, coarse, far, extreme;
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::size_t count = 1 + i % 9;  // all lengths of the last group of lanes
    ask_about(make_batch(count, [&] { return draw.full(); }), fine);
    ask_about(make_batch(count, [&] { return static_cast<double>(draw.between(-2, 2)); }), coarse);
    ask_about(make_batch(count, [&] { return 0x1p40 + draw.full(); }), far);
    ask_about(make_batch(count, [&] { return std::ldexp(draw.full(), draw.between(-3, 3) * 340); }),
              extreme);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(fine.by_axis, 0u);
  EXPECT_GT(fine.by_filter, fine.queries / 6);
  EXPECT_GT(coarse.by_filter, 0u);
  EXPECT_GT(extreme.by_axis, 0u);
  EXPECT_GT(fine.piercings, fine.queries / 4);
  EXPECT_GT(fine.pierced, 0u);
}

TEST(QueryLanes, ReadRowsAtAnyStride) {
  tests::QueryDraw draw(2113);
  const Batch batch = make_batch(7, [&] { return draw.full(); });
  const Eigen::Index n = batch.x_t0.rows();
  std::vector<double> padded(static_cast<std::size_t>(5 * n),
                             std::numeric_limits<double>::quiet_NaN());
  const Eigen::Map<const Positions, 0, Eigen::OuterStride<>> wide(padded.data(), n, 3,
                                                                  Eigen::OuterStride<>(5));
  for (Eigen::Index i = 0; i < 3 * n; ++i)
    padded[static_cast<std::size_t>(i / 3 * 5 + i % 3)] = batch.x_t0.data()[i];
  for (const auto kernel :
       {&QueryKernels::vertex_face, &QueryKernels::edge_edge, &QueryKernels::piercing}) {
    std::vector<LaneRung> rungs(batch.queries.size());
    (query_kernels().*kernel)(query_input({wide, batch.x_t1}), batch.queries.data(), rungs.size(),
                              rungs.data());
    EXPECT_EQ(rungs, rungs_of(query_kernels().*kernel, batch));
  }
}

}  // namespace
}  // namespace assay::detector
