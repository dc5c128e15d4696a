// What the answers of a product come to. The rules are those of corpus/vectors/README.md, and
// corpus/vectors/vectors.py counts the same.
#pragma once

#include "properties/vectors/results_file.h"

namespace assay::reports {

// What a case comes to is the first of these that one of its steps comes to.
enum class CaseOutcome : std::uint8_t {
  miss,   // free, and there is a contact; a share that is not safe
  late,   // the first time is after the contact
  alarm,  // a contact that there is not
  crash,
  timeout,
  error,
  undecided,
  unsupported,
  right,
};
inline constexpr const char* outcome_words[] = {
    "miss", "late", "alarm", "crash", "timeout", "error", "undecided", "unsupported", "right"};

struct JudgedCase {
  const properties::Vector* asked = nullptr;
  std::size_t group = 0;  // of the set
  CaseOutcome outcome = CaseOutcome::right;
  std::size_t step = 0;             // the first one that comes to this
  properties::VectorAnswer answer;  // to that step
};

struct JudgedResults {
  std::string name, version, settings;  // of the product
  std::vector<JudgedCase> cases;        // those that were asked, in the order of the set
  // Steps whose features only touch: how many were called contact (closed sets), and how many free.
  int closed = 0, open = 0;
  int early = 0;  // times before the contact
  int missing_pairs = 0, spurious_pairs = 0;
  bool gave_pairs = false;
  std::vector<double> uses;  // of the way that could be gone, the share that a limiter let go

  std::vector<const JudgedCase*> with(CaseOutcome outcome) const;
  // Of the cases that were asked and are supported, and of those with this outcome among them.
  int count(CaseOutcome outcome) const { return static_cast<int>(with(outcome).size()); }
  int supported() const { return static_cast<int>(cases.size()) - count(CaseOutcome::unsupported); }
  // "NAME VERSION, SETTINGS"
  std::string title() const;
};

// The set has to outlive what is returned.
JudgedResults judge_results(const properties::VectorResults& results,
                            const properties::VectorSet& set);

// 0: all is right; 1: a miss, a late time or an alarm; 3: none of these, but a case has no answer.
int exit_code_of(const std::vector<JudgedResults>& all);

}  // namespace assay::reports
