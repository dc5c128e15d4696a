// What travels between the host and its worker, field by field. A new field of a result or an
// option does not compile until it is named here.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "corpus/cases/case_file.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/step_result.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/plugin_description.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/wire.h"

namespace assay::properties {

// The relation that counts is the case's, and travels with it.
template <class Wire>
void fields(Wire& wire, detector::Options& options) {
  auto& [culling, start, pairs, arithmetic, threads, counted, separation] = options;
  wire("culling", culling, "start", start, "pairs", pairs, "arithmetic", arithmetic, "threads",
       threads, "separation", separation);
}
ASSAY_FIELDS(detector::Problem, error, message)
ASSAY_FIELDS(detector::StepResult, answer, problem, first, pairs, view_positive, view_negative,
             view_zero, against_all, violated, dirty, views, doubts, signs, primitives, apexes,
             counts, times)
ASSAY_FIELDS(RunTimes, create, steps, peak_bytes)
ASSAY_FIELDS(LimitAnswer, share, positions)

template <class Wire>
void fields(Wire& wire, CaseRun& run) {
  // The last three are the host's to say.
  auto& [end, explanation, steps, candidates, limits, errors, over_capacity, has_answers, times,
         disturbances, processor_seconds, printed] = run;
  wire("end", end, "explanation", explanation, "steps", steps, "candidates", candidates, "limits",
       limits, "errors", errors, "over_capacity", over_capacity, "has_answers", has_answers,
       "times", times);
}

ASSAY_FIELDS(Configuration, name, options, fault, is_timed, asks_limits)
ASSAY_FIELDS(corpus::CaseView, q0, q1)
ASSAY_FIELDS(detector::CountedPairs, level, body, apart, rings, rest_distance, rest, triangle_pairs,
             vertex_faces, edge_pairs)

// Only what a detector may know travels, and never the expected facts.
template <class Wire>
void fields(Wire& wire, corpus::CaseRelation& relation) {
  wire("pairs", relation.pairs);
}
template <class Wire>
void fields(Wire& wire, corpus::Case& c) {
  std::string query = query_word(c);
  wire("id", c.id, "triangles", c.triangles, "frames", c.frames, "script", c.script, "view", c.view,
       "counted", c.counted, "query", query);
  if (query != query_word(c)) say_query(c, query);  // a writer changes nothing
}

template <class Wire>
void fields(Wire& wire, Claims& claims) {
  std::uint32_t bits = claims.bits();
  wire("bits", bits);
  claims = Claims::of_bits(bits);
}

ASSAY_FIELDS(PluginParts, steps, query, candidates, limit, takes_threads)
ASSAY_FIELDS(PluginDescription, name, version, claims, contract, parts)

// The worker's first message: who it is, or why it cannot serve.
struct Hello {
  std::uint64_t wire_version = 0;
  PluginDescription description;
  bool serves = true;
  std::string refusal;  // why it does not
};
ASSAY_FIELDS(Hello, wire_version, description, serves, refusal)

// Cases and how to run them. A RunReply comes back for each configuration of the first case, in
// order, then for those of the next.
struct RunRequest {
  std::uint64_t number = 0;  // drawn for this request
  std::vector<corpus::Case> cases;
  std::vector<Configuration> configurations;
};
ASSAY_FIELDS(RunRequest, number, cases, configurations)

struct RunReply {
  std::uint64_t number = 0;  // of the request
  std::uint64_t place = 0;   // of the run in it
  CaseRun run;
};
ASSAY_FIELDS(RunReply, number, place, run)

template <class... T>
std::string encode(const T&... messages) {
  WireWriter writer;
  // A writer does not change the messages; the lists above are not const because readers use them
  // too.
  (writer.field("", const_cast<T&>(messages)), ...);
  return writer.take();
}

template <class T>
bool decode(const std::string& bytes, T& message) {
  WireReader reader(bytes);
  reader.field("", message);
  return reader.complete();
}

// Differs if the two ends were built from sources with other plain data.
constexpr std::uint64_t wire_version() {
  std::uint64_t hash = 1;
  for (const std::size_t size :
       {sizeof(detector::Options), sizeof(detector::StepResult), sizeof(detector::PairContact),
        sizeof(detector::StepCounts), sizeof(detector::StepTimes), sizeof(Claims), sizeof(Contract),
        sizeof(corpus::Case), sizeof(detector::CountedPairs)}) {
    hash = hash * 1099511628211u + size;
  }
  return hash;
}

// What a plug-in says is checked where it is read (plugin_reading.h), in its own process. If that
// process damages its own memory, its reply may be none; such a reply counts as a crash.

// Bytes of the longest line of text in a reply.
inline constexpr std::size_t longest_reply_text = 4096;

// The most bytes that a reply to this case may have: that of a reply with every pair of triangles
// in contact in each step, and with positions.
std::uint64_t longest_reply(const corpus::Case& c);
// The most bytes that the first message of a worker may have.
inline constexpr std::uint64_t longest_hello = 4 * longest_reply_text;

// Whether all that the run of a case says is about that case: its steps, triangles and vertices.
bool fits(const CaseRun& run, const corpus::Case& c);

}  // namespace assay::properties
