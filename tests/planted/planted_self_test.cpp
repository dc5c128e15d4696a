// The self-test up to its first contradiction, in one thread so that the count is always the same.
// Linked with the oracle as it is, and with an oracle in which one line is wrong (*.fault).
// An argument is how the names of the families to run begin. Exit code as of `assay self-test`: 0,
// or 4 on a contradiction.
#include <cstdio>

#include "properties/queries/self_check.h"
#include "reports/terminal/work.h"

int main(int argc, char** argv) {
  using namespace assay;
  properties::SelfTestOptions options;
  options.stop_at_contradiction = true;
  std::uint64_t queries = 0;
  for (const auto& family : properties::self_test_families()) {
    if (argc > 1 && !family->name().starts_with(argv[1])) continue;
    const auto result = properties::run_family(*family, options, {});
    queries += result.tally.queries;
    if (result.failures.empty()) continue;
    const auto& failure = result.failures.front();
    std::printf("contradiction after %llu queries, %s:%llu:%llu\n%s\n",
                static_cast<unsigned long long>(queries), family->name().c_str(),
                static_cast<unsigned long long>(options.seed),
                static_cast<unsigned long long>(failure.index), failure.contradiction.c_str());
    return reports::exit_unsound;
  }
  std::printf("no contradiction in %llu queries\n", static_cast<unsigned long long>(queries));
  return reports::exit_holds;
}
