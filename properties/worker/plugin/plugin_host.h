// Loads a plug-in and runs cases through it. The library's code, its constructors included, runs
// in this process: only the worker does that.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "detector/plugin/assay_detector.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/plugin_description.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

class PluginHost {
 public:
  // not_found; not_a_plugin: not a shared library, or no assay_detector() in it;
  // other_abi_version; broken_plugin: a table with a gap, or a description that says nothing
  // sensible. Never unloaded again. threads: told to a library that asks how many it may use.
  // called: by the user, for problems; empty: by its file.
  static Expected<PluginHost> open(const std::filesystem::path& library, std::uint32_t threads = 1,
                                   const std::string& called = {});

  const PluginDescription& description() const { return description_; }

  // As run_case. A result that breaks the header's rules (an index out of range, an interval that
  // is none) makes its step an error; errors are told in `what`. Coordinates are rounded to what
  // the contract says; steps that it leaves out are the caller's to leave out.
  CaseRun run(const corpus::Case& c, bool is_timed = false) const;

  // An answer to each query, by the same rules. REQUIRES that it has the part, and queries as the
  // contract has them.
  std::vector<QueryAnswer> ask(std::span<const detector::FourPoints> queries) const;

 private:
  PluginHost(const assay_detector_api& table, PluginDescription description)
      : table_(table), description_(std::move(description)) {}

  assay_detector_api table_;  // of this host's version
  PluginDescription description_;
};

}  // namespace assay::properties
