// Loads a plug-in and runs cases through it. The library's code, its constructors included, runs
// in this process; so only the worker may use this class.
#pragma once

#include <filesystem>

#include "detector/plugin/assay_detector.h"
#include "properties/claims/claims.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

class PluginHost {
 public:
  // Loads a library, which is never unloaded again. `threads` is told to a library that asks how
  // many it may use. `called` is the user's name for it in problems; empty: its file. Refuses
  // what is no file or no shared library, one without assay_detector(), another version of the
  // interface, a table with a gap, and a description that makes no sense.
  static Expected<PluginHost> open(const std::filesystem::path& library, std::uint32_t threads = 1,
                                   const std::string& called = {});

  const PluginDescription& description() const { return description_; }

  // Whether run() evaluates each step twice. The second result is the one that is taken.
  void ask_twice(bool asks_twice) { asks_twice_ = asks_twice; }

  // Runs a case as run_case does. If a result breaks the header's rules (an index out of range, an
  // invalid interval), its step is an error; `explanation` tells errors. Coordinates are rounded
  // as the contract says. The caller has to leave out the steps that the contract leaves out. If
  // the case is a query (query_case.h), that function of the plug-in is asked, with the coordinates
  // as they are.
  CaseRun run(const corpus::Case& c, bool is_timed = false) const;

 private:
  CaseRun ask(const detector::FourPoints& query, bool is_timed) const;

  PluginHost(const assay_detector_api& table, PluginDescription description)
      : table_(table), description_(std::move(description)) {}

  assay_detector_api table_;  // in the form of this host's version
  PluginDescription description_;
  bool asks_twice_ = false;
};

}  // namespace assay::properties
