#include "properties/worker/plugin/plugin_host.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "detector/step_result.h"
#include "properties/worker/plugin/plugin_result.h"

namespace assay::properties {

using detector::Answer;
using detector::StepResult;

namespace {

// One line of printable text.
std::string line_of(const char* text) {
  std::string line = text ? text : "";
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  }
  return line;
}

std::string check_table(const assay_detector_api* api) {
  if (!api) return "not a detector plug-in: assay_detector() returns nothing";
  if (api->abi_version != ASSAY_DETECTOR_ABI_VERSION) {
    return "built for ABI version " + std::to_string(api->abi_version) + ", this program has " +
           std::to_string(ASSAY_DETECTOR_ABI_VERSION);
  }
  const bool complete =
      api->describe && api->create && api->evaluate && api->commit && api->result && api->destroy;
  return complete ? "" : "a function is missing in its table";
}

std::string read_description(const assay_description* raw, PluginDescription& description) {
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
  description.name = line_of(raw->name);
  description.version = line_of(raw->version);
  if (description.name.empty()) return "it has no name";
  const auto has = [&](std::uint32_t bit) { return (raw->claims & bit) != 0; };
  description.claims = {has(ASSAY_CLAIM_FREE_SOUND),    has(ASSAY_CLAIM_NOT_LATE),
                        has(ASSAY_CLAIM_FIRST_TIME),    has(ASSAY_CLAIM_FIRST_PAIRS),
                        has(ASSAY_CLAIM_ALL_PAIRS),     has(ASSAY_CLAIM_NO_SPURIOUS),
                        has(ASSAY_CLAIM_DETERMINISTIC), has(ASSAY_CLAIM_TOTAL)};
  description.contract = {static_cast<Adjacency>(raw->adjacency),
                          static_cast<Coordinates>(raw->coordinates), raw->margin};
  return "";
}

// The steps of one case through one handle.
class PluginRun {
 public:
  PluginRun(const assay_detector_api& api, assay_handle* handle, std::int32_t triangle_count)
      : api_(api), handle_(handle, api.destroy), triangle_count_(triangle_count) {}

  StepResult step(const detector::Positions& x_t0, const detector::Positions& x_t1, bool commit,
                  std::string& problem) {
    StepResult result;
    if (!called("evaluate", api_.evaluate(handle_.get(), x_t0.data(), x_t1.data()), result,
                problem)) {
      return result;
    }
    assay_result raw = {};
    if (!called("result", api_.result(handle_.get(), &raw), result, problem)) return result;
    result = step_result(raw, triangle_count_, problem);
    const bool answered = result.answer == Answer::free || result.answer == Answer::collision;
    StepResult failed;
    if (commit && answered && !called("commit", api_.commit(handle_.get()), failed, problem)) {
      return failed;
    }
    return result;
  }

 private:
  // Whether the call did its work; else `result` is what the step becomes.
  static bool called(const char* function, std::int32_t code, StepResult& result,
                     std::string& problem) {
    if (code == ASSAY_OK) return true;
    result.answer = code == ASSAY_OUT_OF_MEMORY ? Answer::undecided : Answer::error;
    problem = code == ASSAY_OUT_OF_MEMORY
                  ? "out of memory"
                  : std::string(function) + " returned " + std::to_string(code);
    return false;
  }

  const assay_detector_api& api_;
  std::unique_ptr<assay_handle, void (*)(assay_handle*)> handle_;
  std::int32_t triangle_count_;
};

}  // namespace

PluginExpected<PluginHost> PluginHost::open(const std::filesystem::path& library) {
  const auto problem = [&](const std::string& what) {
    return PluginProblem{library.string() + ": " + line_of(what.c_str())};
  };
  std::error_code ignored;
  if (!std::filesystem::exists(library, ignored)) return problem("no such file");
  // With a slash in it, so that no search path is asked.
  const auto path = std::filesystem::absolute(library, ignored);
  void* loaded = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!loaded) return problem(std::string("not a detector plug-in: ") + ::dlerror());
  const auto entry =
      reinterpret_cast<const assay_detector_api* (*)()>(::dlsym(loaded, "assay_detector"));
  if (!entry) return problem("not a detector plug-in: it exports no assay_detector()");
  const assay_detector_api* api = entry();
  PluginDescription description;
  std::string wrong = check_table(api);
  if (wrong.empty()) wrong = read_description(api->describe(), description);
  if (!wrong.empty()) return problem(wrong);
  return PluginHost(api, std::move(description));
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
    std::string problem;
    run.steps.push_back(plugin.step(frames[static_cast<std::size_t>(step.from)],
                                    frames[static_cast<std::size_t>(step.to)], step.commit,
                                    problem));
    if (!problem.empty() && run.what.empty()) {
      run.what = "step " + std::to_string(run.steps.size()) + ": " + line_of(problem.c_str());
    }
  }
  return run;
}

}  // namespace assay::properties
