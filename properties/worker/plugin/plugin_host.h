// Loads a plug-in, runs cases through it, and reads its results.
#pragma once

#include <filesystem>
#include <vector>

#include "detector/plugin/assay_detector.h"
#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// The library's code, its constructors included, runs in this process; so only the worker may use
// this class.
class PluginHost {
 public:
  // Loads a library, which is never unloaded again. `threads` is for a library that asks how many
  // it may use. `name` is the user's name for the library in problems; empty: its file. Refuses a
  // path that is no file or no shared library, a library without assay_detector(), another version
  // of the interface, a table with a gap, and a description that makes no sense.
  static Expected<PluginHost> open(const std::filesystem::path& library, std::uint32_t threads = 1,
                                   const std::string& name = {});

  const PluginDescription& description() const { return description_; }

  // Sets whether run() evaluates each step twice. The second result then counts.
  void ask_twice(bool asks_twice) { asks_twice_ = asks_twice; }

  // Runs a case as run_case does. If a result breaks the header's rules (an index out of range, an
  // invalid interval), its step is an error, which `explanation` states. Coordinates are rounded as
  // the contract says. The caller must leave out the steps that the contract leaves out. If the
  // case is a query (query_case.h), the plug-in's query is asked, with unrounded coordinates.
  CaseRun run(const Case& c, bool is_timed = false) const;

 private:
  CaseRun ask(const Case& c, int first_group, bool is_timed) const;

  PluginHost(const assay_detector_api& table, PluginDescription description)
      : table_(table), description_(std::move(description)) {}

  assay_detector_api table_;  // in the form of this host's version
  PluginDescription description_;
  bool asks_twice_ = false;
};

// Reads the output of a plug-in without trust: its table of functions, in any version that this
// host takes; its description; and its results.

// Returns the text as one printable line, no longer than a reply may hold; empty for null.
std::string line_of(const char* text);

// Returns the plug-in's text about the call that failed last, in one line; empty if it gives none.
std::string text_of_error(const assay_detector_api& table);
// Returns the problem for ASSAY_BEYOND_CAPACITY, with the plug-in's own line if it gives one.
Problem refused_by_capacity(const std::string& text);

// Returns "evaluate returned 3: TEXT".
std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code);

// Returns the table in this host's version; functions that an older version does not have are NULL.
// Refuses NULL, another version of the interface, and a table with a gap; the problem does not name
// the library.
Expected<assay_detector_api> read_table(const assay_detector_api* api);

// Returns the plug-in's description. Refuses one that makes no sense; the problem does not name the
// library.
Expected<PluginDescription> read_description(const assay_detector_api& table);
// Returns the description of a detector with these parts. Refuses one that makes no sense.
Expected<PluginDescription> described(const assay_description& raw, const PluginParts& parts);

// Returns the result of a step. Its pairs are a < b, ascending, each once with its least time ([0,
// 1] if none is stated). Fails if the result breaks the header's rules, and, with the plug-in's own
// words, if it says that the step has no answer. If `reports_pairs` is false
// (PairReporting::no_pairs), pairs break the rules.
Expected<StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                 bool reports_pairs = true);

// Returns the answer of a limiter with these claims: its share, or -1, and the positions at which
// the caller stops. If it gives none, they are computed as Contract::limit_gives says. `way` is the
// displacement from x_t0 to x_t1. Fails if the share is no valid one, if there are neither
// positions nor a share to compute them from, if positions are not finite, and if a claim needs a
// share that is not stated.
Expected<LimitAnswer> limit_answer(const assay_limit& raw, const Claims& claims,
                                   const Contract& contract, const Positions& x_t0,
                                   const Positions& x_t1, const Positions& way);

// Returns the candidate pairs a < b, ascending, each once. Fails if an index is out of range.
Expected<std::vector<TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                    std::int32_t triangle_count);

}  // namespace assay::properties
