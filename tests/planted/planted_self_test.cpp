// Runs the self-test up to its first contradiction, in one thread so that the count is always the
// same. The program is linked with the oracle as it is, or with an oracle in which one line is
// wrong (*.fault). Its argument is the beginning of the names of the families to run. The exit code
// is that of `assay self-test`: 0, or 4 on a contradiction.
#include <fmt/format.h>

#include "properties/queries/self_check.h"
#include "reports/terminal/work.h"

int main(int argc, char** argv) {
  using namespace assay;
  const properties::SelfTestOptions options;
  properties::QueryTally tally;
  const auto families = properties::self_test_families(ASSAY_SOURCE_DIR "/corpus").value();
  for (const auto& family : families) {
    if (argc > 1 && !family.name.starts_with(argv[1])) continue;
    for (std::uint64_t index = 0; index < family.indices(options.queries); ++index) {
      const auto wrong = family.check(options.seed, index, tally);
      if (!wrong) continue;
      fmt::print("contradiction after {} queries, {}:{}:{}\n{}\n", tally.queries, family.name,
                 options.seed, index, *wrong);
      return reports::exit_unsound;
    }
  }
  fmt::print("no contradiction in {} queries\n", tally.queries);
  return reports::exit_holds;
}
