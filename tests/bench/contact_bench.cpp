// Times the elementary test: in each arithmetic, in lanes, and on the slowest single queries that
// are known.
#include <algorithm>
#include <cmath>

#include "corpus/queries/query_csv.h"
#include "detector/contact/elementary.h"
#include "detector/contact/lanes/query_lanes.h"
#include "detector/view/view_signs.h"
#include "oracle/query/contact.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "reports/bench/sweep.h"
#include "tests/bench/step_parts.h"

namespace assay::tests {
namespace {

using namespace detector;

std::vector<FourPoints> candidates_of(const std::string& step, benchmark::State& state) {
  std::vector<FourPoints> queries;
  const auto* parts = StepParts::of(step, state);
  if (!parts) return queries;
  for (const auto kind : {FeatureKind::vertex_face, FeatureKind::edge_edge}) {
    for (const auto& q : parts->queries(kind)) {
      FourPoints points{{}, kind == FeatureKind::vertex_face ? 1 : 2};
      for (std::size_t i = 0; i < 4; ++i) points.points[i] = parts->motion().path(q.v[i]);
      queries.push_back(points);
    }
  }
  return queries;
}

// Queries of the public data: of a simulation, nearly all of them hits.
std::vector<FourPoints> simulation_queries(benchmark::State& state) {
  std::vector<FourPoints> queries;
  for (const char* name : {"3036ee", "3036vf"}) {
    const auto read =
        corpus::read_queries(settings().data + "/scalable-ccd/rod-twist/queries/" + name + ".csv");
    if (!read) continue;
    for (const auto& query : read.value()) queries.push_back(query.query);
  }
  if (queries.empty()) state.SkipWithError("no public data (ASSAY_DATA)");
  return queries;
}

std::vector<FourPoints> extreme_queries(benchmark::State&) {
  std::vector<FourPoints> queries;
  for (int i = 0; i < sized(20'000); ++i)
    queries.push_back(properties::extreme_contact(1, static_cast<std::uint64_t>(i)).query);
  return queries;
}

using Queries = std::vector<FourPoints> (*)(benchmark::State&);
constexpr std::pair<const char*, Queries> query_sets[] = {
    {"rod-twist", [](auto& state) { return candidates_of("rod-twist", state); }},
    {"crumpling-sphere", [](auto& state) { return candidates_of("crumpling-sphere", state); }},
    {"simulation", simulation_queries},
    {"extreme", extreme_queries}};

void ask(benchmark::State& state, Queries make, Want want, Arithmetic arithmetic) {
  auto queries = make(state);
  if (want == Want::first_time) {
    std::erase_if(queries, [](const auto& q) { return !test_contact(q, Want::yes_no).contact; });
  }
  for (auto _ : state) {
    for (const auto& q : queries) benchmark::DoNotOptimize(test_contact(q, want, arithmetic));
  }
  show_each(state, queries.size());
}

void ask_oracle(benchmark::State& state, Queries make) {
  const auto queries = make(state);
  for (auto _ : state) {
    for (const auto& q : queries) benchmark::DoNotOptimize(oracle::contact_of(q, Want::yes_no));
  }
  show_each(state, queries.size());
}

// First in lanes, and alone where these leave a query open, as a step asks.
void ask_in_lanes(benchmark::State& state, const char* step) {
  const auto* parts = StepParts::of(step, state);
  if (!parts) return;
  const QueryInput input = query_input(parts->motion());
  std::size_t count = 0, left_open = 0;
  for (const auto kind : {FeatureKind::vertex_face, FeatureKind::edge_edge}) {
    count += parts->queries(kind).size();
  }
  const std::vector<QueryVertices> queries[] = {parts->queries(FeatureKind::vertex_face),
                                                parts->queries(FeatureKind::edge_edge)};
  const QueryKernel kernels[] = {query_kernels().vertex_face, query_kernels().edge_edge};
  const auto points = candidates_of(step, state);
  std::vector<LaneRung> rungs(count);
  for (auto _ : state) {
    left_open = 0;
    std::size_t first = 0;
    for (const std::size_t kind : {0u, 1u}) {
      kernels[kind](input, queries[kind].data(), queries[kind].size(), rungs.data());
      for (std::size_t i = 0; i < queries[kind].size(); ++i) {
        if (rungs[i] != LaneRung::open) continue;
        ++left_open;
        benchmark::DoNotOptimize(test_contact_past_axis(points[first + i], Want::yes_no));
      }
      first += queries[kind].size();
    }
  }
  show_each(state, count);
  state.counters["left_open"] = static_cast<double>(left_open);
}

// The slowest of the family that is kept for this, in ms.
template <class Time>
void show_tail(benchmark::State& state, Time time) {
  std::vector<double> ms;
  for (auto _ : state) {
    ms.clear();
    for (int i = 0; i < sized(250'000); ++i)
      ms.push_back(1e-6 * time(static_cast<std::uint64_t>(i)));
  }
  state.counters["p99.9_ms"] = reports::quantile(ms, 0.999);
  state.counters["slowest_ms"] = reports::quantile(ms, 1);
  state.counters["slowest_index"] =
      static_cast<double>(std::max_element(ms.begin(), ms.end()) - ms.begin());
}

double contact_ns(std::uint64_t index) {
  const auto query = properties::extreme_contact(1, index).query;
  return reports::ns_of([&] { benchmark::DoNotOptimize(test_contact(query, Want::first_time)); });
}

// Seen from a point for even indices, from a line for odd ones.
double view_ns(std::uint64_t index) {
  properties::Random random(~std::uint64_t{1}, index);
  std::array<MovingPoint, 5> x;
  properties::make_extreme(random, x);
  const MovingTriangle triangle{x[0], x[1], x[2]};
  const ViewPrimitive primitive{x[3], x[index % 2 == 0 ? 3 : 4]};
  ViewCounts counts;
  return reports::ns_of([&] { benchmark::DoNotOptimize(view_sign(triangle, primitive, counts)); });
}

const bool are_added = [] {
  for (const auto& [name, make] : query_sets) {
    for (const auto arithmetic : all_values<Arithmetic>) {
      const auto of = std::string(name) + "/" + name_of(arithmetic);
      add("elementary/yes_no/" + of, ask, make, Want::yes_no, arithmetic);
      add("elementary/hit_with_its_time/" + of, ask, make, Want::first_time, arithmetic);
    }
    add(std::string("oracle/yes_no/") + name, ask_oracle, make);
  }
  for (const auto* step : {"rod-twist", "crumpling-sphere"})
    add(std::string("elementary/in_lanes/") + step, ask_in_lanes, step);
  add("elementary/slowest/contact", [](auto& state) {
    show_tail(state, contact_ns);
  })->Iterations(1);
  add("elementary/slowest/view", [](auto& state) { show_tail(state, view_ns); })->Iterations(1);
  return true;
}();

}  // namespace
}  // namespace assay::tests
