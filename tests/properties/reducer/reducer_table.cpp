// Prints a table of the sizes that the reducer reaches: `reducer_table toys|faults [SEED [NAME]]`.
// NAME can be the beginning of several names; a whole name prints the passes and the case, too.
//
// toys: faults of toy detectors over the oracle, on random large meshes. faults: planted faults of
// the detector, on their curated cases, inflated to 200 triangles and 8 steps.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "properties/campaign/phases/phases.h"
#include "properties/reducer/reducer.h"
#include "tests/curated_cases.h"
#include "tests/properties/reducer/toy_faults.h"

namespace {

using namespace assay;
using namespace assay::properties;

constexpr int large = 200, many_steps = 8;

struct Totals {
  std::vector<double> seconds;
  std::size_t reached = 0;
};

void print_row(const std::string& name, const corpus::Case& start, const Judge& judge,
               std::size_t wanted, bool in_full, Totals& totals) {
  const auto reduction = reduce(start, judge, {});
  const auto size = size_of(reduction.smallest);
  const bool reached = size.vertices <= wanted + 1;
  totals.seconds.push_back(reduction.seconds);
  totals.reached += reached ? 1 : 0;
  std::printf(
      "%-34s %-34s -> %2zu vertices, %2zu triangles, %zu steps; wanted %2zu %s; numbers %4llu; "
      "%6llu calls %6.2f s%s\n",
      name.c_str(), size_text(start).c_str(), size.vertices, size.triangles, size.steps, wanted,
      reached ? "   " : "NOT", static_cast<unsigned long long>(size.numbers),
      static_cast<unsigned long long>(reduction.calls), reduction.seconds,
      reduction.fixed_point ? "" : " (limit)");
  if (in_full) {
    for (const auto& pass : reduction.passes)
      std::printf("    %-22s %7llu tried %5llu accepted %6.2f s\n", pass.name.c_str(),
                  static_cast<unsigned long long>(pass.tries),
                  static_cast<unsigned long long>(pass.accepted), pass.seconds);
    std::printf("%s\n", corpus::case_text(reduction.smallest).c_str());
  }
}

// It asks the oracle by itself.
Judge judge_of_fault(const Fault& fault) {
  return [&fault](const corpus::Case& c) -> std::optional<Finding> {
    CaseResults examined{c};
    const auto failure = failure_of_fault(fault, examined);
    return failure ? std::optional(finding_of(*failure)) : std::nullopt;
  };
}

corpus::Case inflated_curated_case(const Fault& fault, const Judge& judge, std::uint64_t seed) {
  return toys::inflated_case(tests::curated_case(std::string(fault.curated)), judge, large,
                             many_steps, seed);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string table = argc > 1 ? argv[1] : "";
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const std::string only = argc > 3 ? argv[3] : "";
  if (table != "toys" && table != "faults") {
    std::fprintf(stderr, "usage: reducer_table toys|faults [SEED [NAME]]\n");
    return 2;
  }
  Totals totals;
  const auto row = [&](const std::string& name, std::size_t wanted, const Judge& judge,
                       const auto& make_case) {
    if (!name.starts_with(only)) return;
    try {
      print_row(name, make_case(), judge, wanted, name == only, totals);
    } catch (const std::exception& problem) {
      std::printf("%-34s %s\n", name.c_str(), problem.what());
    }
    std::fflush(stdout);
  };
  if (table == "toys") {
    for (const auto& fault : toys::toy_faults())
      row(fault.name, fault.vertices, fault.judge,
          [&] { return toys::large_failing_case(fault, large, many_steps, seed); });
  } else {
    for (const Fault& fault : faults()) {
      if (fault.status != FaultStatus::planted || fault.curated.empty()) continue;
      const Judge judge = judge_of_fault(fault);
      row(std::string(fault.name), static_cast<std::size_t>(fault.smallest_vertices), judge,
          [&] { return inflated_curated_case(fault, judge, seed); });
    }
  }
  if (totals.seconds.empty()) return 2;
  std::sort(totals.seconds.begin(), totals.seconds.end());
  std::printf("%zu of %zu within one vertex; median %.2f s, longest %.2f s\n", totals.reached,
              totals.seconds.size(), totals.seconds[totals.seconds.size() / 2],
              totals.seconds.back());
}
