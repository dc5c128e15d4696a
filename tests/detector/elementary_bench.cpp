// Times of the elementary test by kind of query; built with the tests, run by hand:
//   build/release/elementary_bench
#include <benchmark/benchmark.h>

#include <random>

#include "detector/contact/elementary_test.h"

namespace assay::detector {
namespace {

// A vertex above a triangle of unit size that moves by `drop`: 0.5 stays above, 2 passes through.
std::vector<FourPoints> queries(double drop, double jitter) {
  std::mt19937_64 engine(20111);
  std::uniform_real_distribution<double> noise(-jitter, jitter);
  std::vector<FourPoints> out;
  for (int i = 0; i < 1024; ++i) {
    const auto still = [&](double x, double y) {
      const Point p = {x + noise(engine), y + noise(engine), noise(engine)};
      return MovingPoint{p, p};
    };
    const Point above = {.3 + noise(engine), .3 + noise(engine), 1};
    out.push_back(four_points(VertexFace{{above, {above[0], above[1], 1 - drop}},
                                         {still(0, 0), still(1, 0), still(0, 1)}}));
  }
  return out;
}

void run(benchmark::State& state, const std::vector<FourPoints>& all, Want want) {
  std::size_t i = 0, contacts = 0;
  for (auto _ : state) contacts += test_contact(all[i++ % all.size()], want).contact ? 1 : 0;
  benchmark::DoNotOptimize(contacts);
}

template <Arithmetic arithmetic>
void run_in(benchmark::State& state, const std::vector<FourPoints>& all, Want want) {
  std::size_t i = 0, contacts = 0;
  for (auto _ : state) {
    contacts += test_contact(all[i++ % all.size()], want, arithmetic).contact ? 1 : 0;
  }
  benchmark::DoNotOptimize(contacts);
}

void register_arithmetics() {
  using Run = void (*)(benchmark::State&, const std::vector<FourPoints>&, Want);
  const std::pair<const char*, Run> arithmetics[] = {
      {"exact", run_in<Arithmetic::exact>},
      {"bounded", run_in<Arithmetic::bounded>},
      {"double", run_in<Arithmetic::double_precision>},
      {"float", run_in<Arithmetic::single_precision>}};
  for (const auto& [name, run_one] : arithmetics) {
    const auto add = [&, run = run_one](const std::string& kind, double drop, double jitter,
                                        Want want) {
      benchmark::RegisterBenchmark(
          (kind + "/" + name).c_str(),
          [run, want, all = queries(drop, jitter)](auto& state) { run(state, all, want); });
    };
    add("passes_beside_or_through", 2, .4, Want::yes_no);
    add("passes_through", 2, .1, Want::yes_no);
    add("passes_through_with_time", 2, .1, Want::first_time);
    add("touches_at_the_end", 1, 0, Want::yes_no);
  }
}

BENCHMARK_CAPTURE(run, separated_by_axis, queries(.5, .1), Want::yes_no);
BENCHMARK_CAPTURE(run, passes_through, queries(2, .1), Want::yes_no);
BENCHMARK_CAPTURE(run, passes_through_with_time, queries(2, .1), Want::first_time);
BENCHMARK_CAPTURE(run, touches_at_the_end, queries(1, 0), Want::yes_no);

}  // namespace
}  // namespace assay::detector

int main(int argc, char** argv) {
  assay::detector::register_arithmetics();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
