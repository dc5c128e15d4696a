// A detector by the header in C++ in which one call fails in every step and says why. The
// environment variable ASSAY_SAYS_WHY names the call. evaluate counts its steps.
#include <cstdlib>
#include <cstring>

#include "detector/plugin/assay_detector.hpp"
using namespace assay::plugin;

namespace {

void fail_in(const char* call, int number = 0) {
  const char* named = std::getenv("ASSAY_SAYS_WHY");
  if (named && std::strcmp(named, call) == 0)
    throw std::runtime_error("no " + std::string(call) + " today, " + std::to_string(number));
}

}  // namespace

struct SaysWhy {
  static Description describe() {
    fail_in("describe");
    Description d;
    d.name = "says why";
    d.claims = ASSAY_CLAIM_TOTAL | ASSAY_CLAIM_CANDIDATES;
    return d;
  }
  explicit SaysWhy(const Mesh&) { fail_in("create"); }
  Result evaluate(Positions, Positions) {
    fail_in("evaluate", ++steps);
    return Result::undecided();
  }
  void commit() {}
  std::vector<Pair> candidates(Positions, Positions) {
    fail_in("candidates", ++asked);
    return {};
  }
  static Result query(std::int32_t, Positions, Positions) {
    const char* named = std::getenv("ASSAY_SAYS_WHY");
    if (named && std::strcmp(named, "query-error") == 0) return Result::error("said by its result");
    fail_in("query");
    return Result::undecided();
  }
  int steps = 0, asked = 0;
};

// commit() is asked for answers alone, so this one gives some.
struct SaysWhyOfCommit : SaysWhy {
  using SaysWhy::SaysWhy;
  Result evaluate(Positions, Positions) { return Result::collision(); }
  void commit() { fail_in("commit", ++commits); }
  int commits = 0;
};

#ifdef OF_COMMIT
ASSAY_EXPORT_DETECTOR(SaysWhyOfCommit);
#else
ASSAY_EXPORT_DETECTOR(SaysWhy);
#endif
