// Suite `elementary` compares the answers of the elementary test with labels, and measures its
// times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "detector/contact/elementary.h"
#include "detector/contact/lanes/query_lanes.h"
#include "detector/view/view_signs.h"
#include "properties/queries/extreme_queries.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/query_sets.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

std::string rungs_of(const std::vector<FourPoints>& queries) {
  ContactRungCounts rungs;
  for (const auto& q : queries) rungs.add(test_contact(q, Want::yes_no).rung);
  return fmt::format("decided by axis {}, filter {}, fixed {}, unbounded {}", rungs.axis,
                     rungs.filter, rungs.fixed, rungs.unbounded);
}

// The mean time of a query in each arithmetic, in microseconds, measured in turn. Only exact
// arithmetic is held against the bound.
void time_means(const std::string& label, const std::vector<FourPoints>& queries, Want want,
                Wanted bound, int rounds, const std::string& note, BenchReport& report) {
  std::vector<Measurement> measurements;
  for (const auto arithmetic : all_values<Arithmetic>) {
    measurements.push_back([&queries, want, arithmetic] {
      return ns_of([&] {
        for (const auto& q : queries) keep(test_contact(q, want, arithmetic));
      });
    });
  }
  const auto samples = interleave(rounds, measurements);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool exact = all_values<Arithmetic>[i] == Arithmetic::exact;
    report.add(fmt::format("{}, {}", label, name_of(all_values<Arithmetic>[i])), "us",
               scaled(median_of(samples[i]), 1e-3 / static_cast<double>(queries.size())),
               wanted_if(exact, bound), exact ? note + "; " + rungs_of(queries) : "");
  }
}

// Compares answers with labels. Exact arithmetic claims that no answer is wrong, bounded
// arithmetic that it misses nothing.
void score(const std::string& label, const LabelledSet& set, BenchReport& report) {
  for (const auto arithmetic : all_values<Arithmetic>) {
    std::size_t alarms = 0, misses = 0;
    for (std::size_t i = 0; i < set.queries.size(); ++i) {
      const bool contact = test_contact(set.queries[i], Want::yes_no, arithmetic).contact;
      alarms += contact && !set.truths[i];
      misses += !contact && set.truths[i];
    }
    const bool exact = arithmetic == Arithmetic::exact, bounded = arithmetic == Arithmetic::bounded;
    report.add(fmt::format("wrong answers, {}, {}", label, name_of(arithmetic)), "",
               exactly(static_cast<double>(alarms + misses)), wanted_if(exact, at_most(0)),
               fmt::format("{} false alarms, {} misses of {} queries", alarms, misses,
                           set.queries.size()));
    if ((exact && alarms > 0) || ((exact || bounded) && misses > 0)) {
      report.wrong_answers.push_back(
          fmt::format("{} against the labels of {}: {} false alarms, {} misses",
                      name_of(arithmetic), label, alarms, misses));
    }
  }
}

std::vector<FourPoints> hits_of(const std::vector<FourPoints>& queries) {
  std::vector<FourPoints> hits;
  for (const auto& q : queries) {
    if (test_contact(q, Want::yes_no).contact) hits.push_back(q);
  }
  return hits;
}

void time_hits(const std::string& label, const std::vector<FourPoints>& queries, int rounds,
               BenchReport& report) {
  const auto hits = hits_of(queries);
  if (hits.empty()) return;
  std::size_t wide = 0;
  for (const auto& q : hits) {
    const TimeEnclosure time = test_contact(q, Want::first_time).time;
    wide += time.lo != time.hi && std::nextafter(time.lo, 2) != time.hi;
  }
  if (wide > 0) {
    report.wrong_answers.push_back(
        fmt::format("{}: {} times are wider than adjacent doubles", label, wide));
  }
  time_means("a hit with its time, " + label, hits, Want::first_time, wanted::hit_with_its_time_us,
             rounds, fmt::format("{} hits", hits.size()), report);
}

// The milliseconds that one query takes. If it is short, it is measured three times and the least
// counts. This is processor time, whose clock takes 0.2 us to read, so it is of use from some
// microseconds on.
double ms_of_one(const FourPoints& query, Arithmetic arithmetic) {
  constexpr int repetitions = 3;
  constexpr double long_enough_ns = 1e6;  // a longer query is measured well enough by one run
  double least = 1e300;
  for (int i = 0; i < repetitions && (i == 0 || least < long_enough_ns); ++i) {
    const double begin = processor_ns();
    keep(test_contact(query, Want::yes_no, arithmetic));
    least = std::min(least, processor_ns() - begin);
  }
  return 1e-6 * least;
}

