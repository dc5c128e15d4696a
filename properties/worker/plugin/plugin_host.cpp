#include "properties/worker/plugin/plugin_host.h"

#include <dlfcn.h>

#include <algorithm>
#include <memory>
#include <new>

#include "detector/step_result.h"
#include "properties/printable.h"
#include "properties/worker/plugin/plugin_result.h"
#include "properties/worker/plugin/plugin_table.h"

namespace assay::properties {

using detector::Answer;
using detector::StepResult;

namespace {

// The steps of one case through one handle.
class PluginRun {
 public:
  PluginRun(const assay_detector_api& api, assay_handle* handle, std::int32_t triangle_count,
            bool reports_pairs)
      : api_(api),
        handle_(handle, api.destroy),
        triangle_count_(triangle_count),
        reports_pairs_(reports_pairs) {}

  // The result of a step, or why it has none: out_of_memory, step_failed, broken_result.
  Expected<StepResult> step(const detector::Positions& x_t0, const detector::Positions& x_t1,
                            bool commit) {
    const auto evaluated =
        called("evaluate", api_.evaluate(handle_.get(), x_t0.data(), x_t1.data()));
    if (!evaluated) return evaluated.error();
    assay_result raw = {};
    const auto asked = called("result", api_.result(handle_.get(), &raw));
    if (!asked) return asked.error();
    auto result = step_result(raw, triangle_count_, reports_pairs_);
    if (!result) return result;
    const Answer answer = result.value().answer;
    if (commit && (answer == Answer::free || answer == Answer::collision)) {
      const auto committed = called("commit", api_.commit(handle_.get()));
      if (!committed) return committed.error();
    }
    return result;
  }

 private:
  // Whether the call did its work.
  static Expected<void> called(const char* function, std::int32_t code) {
    if (code == ASSAY_OK) return boost::outcome_v2::success();
    if (code == ASSAY_OUT_OF_MEMORY) return Problem{ProblemKind::out_of_memory, "out of memory"};
    return Problem{ProblemKind::step_failed,
                   std::string(function) + " returned " + std::to_string(code)};
  }

  const assay_detector_api& api_;
  std::unique_ptr<assay_handle, void (*)(assay_handle*)> handle_;
  std::int32_t triangle_count_;
  bool reports_pairs_;
};

}  // namespace

Expected<PluginHost> PluginHost::open(const std::filesystem::path& library, std::uint32_t threads) {
  const auto problem = [&](ProblemKind kind, const std::string& what) {
    return Problem{kind, line_of(library.c_str()) + ": " + line_of(what.c_str())};
  };
  std::error_code ignored;
  if (!std::filesystem::exists(library, ignored))
    return problem(ProblemKind::not_found, "no such file");
  // A pipe would be waited for.
  if (!std::filesystem::is_regular_file(library, ignored))
    return problem(ProblemKind::not_a_plugin, "not a detector plug-in: not a file");
  // With a slash in it, so that no search path is asked.
  const auto path = std::filesystem::absolute(library, ignored);
  void* loaded = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!loaded) {
    return problem(ProblemKind::not_a_plugin,
                   std::string("not a detector plug-in: ") + ::dlerror());
  }
  const auto entry =
      reinterpret_cast<const assay_detector_api* (*)()>(::dlsym(loaded, "assay_detector"));
  if (!entry) {
    return problem(ProblemKind::not_a_plugin,
                   "not a detector plug-in: it exports no assay_detector()");
  }
  auto table = read_table(entry());
  if (!table) return problem(table.error().kind, table.error().message);
  auto description = read_description(table.value());
  if (!description) return problem(description.error().kind, description.error().message);
  if (table.value().use_threads) table.value().use_threads(threads);
  return PluginHost(table.value(), std::move(description.value()));
}

CaseRun PluginHost::run(const corpus::Case& c) const {
  if (!description_.parts.steps) return {RunEnd::refused, "it takes no steps", {}};
  std::vector<detector::Positions> frames;
  for (const auto& frame : c.frames) {
    frames.push_back(contracted(frame, description_.contract.coordinates));
    if (frames.back().allFinite()) continue;
    return {RunEnd::refused,
            std::string("a coordinate is beyond ") + name_of(description_.contract.coordinates),
            {}};
  }
  assay_handle* handle = nullptr;
  const char* message = nullptr;
  const std::int32_t code = table_.create(
      c.triangles.data(), static_cast<std::uint64_t>(c.triangles.rows()), frames.front().data(),
      static_cast<std::uint64_t>(frames.front().rows()), &handle, &message);
  if (code == ASSAY_OUT_OF_MEMORY) return out_of_memory();
  if (code != ASSAY_OK || !handle) {
    std::string what = line_of(message);
    if (what.empty()) what = "create returned " + std::to_string(code);
    return {RunEnd::refused, std::move(what), {}};
  }
  PluginRun plugin(table_, handle, static_cast<std::int32_t>(c.triangles.rows()),
                   description_.contract.reports_pairs);
  CaseRun run;
  for (const auto& step : corpus::steps_of(c)) {
    auto result = plugin.step(frames[static_cast<std::size_t>(step.from)],
                              frames[static_cast<std::size_t>(step.to)], step.commit);
    if (result) {
      run.steps.push_back(std::move(result.value()));
      continue;
    }
    const auto& [kind, why] = result.error();
    StepResult& failed = run.steps.emplace_back();
    failed.answer = kind == ProblemKind::out_of_memory ? Answer::undecided : Answer::error;
    if (run.what.empty()) {
      run.what = "step " + std::to_string(run.steps.size()) + ": " + line_of(why.c_str());
    }
  }
  return run;
}

}  // namespace assay::properties
