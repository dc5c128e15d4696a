#include <algorithm>
#include <cstddef>
#include <cstring>

#include "properties/words.h"
#include "properties/worker/plugin/plugin_host.h"

namespace assay::properties {

namespace {

constexpr std::uint32_t first_version = 1;

// Returns how much of the table a version has, and how much of the description.
std::size_t table_bytes(std::uint32_t version) {
  if (version == 1) return offsetof(assay_detector_api, use_threads);
  return version == 2 ? offsetof(assay_detector_api, count) : sizeof(assay_detector_api);
}
std::size_t description_bytes(std::uint32_t version) {
#define ASSAY_MEMBER(kind, name, since) \
  if (version < since) return offsetof(assay_description, name);
  ASSAY_CONTRACT_MEMBERS(ASSAY_MEMBER)
#undef ASSAY_MEMBER
  return sizeof(assay_description);
}

Problem breach(std::string explanation) { return {std::move(explanation)}; }

std::string gap_in(const assay_detector_api& table) {
  if (!table.describe) return "a function is missing in its table: describe";
  const bool any = table.evaluate || table.commit || table.result;
  const bool all = table.evaluate && table.commit && table.result;
  if (any != all) return "a function is missing in its table: evaluate, commit or result";
  if (!all && !table.query && !table.candidates && !table.limit)
    return "its table has no function to judge";
  const bool needs_handle = all || table.candidates || table.limit;
  if (needs_handle && !(table.create && table.destroy))
    return "a function is missing in its table: create or destroy";
  if (table.count && !needs_handle) return "its table has count, but no function for steps";
  return "";
}

std::string nothing_described(const assay_detector_api& table) {
  const std::string text = text_of_error(table);
  return text.empty() ? "describe() returns nothing" : "describe(): " + text;
}

// Names the part of the description that makes no sense; empty if all of it does.
std::string read_contract(const assay_description& raw, Contract& contract) {
  std::string unknown;
  visit_members(raw, contract, [&]<class T>(const char* name, const auto& value, T& member) {
    if constexpr (Listed<T>) {
      const auto name_value = from_number<T>(value);
      member = name_value.value_or(member);
      if (!name_value && unknown.empty())
        unknown = std::string("unknown ") + name + " " + std::to_string(value);
    } else {
      member = value;
    }
  });
  if (!unknown.empty()) return unknown;
  return fault_of(contract);
}

}  // namespace

std::string line_of(const char* text) {
  constexpr std::size_t longest = 1000;
  if (!text) return "";
  std::string line(text, ::strnlen(text, longest));
  std::ranges::replace_if(
      line, [](char c) { return 0 < c && c < ' '; }, ' ');
  return printable(line);
}

std::string text_of_error(const assay_detector_api& table) {
  return line_of(table.error_text ? table.error_text() : nullptr);
}

Problem refused_by_capacity(const std::string& text) {
  return {name_of(RunEnd::beyond_capacity) + (text.empty() ? "" : ": " + text),
          ProblemKind::beyond_capacity};
}

std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code) {
  const std::string text = text_of_error(table);
  return std::string(function) + " returned " + std::to_string(code) +
         (text.empty() ? "" : ": " + text);
}

Expected<assay_detector_api> read_table(const assay_detector_api* api) {
  if (!api) return Problem{"not a detector plug-in: assay_detector() returns nothing"};
  const std::uint32_t version = api->abi_version;
  if (version < first_version || version > ASSAY_DETECTOR_ABI_VERSION) {
    return Problem{"built for ABI version " + std::to_string(version) + ", this program accepts " +
                   std::to_string(first_version) + " to " +
                   std::to_string(ASSAY_DETECTOR_ABI_VERSION)};
  }
  assay_detector_api table = {};
  std::memcpy(&table, api, table_bytes(version));
  if (auto gap = gap_in(table); !gap.empty()) return breach(std::move(gap));
  return table;
}

Expected<PluginDescription> read_description(const assay_detector_api& table) {
  const assay_description* raw_description = table.describe();
  if (!raw_description) return breach(nothing_described(table));
  assay_description raw = {};
  std::memcpy(&raw, raw_description, description_bytes(table.abi_version));
  Claims claims;
  for (const auto& row : all_rows<Claim>)
    if (row.since <= table.abi_version) claims = claims.with(Claims::of_bits(row.bit));
  if (raw.claims & ~claims.bits()) return breach("unknown bits in its claims");

  const PluginParts parts = {table.evaluate != nullptr, table.query != nullptr,
                             table.candidates != nullptr, table.limit != nullptr,
                             table.use_threads != nullptr};
  auto description = described(raw, parts);
  if (description) description.value().contract.takes_relations = table.count != nullptr;
  return description;
}

