#include "properties/worker/plugin/plugin_host.h"

#include <dlfcn.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <memory>

#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

// Runs the steps of one case through one handle.
struct PluginRun {
  const assay_detector_api& api_;
  const std::unique_ptr<assay_handle, void (*)(assay_handle*)> handle_;
  const std::int32_t triangle_count_;
  const bool reports_pairs_, asks_twice_;

  // Returns the candidate pairs of a step, or why there are none.
  Expected<std::vector<TrianglePair>> candidates(const Positions& x_t0, const Positions& x_t1) {
    assay_candidates raw = {};
    BOOST_OUTCOME_TRYV(
        status("candidates", api_.candidates(handle_.get(), x_t0.data(), x_t1.data(), &raw)));
    return candidate_pairs(raw, triangle_count_);
  }

  // Returns how far the limiter lets a step go, or why it does not say.
  // `way` is x_t1, or the displacement to it, as the contract has it.
  Expected<LimitAnswer> limit(const Positions& x_t0, const Positions& x_t1, const Positions& way,
                              const PluginDescription& description) {
    assay_limit raw = {};
    raw.share = -1;
    BOOST_OUTCOME_TRYV(status("limit", api_.limit(handle_.get(), x_t0.data(), way.data(), &raw)));
    return limit_answer(raw, description.claims, description.contract, x_t0, x_t1, way);
  }

  // Returns the result of a step, or why it has none, for the same reasons.
  Expected<StepResult> step(const Positions& x_t0, const Positions& x_t1, bool commit) {
    auto result = evaluated_step(x_t0, x_t1);
    if (result && asks_twice_) result = evaluated_step(x_t0, x_t1);
    if (!result) return result;
    const Answer answer = result.value().answer;
    if (commit && (answer == Answer::free || answer == Answer::collision)) {
      BOOST_OUTCOME_TRYV(status("commit", api_.commit(handle_.get())));
    }
    return result;
  }

 private:
  Expected<StepResult> evaluated_step(const Positions& x_t0, const Positions& x_t1) {
    BOOST_OUTCOME_TRYV(status("evaluate", api_.evaluate(handle_.get(), x_t0.data(), x_t1.data())));
    assay_result raw = {};
    BOOST_OUTCOME_TRYV(status("result", api_.result(handle_.get(), &raw)));
    if (raw.answer == ASSAY_ERROR && !(raw.message && *raw.message)) {
      if (auto text = text_of_error(api_); !text.empty()) return Problem{std::move(text)};
    }
    return step_result(raw, triangle_count_, reports_pairs_);
  }

  // Says why the call did not do its work, if it did not.
  Expected<void> status(const char* function, std::int32_t code) const {
    if (code == ASSAY_OK) return boost::outcome_v2::success();
    if (code == ASSAY_OUT_OF_MEMORY) return Problem{"out of memory", ProblemKind::out_of_memory};
    if (code == ASSAY_BEYOND_CAPACITY) return refused_by_capacity(text_of_error(api_));
    return Problem{text_of_code(api_, function, code)};
  }
};

