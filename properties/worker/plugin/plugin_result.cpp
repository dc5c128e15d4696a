#include "properties/worker/plugin/plugin_result.h"

#include <algorithm>

#include "detector/mesh/step_types.h"
#include "detector/step_result.h"
#include "properties/claims/contract.h"

namespace assay::properties {

using detector::Answer;
using detector::PairContact;
using detector::TimeEnclosure;

namespace {

bool is_interval(const TimeEnclosure& time) {
  return 0 <= time.lo && time.lo <= time.hi && time.hi <= 1;  // false for a NaN
}

// Returns false if the numbers are no pair of triangles of this mesh.
bool read_pair(const std::int32_t* raw, std::int32_t triangle_count, detector::TrianglePair& pair) {
  pair = {std::min(raw[0], raw[1]), std::max(raw[0], raw[1])};
  return 0 <= pair.a && pair.a < pair.b && pair.b < triangle_count;
}

std::string numbers_of(const detector::TimeEnclosure& time) {
  return "[" + number_text(time.lo) + ", " + number_text(time.hi) + "]";
}

// Says which rule is broken; empty if none is.
std::string read_pairs(const assay_result& raw, std::int32_t triangle_count,
                       std::vector<PairContact>& pairs) {
  if (raw.pair_count > 0 && !raw.pairs) return "pairs are counted but not given";
  for (std::uint64_t i = 0; i < raw.pair_count; ++i) {
    PairContact contact;
    if (!read_pair(raw.pairs + 2 * i, triangle_count, contact.pair)) {
      return "pair " + std::to_string(i) + " names no two triangles";
    }
    contact.time = {0, 1};
    if (raw.pair_times) contact.time = {raw.pair_times[2 * i], raw.pair_times[2 * i + 1]};
    if (!is_interval(contact.time)) {
      return "the time of pair " + std::to_string(i) + ", " + numbers_of(contact.time) +
             ", is no interval in [0, 1]";
    }
    pairs.push_back(contact);
  }
  std::sort(pairs.begin(), pairs.end(), [](const PairContact& a, const PairContact& b) {
    return a.pair != b.pair ? a.pair < b.pair : a.time < b.time;
  });
  const auto same_pair = [](const PairContact& a, const PairContact& b) {
    return a.pair == b.pair;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same_pair), pairs.end());
  return "";
}

// REQUIRES that the plug-in does not call it an error. Says which rule is broken; empty if none
// is.
std::string read_result(const assay_result& raw, std::int32_t triangle_count,
                        detector::StepResult& result) {
  switch (raw.answer) {
    case ASSAY_FREE:
      result.answer = Answer::free;
      return raw.pair_count == 0 ? "" : "answers free and gives pairs";
    case ASSAY_UNDECIDED:
      result.answer = Answer::undecided;
      return read_pairs(raw, triangle_count, result.pairs);
    case ASSAY_COLLISION:
      result.answer = Answer::collision;
      result.first = {raw.first_lo, raw.first_hi};
      if (!is_interval(result.first)) {
        return "its first time, " + numbers_of(result.first) + ", is no interval in [0, 1]";
      }
      return read_pairs(raw, triangle_count, result.pairs);
    default:
      return "answer " + std::to_string(raw.answer) + " is none";
  }
}

}  // namespace

Expected<detector::StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                           bool reports_pairs) {
  if (raw.answer == ASSAY_ERROR) {
    return Problem{raw.message && *raw.message ? raw.message : "an error without a message"};
  }
  if (!reports_pairs && raw.pair_count > 0) {
    return Problem{"gives pairs, and says that it reports none"};
  }
  detector::StepResult result;
  std::string broken = read_result(raw, triangle_count, result);
  if (!broken.empty()) return Problem{std::move(broken)};
  return result;
}

QueryAnswer query_answer(std::int32_t code, const assay_query_result& raw) {
  if (code == ASSAY_OUT_OF_MEMORY) return {Answer::undecided, {}, "out of memory"};
  if (code != ASSAY_OK) return {Answer::error, {}, "query returned " + std::to_string(code)};
  assay_result alike = {};
  alike.answer = raw.answer;
  alike.first_lo = raw.first_lo;
  alike.first_hi = raw.first_hi;
  const auto result = step_result(alike, 0);
  if (!result) return {Answer::error, {}, result.error().message};
  return {result.value().answer, result.value().first, ""};
}

Expected<std::vector<detector::TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                              std::int32_t triangle_count) {
  const auto broken = [](std::string explanation) { return Problem{std::move(explanation)}; };
  if (raw.pair_count > 0 && !raw.pairs) return broken("candidates are counted but not given");
  std::vector<detector::TrianglePair> pairs;
  for (std::uint64_t i = 0; i < raw.pair_count; ++i) {
    detector::TrianglePair pair;
    if (!read_pair(raw.pairs + 2 * i, triangle_count, pair))
      return broken("candidate " + std::to_string(i) + " names no two triangles");
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace assay::properties