void time_tails(const std::string& label, const std::vector<FourPoints>& queries, Wanted bound,
                BenchReport& report) {
  for (const auto arithmetic : all_values<Arithmetic>) {
    std::vector<double> ms;
    double sum = 0;
    for (const auto& q : queries) {
      ms.push_back(ms_of_one(q, arithmetic));
      sum += ms.back();
    }
    const bool exact = arithmetic == Arithmetic::exact;
    report.add(
        fmt::format("p99.9 of one query, {}, {}", label, name_of(arithmetic)), "ms",
        exactly(quantile(ms, 0.999)), wanted_if(exact, bound),
        fmt::format("p99 {:.3g}, max {:.3g}, mean {:.3g} of {} queries{}", quantile(ms, 0.99),
                    quantile(ms, 1), sum / static_cast<double>(ms.size()), ms.size(),
                    exact ? "; " + rungs_of(queries) : ""));
  }
}

void labelled(const std::string& label, const std::optional<LabelledSet>& set, Wanted bound,
              int rounds, const std::string& path, BenchReport& report) {
  if (!set) {
    report.add_no_data(label, path);
    return;
  }
  score(label, *set, report);
  std::size_t hits = 0;
  for (const bool truth : set->truths) hits += truth;
  time_means("yes/no, " + label, set->queries, Want::yes_no, bound, rounds,
             fmt::format("{} queries, {} hits", set->queries.size(), hits), report);
  time_hits(label, set->queries, rounds, report);
}

// The time of a query as a step asks it: first in lanes, and alone where these leave it open.
void time_in_lanes(const std::string& label, const std::vector<FourPoints>& queries, int rounds,
                   BenchReport& report) {
  const auto count = static_cast<Eigen::Index>(4 * queries.size());
  Positions x_t0(count, 3), x_t1(count, 3);
  std::vector<QueryVertices> vertices[2];  // of vertex and face, of two edges
  std::vector<const FourPoints*> asked[2];
  Eigen::Index next = 0;
  for (const auto& q : queries) {
    const auto v = static_cast<std::int32_t>(next);
    for (const auto& p : q.points) {
      x_t0.row(next) << p.t0[0], p.t0[1], p.t0[2];
      x_t1.row(next++) << p.t1[0], p.t1[1], p.t1[2];
    }
    const std::size_t kind = q.first_group == 1 ? 0 : 1;
    vertices[kind].push_back({{v, v + 1, v + 2, v + 3, -1}});
    asked[kind].push_back(&q);
  }
  const QueryInput input = query_input({x_t0, x_t1});
  const QueryKernels& kernels = query_kernels();
  std::vector<LaneRung> rungs(queries.size());
  std::size_t left_open = 0, contacts = 0;
  const auto answer_all = [&] {
    left_open = contacts = 0;
    for (const std::size_t kind : {0u, 1u}) {
      const auto kernel = kind == 0 ? kernels.vertex_face : kernels.edge_edge;
      kernel(input, vertices[kind].data(), vertices[kind].size(), rungs.data());
      for (std::size_t i = 0; i < asked[kind].size(); ++i) {
        if (rungs[i] != LaneRung::open) continue;
        ++left_open;
        contacts += test_contact_past_axis(*asked[kind][i], Want::yes_no).contact;
      }
    }
  };
  const auto samples = interleave(rounds, {[&] { return ns_of(answer_all); }});
  report.add(fmt::format("yes/no in lanes, {}", label), "us",
             scaled(median_of(samples[0]), 1e-3 / static_cast<double>(queries.size())),
             wanted::yes_no_of_a_candidate_in_lanes_us,
             fmt::format("{} of {} left open by the lanes", left_open, queries.size()));
  if (contacts != hits_of(queries).size())
    report.wrong_answers.push_back(label + ": lanes change the number of contacts");
}