// Tells the plug-in which pairs count. Says why the plug-in does not take the relation; empty if it
// does.
std::string tell_what_counts(const assay_detector_api& table, assay_handle* handle,
                             const CountedPairs& pairs) {
  // The pairs are handed over as they lie in memory.
  static_assert(sizeof(TrianglePair) == 2 * sizeof(std::int32_t));
  static_assert(sizeof(detector::VertexAndFace) == 2 * sizeof(std::int32_t));
  static_assert(sizeof(detector::TwoEdges) == 4 * sizeof(std::int32_t));
  static_assert(sizeof(Point) == 3 * sizeof(double));
  const auto numbers = [](const auto& list) {
    return list.empty() ? nullptr : reinterpret_cast<const std::int32_t*>(list.data());
  };
  assay_counted_pairs counted_pairs = {};
  counted_pairs.level = static_cast<std::int32_t>(pairs.level);
  counted_pairs.body = numbers(pairs.body);
  counted_pairs.apart_count = pairs.apart.size();
  counted_pairs.apart = numbers(pairs.apart);
  counted_pairs.rings = pairs.rings;
  counted_pairs.rest_distance = pairs.rest_distance;
  counted_pairs.rest = pairs.rest.empty() ? nullptr : pairs.rest.front().data();
  counted_pairs.triangle_pair_count = pairs.triangle_pairs.size();
  counted_pairs.triangle_pairs = numbers(pairs.triangle_pairs);
  counted_pairs.vertex_face_count = pairs.vertex_faces.size();
  counted_pairs.vertex_faces = numbers(pairs.vertex_faces);
  counted_pairs.edge_pair_count = pairs.edge_pairs.size();
  counted_pairs.edge_pairs = numbers(pairs.edge_pairs);
  const std::int32_t code = table.count(handle, &counted_pairs);
  return code == ASSAY_OK ? "" : text_of_code(table, "count", code);
}

}  // namespace

Expected<PluginHost> PluginHost::open(const std::filesystem::path& library, std::uint32_t threads,
                                      const std::string& name) {
  const auto problem = [&](const std::string& explanation) {
    return Problem{line_of(name.empty() ? library.c_str() : name.c_str()) + ": " +
                   line_of(explanation.c_str())};
  };
  std::error_code ignored;
  if (!std::filesystem::exists(library, ignored)) return problem("no such file");
  // Only a regular file is opened, because opening a pipe would wait.
  if (!std::filesystem::is_regular_file(library, ignored))
    return problem("not a detector plug-in: not a file");
  // An absolute path has a slash in it, so that no search path is asked.
  const auto path = std::filesystem::absolute(library, ignored);
  void* handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    return problem(std::string("not a detector plug-in: ") + ::dlerror());
  }
  const auto entry =
      reinterpret_cast<const assay_detector_api* (*)()>(::dlsym(handle, "assay_detector"));
  if (!entry) {
    return problem("not a detector plug-in: it exports no assay_detector()");
  }
  auto table = read_table(entry());
  if (!table) return problem(table.error().message);
  auto description = read_description(table.value());
  if (!description) return problem(description.error().message);
  if (table.value().use_threads) table.value().use_threads(threads);
  return PluginHost(table.value(), std::move(description.value()));
}

CaseRun PluginHost::ask(const Case& c, int first_group, bool is_timed) const {
  const auto step = steps_of(c).front();
  const Positions& x_t0 = start_of(c, step);
  Positions x_t1 = end_of(c, step);
  // The displacement is exact in a contracted query.
  if (description_.contract.motion == MotionGiven::displacement) x_t1 -= x_t0;
  assay_query_result raw = {};
  RunClock clock(is_timed);
  clock.created();
  clock.begin();
  const std::int32_t code =
      table_.query(first_group == 1 ? ASSAY_QUERY_VERTEX_FACE : ASSAY_QUERY_EDGE_EDGE, x_t0.data(),
                   x_t1.data(), &raw);
  clock.end_step();
  CaseRun run;
  run.times = clock.take();
  StepResult& result = run.steps.emplace_back();
  if (code == ASSAY_OUT_OF_MEMORY) {
    result.answer = Answer::undecided;
    run.explanation = "out of memory";
  } else if (code != ASSAY_OK) {
    run.explanation = text_of_code(table_, "query", code);
  } else {
    assay_result alike = {};
    alike.answer = raw.answer;
    alike.first_lo = raw.first_lo;
    alike.first_hi = raw.first_hi;
    auto answer = step_result(alike, 0);
    if (answer) {
      result = std::move(answer.value());
    } else {
      const auto text = raw.answer == ASSAY_ERROR ? text_of_error(table_) : "";
      run.explanation = text.empty() ? answer.error().message : text;
    }
  }
  return run;
}

