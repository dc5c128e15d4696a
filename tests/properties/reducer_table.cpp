// The table of what the reducer reaches on toy faults: `reducer_table [SEED [NAME]]`.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "properties/reducer/mesh_size.h"
#include "tests/properties/toy_faults.h"

using namespace assay::properties;

int main(int argc, char** argv) {
  const std::uint64_t seed = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const std::string only = argc > 2 ? argv[2] : "";
  for (const auto& fault : toys::toy_faults()) {
    if (!only.empty() && fault.name != only) continue;
    try {
      const auto start = toys::large_failing_case(fault, 200, 8, seed);
      const auto reduction = reduce(start, fault.judge, {});
      const auto size = size_of(reduction.smallest);
      std::printf(
          "%-30s %-34s -> %3zu vertices %3zu triangles %zu steps  wanted %2zu %s  numbers %5llu  "
          "%6llu calls %6.2f s%s\n",
          fault.name.c_str(), size_text(size_of(start)).c_str(), size.vertices, size.triangles,
          size.steps, fault.vertices, size.vertices <= fault.vertices + 1 ? "ok " : "BAD",
          static_cast<unsigned long long>(size.numbers),
          static_cast<unsigned long long>(reduction.calls), reduction.seconds,
          reduction.fixed_point ? "" : " (limit)");
      if (!only.empty()) {
        for (const auto& p : reduction.passes)
          std::printf("    %-24s %7llu %5llu %6.2f\n", p.name.c_str(), (unsigned long long)p.tried,
                      (unsigned long long)p.accepted, p.seconds);
        std::printf("%s\n", assay::corpus::case_text(reduction.smallest).c_str());
      }
    } catch (const std::exception& e) {
      std::printf("%-30s %s\n", fault.name.c_str(), e.what());
    }
    std::fflush(stdout);
  }
}
