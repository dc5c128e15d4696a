#include "properties/worker/plugin/plugin_host.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>

#include "detector/step_result.h"
#include "properties/printable.h"
#include "properties/worker/plugin/plugin_result.h"

namespace assay::properties {

using detector::Answer;
using detector::StepResult;

namespace {

// One line of printable text, and no more of it than a reply may hold.
std::string line_of(const char* text) {
  constexpr std::size_t longest = 1000;
  if (!text) return "";
  std::string line(text, ::strnlen(text, longest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return 0 < c && c < ' '; }, ' ');
  return printable(line);
}

// The problems that follow do not name the library yet.
Expected<void> check_table(const assay_detector_api* api) {
  if (!api) {
    return Problem{ProblemKind::not_a_plugin,
                   "not a detector plug-in: assay_detector() returns nothing"};
  }
  if (api->abi_version != ASSAY_DETECTOR_ABI_VERSION) {
    return Problem{ProblemKind::other_abi_version,
                   "built for ABI version " + std::to_string(api->abi_version) +
                       ", this program has " + std::to_string(ASSAY_DETECTOR_ABI_VERSION)};
  }
  const bool complete =
      api->describe && api->create && api->evaluate && api->commit && api->result && api->destroy;
  if (!complete) return Problem{ProblemKind::broken_plugin, "a function is missing in its table"};
  return boost::outcome_v2::success();
}

// What the description does not say sensibly; empty: nothing.
std::string fault_of(const assay_description* raw) {
  if (!raw) return "describe() returns nothing";
  constexpr std::uint32_t all_bits = (ASSAY_CLAIM_TOTAL << 1) - 1;
  if (raw->claims & ~all_bits) return "unknown bits in its claims";
  if (raw->adjacency < 0 || raw->adjacency > ASSAY_ADJACENCY_NO_SHARED_VERTEX) {
    return "unknown adjacency " + std::to_string(raw->adjacency);
  }
  if (raw->coordinates < 0 || raw->coordinates > ASSAY_COORDINATES_FLOAT32) {
    return "unknown coordinates " + std::to_string(raw->coordinates);
  }
  if (!std::isfinite(raw->margin) || raw->margin < 0) return "its margin is no length";
  return line_of(raw->name).empty() ? "it has no name" : "";
}

Expected<PluginDescription> read_description(const assay_description* raw) {
  std::string fault = fault_of(raw);
  if (!fault.empty()) return Problem{ProblemKind::broken_plugin, std::move(fault)};
  PluginDescription description;
  description.name = line_of(raw->name);
  description.version = line_of(raw->version);
  const auto has = [&](std::uint32_t bit) { return (raw->claims & bit) != 0; };
  description.claims = {has(ASSAY_CLAIM_FREE_SOUND),    has(ASSAY_CLAIM_NOT_LATE),
                        has(ASSAY_CLAIM_FIRST_TIME),    has(ASSAY_CLAIM_FIRST_PAIRS),
                        has(ASSAY_CLAIM_ALL_PAIRS),     has(ASSAY_CLAIM_NO_SPURIOUS),
                        has(ASSAY_CLAIM_DETERMINISTIC), has(ASSAY_CLAIM_TOTAL)};
  description.contract = {static_cast<Adjacency>(raw->adjacency),
                          static_cast<Coordinates>(raw->coordinates), raw->margin};
  return description;
}

// The steps of one case through one handle.
class PluginRun {
 public:
  PluginRun(const assay_detector_api& api, assay_handle* handle, std::int32_t triangle_count)
      : api_(api), handle_(handle, api.destroy), triangle_count_(triangle_count) {}

  // The result of a step, or why it has none: out_of_memory, step_failed, broken_result.
  Expected<StepResult> step(const detector::Positions& x_t0, const detector::Positions& x_t1,
                            bool commit) {
    const auto evaluated =
        called("evaluate", api_.evaluate(handle_.get(), x_t0.data(), x_t1.data()));
    if (!evaluated) return evaluated.error();
    assay_result raw = {};
    const auto asked = called("result", api_.result(handle_.get(), &raw));
    if (!asked) return asked.error();
    auto result = step_result(raw, triangle_count_);
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
};

}  // namespace

Expected<PluginHost> PluginHost::open(const std::filesystem::path& library) {
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
  const assay_detector_api* api = entry();
  const auto table = check_table(api);
  if (!table) return problem(table.error().kind, table.error().message);
  auto description = read_description(api->describe());
  if (!description) return problem(description.error().kind, description.error().message);
  return PluginHost(api, std::move(description.value()));
}

CaseRun PluginHost::run(const corpus::Case& c) const {
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
  const std::int32_t code = api_->create(
      c.triangles.data(), static_cast<std::uint64_t>(c.triangles.rows()), frames.front().data(),
      static_cast<std::uint64_t>(frames.front().rows()), &handle, &message);
  if (code == ASSAY_OUT_OF_MEMORY) return out_of_memory();
  if (code != ASSAY_OK || !handle) {
    std::string what = line_of(message);
    if (what.empty()) what = "create returned " + std::to_string(code);
    return {RunEnd::refused, std::move(what), {}};
  }
  PluginRun plugin(*api_, handle, static_cast<std::int32_t>(c.triangles.rows()));
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