Expected<PluginDescription> described(const assay_description& raw, const PluginParts& parts) {
  if (raw.claims & ~claims_from_outside.bits()) return breach("unknown bits in its claims");
  PluginDescription description;
  if (auto fault = read_contract(raw, description.contract); !fault.empty())
    return breach(std::move(fault));
  description.name = line_of(raw.name);
  description.version = line_of(raw.version);
  if (description.name.empty()) return breach("it has no name");
  for (const auto& text : {description.name, description.version}) {
    if (const auto fault = fault_of_name(text); !fault.empty()) return breach("it has " + fault);
  }
  description.claims = Claims::of_bits(raw.claims);
  description.parts = parts;
  if (description.claims.has(Claim::candidates) && !description.parts.candidates)
    return breach("it claims candidates, but has no function for candidates");
  if (description.parts.candidates && !description.claims.has(Claim::candidates))
    return breach("it has a function for candidates, but does not claim candidates");
  if (const auto fault =
          fault_of_limits(description.claims, description.contract, description.parts.limit);
      !fault.empty())
    return breach("it has " + fault);
  if (description.parts.query && description.claims.empty())
    return breach("it has a function for queries, but claims nothing");
  return description;
}

namespace {

bool is_interval(const TimeEnclosure& time) {
  return 0 <= time.lo && time.lo <= time.hi && time.hi <= 1;  // false for a NaN
}

// Returns false if the numbers are no pair of triangles of this mesh.
bool read_pair(const std::int32_t* raw, std::int32_t triangle_count, TrianglePair& pair) {
  pair = {std::min(raw[0], raw[1]), std::max(raw[0], raw[1])};
  return 0 <= pair.a && pair.a < pair.b && pair.b < triangle_count;
}

std::string numbers_of(const TimeEnclosure& time) {
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
  std::ranges::sort(pairs, [](const PairContact& a, const PairContact& b) {
    return a.pair != b.pair ? a.pair < b.pair : a.time < b.time;
  });
  const auto same_pair = [](const PairContact& a, const PairContact& b) {
    return a.pair == b.pair;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same_pair), pairs.end());
  return "";
}

// Computes where a caller stops that computes in this format, with one rounding for each operation.
// Share 1 is x_t1.
template <class Real>
void stop_at(double share, LimitGives gives, const Positions& x_t0, const Positions& x_t1,
             const Positions* displacement, Positions& stop) {
  if (share == 1) return;
  const auto part = static_cast<Real>(share);
  for (Eigen::Index i = 0; i < x_t0.size(); ++i) {
    const auto from = static_cast<Real>(x_t0.data()[i]), to = static_cast<Real>(x_t1.data()[i]);
    const Real way = displacement ? static_cast<Real>(displacement->data()[i]) : to - from;
    const Real at = gives == LimitGives::blend
                        ? static_cast<Real>(static_cast<Real>(1 - part) * from) + part * to
                        : from + part * way;
    stop.data()[i] = static_cast<double>(at);
  }
}

// REQUIRES that the plug-in does not call it an error. Says which rule is broken; empty if none
// is.
std::string read_result(const assay_result& raw, std::int32_t triangle_count, StepResult& result) {
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
      return "answer " + std::to_string(raw.answer) + " is no answer of the interface";
  }
}

}  // namespace

Expected<StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                 bool reports_pairs) {
  if (raw.answer == ASSAY_ERROR) {
    return Problem{raw.message && *raw.message ? raw.message : "an error without a message"};
  }
  if (raw.answer == ASSAY_BEYOND_CAPACITY) return refused_by_capacity(line_of(raw.message));
  if (!reports_pairs && raw.pair_count > 0) {
    return Problem{"gives pairs, but says that it reports none"};
  }
  StepResult result;
  std::string problem = read_result(raw, triangle_count, result);
  if (!problem.empty()) return Problem{std::move(problem)};
  return result;
}

Expected<LimitAnswer> limit_answer(const assay_limit& raw, const Claims& claims,
                                   const Contract& contract, const Positions& x_t0,
                                   const Positions& x_t1, const Positions& way) {
  const bool has_share = raw.share != -1;
  if (has_share && !(raw.share >= 0 && raw.share <= 1))
    return Problem{"its share " + number_text(raw.share) + " is not from 0 to 1"};
  if (!has_share && claims.has_any({Claim::path_free, Claim::progress}))
    return Problem{"it states no share, but claims path-free or progress"};
  LimitAnswer limit{raw.share, x_t1};
  if (raw.positions) {
    limit.positions = Eigen::Map<const Positions>(raw.positions, x_t0.rows(), 3);
  } else if (!has_share || contract.limit_gives == LimitGives::positions) {
    return Problem{"it gives no positions, and no share from which they could be computed"};
  } else if (contract.coordinates == Coordinates::float32) {
    stop_at<float>(raw.share, contract.limit_gives, x_t0, x_t1,
                   contract.motion == MotionGiven::displacement ? &way : nullptr, limit.positions);
  } else {
    stop_at<double>(raw.share, contract.limit_gives, x_t0, x_t1, nullptr, limit.positions);
  }
  if (!limit.positions.allFinite()) return Problem{"it allows positions that are not finite"};
  return limit;
}

Expected<std::vector<TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                    std::int32_t triangle_count) {
  if (raw.pair_count > 0 && !raw.pairs) return breach("candidates are counted but not given");
  std::vector<TrianglePair> pairs;
  for (std::uint64_t i = 0; i < raw.pair_count; ++i) {
    TrianglePair pair;
    if (!read_pair(raw.pairs + 2 * i, triangle_count, pair))
      return breach("candidate " + std::to_string(i) + " names no two triangles");
    pairs.push_back(pair);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace assay::properties
