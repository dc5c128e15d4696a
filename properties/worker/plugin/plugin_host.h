// Loads a plug-in, runs cases through it, and reads its results.
#pragma once

#include <filesystem>
#include <vector>

#include "detector/plugin/assay_detector.h"
#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// Loads a library whose code, including its constructors, runs in this process. So only the worker
// may use this class.
class PluginHost {
 public:
  // Loads a library, which is never unloaded. `threads` is the greatest number of threads, for a
  // library with a function that limits its threads. `name` is the user's name for the library in
  // problems; empty: its path. Fails if the path is no file or no shared library, if the library
  // has no assay_detector() or another version of the interface, if a function is missing in its
  // table, or if its description is invalid.
  static Expected<PluginHost> open(const std::filesystem::path& library, std::uint32_t threads = 1,
                                   const std::string& name = {});

  const PluginDescription& description() const { return description_; }

  // Sets whether run() evaluates each step twice and uses the second result.
  void ask_twice(bool asks_twice) { asks_twice_ = asks_twice; }

  // Runs a case like run_case. If a result breaks the rules of the plug-in interface (an index
  // out of range, an invalid interval), the answer is an error, which CaseRun::explanation states.
  // Coordinates are rounded as the contract says. The caller must leave out the steps that the
  // contract leaves out. If the case is a query (query_case.h), the plug-in's function for queries
  // is called, with unrounded coordinates.
  CaseRun run(const Case& c, bool is_timed = false) const;

 private:
  CaseRun ask(const Case& c, int first_group, bool is_timed) const;

  PluginHost(const assay_detector_api& table, PluginDescription description)
      : table_(table), description_(std::move(description)) {}

  assay_detector_api table_;  // in the form of this host's version
  PluginDescription description_;
  bool asks_twice_ = false;
};

// The functions below read the output of a plug-in without trust: its table of functions, in any
// version that this host accepts; its description; and its results.

// Returns the text as one printable line of at most longest_reply_text bytes; empty for null.
std::string line_of(const char* text);

// Returns the plug-in's text about the call that failed last, in one line; empty if it gives none.
std::string text_of_error(const assay_detector_api& table);
// Returns the problem for ASSAY_BEYOND_CAPACITY, with the plug-in's own line if it gives one.
Problem refused_by_capacity(const std::string& text);

// Returns "evaluate returned 3: TEXT".
std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code);

// Returns the table in this host's version; functions that an older version does not have are NULL.
// Fails if `api` is NULL, has another version of the interface, or lacks a function; the problem
// does not name the library.
Expected<assay_detector_api> read_table(const assay_detector_api* api);

// Returns the plug-in's description. Fails if the description is invalid; the problem does not name
// the library.
Expected<PluginDescription> read_description(const assay_detector_api& table);
// Returns the description of a detector with these parts. Fails if the description is invalid.
Expected<PluginDescription> described(const assay_description& raw, const PluginParts& parts);

// Returns the result of a step. Its pairs have a < b, ascend, and occur once, with their least time
// ([0, 1] if no time is stated). Fails if the result breaks the rules of the interface. Fails also
// if the result says that the step has no answer; the problem then has the plug-in's own text. If
// `reports_pairs` is false (PairReporting::no_pairs), a result with pairs breaks the rules.
Expected<StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                 bool reports_pairs = true);

// Returns the answer of a limiter with these claims: the share, or -1, and the positions at which
// the caller stops. If the limiter gives no positions, they are computed from the share as
// Contract::limit_gives says. `way` is the displacement from x_t0 to x_t1. Fails if the share is
// invalid, if there are neither positions nor a share from which to compute them, if positions are
// not finite, or if a claim needs a share and none is stated.
Expected<LimitAnswer> limit_answer(const assay_limit& raw, const Claims& claims,
                                   const Contract& contract, const Positions& x_t0,
                                   const Positions& x_t1, const Positions& way);

// Returns the candidate pairs a < b, ascending, each once. Fails if an index is out of range.
Expected<std::vector<TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                    std::int32_t triangle_count);

}  // namespace assay::properties