void rod_twist_candidates(const BenchSettings& settings, int rounds, BenchReport& report) {
  const std::string label = "candidates of rod-twist";
  const auto step = rod_twist_step(settings);
  if (!step) {
    report.add_no_data("yes/no, " + label, settings.file("scalable-ccd/rod-twist/frames/"));
    return;
  }
  constexpr double most = 100'000;
  const auto candidates = mesh_candidates(*step, static_cast<std::size_t>(most * settings.scale));
  time_means("yes/no, " + label, candidates.queries, Want::yes_no, wanted::yes_no_of_a_candidate_us,
             rounds,
             fmt::format("{} of {} feature pairs whose moving boxes meet",
                         candidates.queries.size(), candidates.all),
             report);
  time_in_lanes(label, candidates.queries, rounds, report);
  time_in_lanes(label, candidates.queries, rounds, report);
  time_hits(label, candidates.queries, rounds, report);
}

constexpr std::uint64_t seed = 1;
constexpr double queries_of_a_kind = 250'000;

// `time` takes the index of a query, answers the query and says how many ns that took. Slow
// queries are measured three times, and the least counts.
template <class Time>
void add_tail(const char* kind, std::uint64_t first, Time time, const BenchSettings& settings,
              BenchReport& report) {
  const auto count = static_cast<std::uint64_t>(queries_of_a_kind * settings.scale);
  constexpr double slow_ns = 1e6;
  constexpr int repetitions = 3;
  std::vector<double> ms;
  double sum = 0;
  std::uint64_t slowest = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t index = first + 2 * i;
    double ns = time(index);
    for (int again = 1; again < repetitions && ns > slow_ns; ++again) {
      ns = std::min(ns, time(index));
    }
    ms.push_back(1e-6 * ns);
    sum += ms.back();
    if (ms.back() > ms[slowest]) slowest = i;
  }
  const std::string of = fmt::format("p99 {:.3g}, mean {:.3g} ms of {} queries", quantile(ms, 0.99),
                                     sum / static_cast<double>(count), count);
  report.add(fmt::format("p99.9 of one query, kept family, {}", kind), "ms",
             exactly(quantile(ms, 0.999)), wanted::slow_query_of_any_numbers_ms, of);
  report.add(fmt::format("slowest query, kept family, {}", kind), "ms", exactly(ms[slowest]),
             wanted::slowest_query_of_any_numbers_ms,
             fmt::format("seed {}, index {}", seed, first + 2 * slowest));
}

double contact_ns(std::uint64_t index) {
  const auto query = properties::extreme_contact(seed, index);
  return ns_of([&] { keep(test_contact(query, detector::Want::first_time)); });
}

double view_ns(std::uint64_t index) {
  const auto query = properties::extreme_view(seed, index);
  detector::ViewCounts counts;
  return ns_of([&] { keep(view_sign(query.triangle, query.primitive, counts)); });
}

// Times the slowest single queries in exact arithmetic, from the family that is kept for this
// (properties/queries/extreme_queries.h): 250,000 vertex-face and edge-edge queries each with their
// times, and as many views from a point and from a line. Two minutes of processor time at scale 1.
void time_slow_queries(const BenchSettings& settings, BenchReport& report) {
  add_tail("vertex-face", 0, contact_ns, settings, report);
  add_tail("edge-edge", 1, contact_ns, settings, report);
  add_tail("view from a point", 0, view_ns, settings, report);
  add_tail("view from a line", 1, view_ns, settings, report);
}

}  // namespace

BenchReport elementary_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("elementary");
  const int rounds = settings.rounds(15);
  progress.phase("candidates of a mesh");
  rod_twist_candidates(settings, rounds, report);
  progress.phase("labelled queries");
  labelled("simulation queries", simulation_queries(settings),
           wanted::yes_no_of_a_simulation_query_us, rounds, settings.file("scalable-ccd/rod-twist"),
           report);
  labelled("hand-made queries", hand_made_queries(settings), wanted::yes_no_of_a_hand_made_query_us,
           rounds, settings.file("sample-queries"), report);
  progress.phase("random exponents");
  const auto query_count = static_cast<std::size_t>(20'000 * settings.scale);
  time_tails("exponents within 2^+-100", random_exponents(query_count, -100, 100),
             wanted::slow_query_of_usual_numbers_ms, report);
  time_tails("exponents over all doubles", random_exponents(query_count, -1074, 1022),
             wanted::slow_query_of_any_numbers_ms, report);
  progress.phase("slowest queries");
  time_slow_queries(settings, report);
  return report;
}

}  // namespace assay::reports
