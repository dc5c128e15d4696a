#include "properties/worker/messages.h"

#include <algorithm>

namespace assay::properties {

using detector::PairContact;

std::uint64_t longest_reply(const corpus::Case& c) {
  // Those fields of a result that are not lists, and the numbers that begin lists.
  constexpr std::uint64_t bytes_of_a_result = 4096;
  const auto triangles = static_cast<std::uint64_t>(c.triangles.rows());
  const std::uint64_t pairs = triangles * (triangles - 1) / 2;
  const std::uint64_t steps = corpus::steps_of(c).size();
  return longest_reply_text + bytes_of_a_result +
         steps * (bytes_of_a_result + longest_reply_text +
                  static_cast<std::uint64_t>(c.frames.front().size()) * sizeof(double) +
                  pairs * (sizeof(PairContact) + sizeof(detector::TrianglePair)));
}

bool fits(const CaseRun& run, const corpus::Case& c) {
  const auto is_pair = [&](const detector::TrianglePair& pair) {
    return 0 <= pair.a && pair.a < pair.b && pair.b < c.triangles.rows();
  };
  const std::size_t steps = run.end == RunEnd::completed ? corpus::steps_of(c).size() : 0;
  const auto fit = [&](std::size_t size) { return size == 0 || size == steps; };
  return run.steps.size() == steps && fit(run.candidates.size()) && fit(run.limits.size()) &&
         run.errors.size() <= steps && fit(run.over_capacity.size()) &&
         (!run.times || fit(run.times->steps.size())) &&
         std::all_of(run.steps.begin(), run.steps.end(),
                     [&](const detector::StepResult& step) {
                       return std::all_of(
                           step.pairs.begin(), step.pairs.end(),
                           [&](const PairContact& contact) { return is_pair(contact.pair); });
                     }) &&
         std::all_of(run.candidates.begin(), run.candidates.end(),
                     [&](const CandidatePairs& pairs) {
                       return !pairs || std::all_of(pairs->begin(), pairs->end(), is_pair);
                     }) &&
         std::all_of(run.limits.begin(), run.limits.end(), [&](const auto& limit) {
           return !limit || limit->positions.rows() == c.frames.front().rows();
         });
}

}  // namespace assay::properties