CaseRun PluginHost::run(const Case& c, bool is_timed) const {
  const auto& parts = description_.parts;
  if (const auto query = query_of(c)) {
    if (!parts.query) return {RunEnd::refused, "it answers no queries", {}};
    return ask(c, query->first_group, is_timed);
  }
  if (!parts.steps && !parts.candidates && !parts.limit)
    return {RunEnd::refused, "it takes no steps", {}};
  std::vector<Positions> frames;
  for (const auto& frame : c.frames) {
    frames.push_back(round_to(frame, description_.contract.coordinates));
    if (frames.back().allFinite()) continue;
    return {RunEnd::refused,
            std::string("a coordinate is beyond ") + name_of(description_.contract.coordinates),
            {}};
  }
  assay_handle* handle = nullptr;
  const char* message = nullptr;
  RunClock clock(is_timed);
  const std::int32_t code = table_.create(
      c.triangles.data(), static_cast<std::uint64_t>(c.triangles.rows()), frames.front().data(),
      static_cast<std::uint64_t>(frames.front().rows()), &handle, &message);
  clock.created();
  if (code == ASSAY_OUT_OF_MEMORY) return out_of_memory();
  if (code != ASSAY_OK || !handle) {
    std::string explanation = line_of(message);
    if (code == ASSAY_BEYOND_CAPACITY)
      return {RunEnd::beyond_capacity, refused_by_capacity(explanation).message, {}};
    if (explanation.empty()) explanation = text_of_code(table_, "create", code);
    return {RunEnd::refused, std::move(explanation), {}};
  }
  PluginRun plugin{table_,
                   {handle, table_.destroy},
                   static_cast<std::int32_t>(c.triangles.rows()),
                   description_.contract.reports_pairs(),
                   asks_twice_};
  if (c.counted && !c.counted->pairs.count_all()) {
    // A contracted case has no relation for such a plug-in.
    if (!table_.count) return {RunEnd::refused, "the relation needs a function `count`", {}};
    auto refusal = tell_what_counts(table_, handle, c.counted->pairs);
    if (!refusal.empty()) return {RunEnd::refused, std::move(refusal), {}};
  }
  CaseRun run;
  run.has_answers = parts.steps;
  for (const auto& step : steps_of(c)) {
    const auto& x_t0 = frames[static_cast<std::size_t>(step.from)];
    const auto& x_t1 = frames[static_cast<std::size_t>(step.to)];
    const bool is_displaced = description_.contract.motion == MotionGiven::displacement;
    const auto way = is_displaced ? displacement(x_t0, end_of(c, step)) : x_t1;
    StepResult& result = run.steps.emplace_back();
    result.answer = Answer::undecided;
    const auto fail = [&](const Problem& problem) {
      result = {};
      result.answer =
          problem.kind == ProblemKind::out_of_memory ? Answer::undecided : Answer::error;
      if (problem.kind == ProblemKind::beyond_capacity) note_capacity(run, run.steps.size() - 1);
      note_error(run, run.steps.size() - 1, line_of(problem.message.c_str()));
    };
    // Candidates and limits are asked for before the step is evaluated, because nothing may stand
    // between that and its commit.
    std::optional<Problem> problem;
    const auto ask = [&](auto& list, auto&& answer) {
      list.emplace_back();
      if (answer) {
        list.back() = std::move(answer.value());
      } else {
        problem = answer.error();
      }
    };
    if (parts.candidates) ask(run.candidates, plugin.candidates(x_t0, way));
    if (parts.limit) ask(run.limits, plugin.limit(x_t0, x_t1, way, description_));
    clock.begin();
    if (parts.steps) {
      auto answer = plugin.step(x_t0, way, step.commit);
      if (answer) {
        result = std::move(answer.value());
      } else {
        fail(answer.error());
      }
    }
    clock.end_step();
    if (problem) fail(*problem);
  }
  if (!run.over_capacity.empty()) run.over_capacity.resize(run.steps.size());
  run.times = clock.take();
  return run;
}

}  // namespace assay::properties
