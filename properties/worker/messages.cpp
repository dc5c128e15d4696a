#include "properties/worker/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "detector/mesh/problem.h"
#include "properties/printable.h"

namespace assay::properties {
namespace {

using detector::Answer;
using detector::PairContact;
using detector::StepResult;
using detector::TimeEnclosure;

// The bytes of those fields of a result that are not lists, and of the numbers that begin lists.
constexpr std::uint64_t bytes_of_a_result = 4096;

bool is_line(const std::string& text) {
  return text.size() <= longest_reply_text && printable(text) == text;
}

bool is_interval(const TimeEnclosure& time) {
  return 0 <= time.lo && time.lo <= time.hi && time.hi <= 1;  // false for a NaN
}

// A plug-in says nothing of features.
bool is_unstated(const detector::Feature& feature) {
  const detector::Feature unstated;
  return feature.kind == unstated.kind && feature.vertices == unstated.vertices;
}

bool is_contact(const PairContact& contact, Eigen::Index triangles) {
  const auto [a, b] = contact.pair;
  return 0 <= a && a < b && b < triangles && is_interval(contact.time) &&
         is_unstated(contact.feature);
}

bool says_nothing_of_its_work(const StepResult& r) {
  const detector::StepCounts none;
  const auto& t = r.times;
  return std::memcmp(&r.counts, &none, sizeof none) == 0 && t.view_test == 0 && t.start == 0 &&
         t.ghosts == 0 && t.broad_phase == 0 && t.narrow_phase == 0 && t.closure == 0 &&
         t.total == 0;
}

bool says_nothing_of_views(const StepResult& r) {
  return r.view_positive + r.view_negative + r.view_zero + r.against_all + r.violated + r.dirty ==
             0 &&
         r.views == detector::ViewUse::not_asked_for && r.doubts.empty() && r.signs.empty() &&
         r.primitives.empty() && r.apexes.empty();
}

std::string broken_rule(const StepResult& result, Eigen::Index triangles) {
  if (result.problem) return "a problem that only the built-in detector states";
  if (!is_interval(result.first)) return "a first time that is no interval in [0, 1]";
  if (result.answer == Answer::free && !result.pairs.empty()) return "pairs beside the answer free";
  if (result.answer == Answer::error && !result.pairs.empty()) return "pairs beside an error";
  for (const auto& contact : result.pairs) {
    if (!is_contact(contact, triangles)) return "a pair that is none of the mesh";
  }
  const auto not_ascending = [](const PairContact& x, const PairContact& y) {
    return !(x.pair < y.pair);
  };
  if (std::adjacent_find(result.pairs.begin(), result.pairs.end(), not_ascending) !=
      result.pairs.end()) {
    return "pairs that do not ascend";
  }
  if (!says_nothing_of_its_work(result)) return "counts or times, which the host measures";
  return says_nothing_of_views(result) ? "" : "views, which no plug-in has";
}

std::string broken_rule(const CandidatePairs& candidates, const StepResult& result,
                        Eigen::Index triangles) {
  if (!candidates) {
    const bool is_answered = result.answer == Answer::free || result.answer == Answer::collision;
    return is_answered ? "no candidates beside an answer" : "";
  }
  for (const auto& [a, b] : *candidates) {
    if (!(0 <= a && a < b && b < triangles)) return "a candidate that is none of the mesh";
  }
  const auto not_ascending = [](const auto& x, const auto& y) { return !(x < y); };
  const bool ascend = std::adjacent_find(candidates->begin(), candidates->end(), not_ascending) ==
                      candidates->end();
  return ascend ? "" : "candidates that do not ascend";
}

std::string broken_rule(const std::optional<LimitAnswer>& limit, const StepResult& result,
                        Eigen::Index vertices, const Claims& claims) {
  if (!limit) {
    const bool is_answered = result.answer == Answer::free || result.answer == Answer::collision;
    return is_answered ? "no limit beside an answer" : "";
  }
  const bool is_unstated =
      limit->share == -1 && !claims.has_any({Claim::path_free, Claim::progress});
  if (!is_unstated && !(limit->share >= 0 && limit->share <= 1)) return "a share that is none";
  const auto& x = limit->positions;
  return x.rows() == vertices && x.allFinite() ? "" : "positions that are none of the mesh";
}

// Says which rule is broken about the parts that the description names. The run has a result for
// each step.
std::string broken_rule_of_parts(const CaseRun& run, const PluginParts& parts,
                                 Eigen::Index triangles, Eigen::Index vertices,
                                 const Claims& claims) {
  if (run.has_answers != parts.steps) return "answers of another kind of detector";
  const std::size_t lists = parts.candidates ? run.steps.size() : 0;
  if (lists == 0 && !run.candidates.empty()) return "candidates that it does not claim";
  if (run.candidates.size() != lists)
    return fmt::format("{} lists of candidates for {} steps", run.candidates.size(),
                       run.steps.size());
  const std::size_t limits = parts.limit ? run.steps.size() : 0;
  if (run.limits.size() != limits)
    return fmt::format("{} limits for {} steps", run.limits.size(), limits);
  for (std::size_t s = 0; s < limits; ++s) {
    if (auto broken = broken_rule(run.limits[s], run.steps[s], vertices, claims); !broken.empty())
      return broken;
  }
  for (std::size_t s = 0; s < run.steps.size(); ++s) {
    const auto& result = run.steps[s];
    const bool is_answered = result.answer == Answer::free || result.answer == Answer::collision;
    if (!run.has_answers && (is_answered || !result.pairs.empty()))
      return "an answer of a detector that has none";
    if (s >= lists) continue;
    if (auto broken = broken_rule(run.candidates[s], result, triangles); !broken.empty())
      return broken;
  }
  return "";
}

}  // namespace

std::uint64_t longest_reply(const corpus::Case& c) {
  const auto triangles = static_cast<std::uint64_t>(c.triangles.rows());
  const std::uint64_t pairs = triangles * (triangles - 1) / 2;
  const std::uint64_t steps = corpus::steps_of(c).size();
  return longest_reply_text + bytes_of_a_result +
         steps * (bytes_of_a_result + longest_reply_text +
                  static_cast<std::uint64_t>(c.frames.front().size()) * sizeof(double) +
                  pairs * (sizeof(PairContact) + sizeof(detector::TrianglePair)));
}

std::string broken_rule(const corpus::Case& c, const CaseRun& run,
                        const PluginDescription& description) {
  if (!is_line(run.explanation)) return "a text that is no line";
  switch (run.end) {
    case RunEnd::completed:
      break;
    case RunEnd::refused:
    case RunEnd::beyond_capacity:
    case RunEnd::out_of_memory:
      return run.steps.empty() && run.candidates.empty() && run.limits.empty() &&
                     run.errors.empty() && run.over_capacity.empty() && !run.times
                 ? ""
                 : "steps of a case that was not run";
    default:
      return fmt::format("that it {}, which only the host can say", name_of(run.end));
  }
  const std::size_t steps = corpus::steps_of(c).size();
  if (run.steps.size() != steps) {
    return fmt::format("{} results for {} steps", run.steps.size(), steps);
  }
  // The triangles of a query only hold its features, so there is no pair of them to be stated.
  const bool is_query = query_of(c).has_value();
  const Eigen::Index triangles = is_query ? 0 : c.triangles.rows();
  for (const auto& result : run.steps) {
    if (auto broken = broken_rule(result, triangles); !broken.empty()) return broken;
  }
  if (run.errors.size() > steps || !std::all_of(run.errors.begin(), run.errors.end(), is_line))
    return "errors of steps that are none";
  if (!run.over_capacity.empty() && run.over_capacity.size() != steps)
    return "refusals of steps that are none";
  for (std::size_t s = 0; s < steps; ++s) {
    if (is_over_capacity(run, s) && run.steps[s].answer != Answer::error)
      return "an answer of a step that it refuses";
  }
  if (run.times) {
    const auto is_time = [](double seconds) { return 0 <= seconds && std::isfinite(seconds); };
    const auto& of_steps = run.times->steps;
    if (of_steps.size() != steps || !is_time(run.times->create) ||
        !std::all_of(of_steps.begin(), of_steps.end(), is_time)) {
      return "times that are none";
    }
  }
  return broken_rule_of_parts(run, is_query ? PluginParts{} : description.parts, triangles,
                              c.frames.front().rows(), description.claims);
}

std::string broken_rule(const PluginDescription& description) {
  if (!is_line(description.name) || !is_line(description.version)) return "a name that is no line";
  if (description.name.empty()) return "no name";
  for (const auto& text : {description.name, description.version}) {
    if (auto fault = fault_of_name(text); !fault.empty()) return fault;
  }
  const auto& parts = description.parts;
  if (!parts.steps && !parts.query && !parts.candidates && !parts.limit)
    return "no part that can be judged";
  if (!description.claims.without(claims_from_outside).empty())
    return "claims that no plug-in can make";
  if (description.claims.has(Claim::candidates) != parts.candidates)
    return "candidates without a claim, or a claim on none";
  if (auto fault = fault_of_limits(description.claims, description.contract, parts.limit);
      !fault.empty())
    return fault;
  return fault_of(description.contract);
}

std::string broken_rule(const std::string& refusal) {
  return is_line(refusal) ? "" : "a refusal that is no line";
}

}  // namespace assay::properties
