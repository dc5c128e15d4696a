// What travels between the host and its worker, field by field. A new field of a result or an
// option does not compile here until it is named: in the binding and in the call below it.
#pragma once

#include <span>

#include "detector/contact/four_points.h"
#include "detector/mesh/problem.h"
#include "detector/step_result.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/isolation/keeper.h"
#include "properties/worker/plugin/plugin_description.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/wire.h"

namespace assay::properties {

template <>
struct TravelsAsBytes<detector::Point> : std::true_type {};
template <>
struct TravelsAsBytes<detector::MovingPoint> : std::true_type {};
template <>
struct TravelsAsBytes<detector::FourPoints> : std::true_type {};
template <>
struct TravelsAsBytes<detector::TimeEnclosure> : std::true_type {};
template <>
struct TravelsAsBytes<detector::TrianglePair> : std::true_type {};
template <>
struct TravelsAsBytes<detector::PairContact> : std::true_type {};
template <>
struct TravelsAsBytes<detector::ViewPrimitive> : std::true_type {};
template <>
struct TravelsAsBytes<detector::StepCounts> : std::true_type {};
template <>
struct TravelsAsBytes<detector::StepTimes> : std::true_type {};
template <>
struct TravelsAsBytes<corpus::CaseStep> : std::true_type {};
template <>
inline constexpr RunEnd last_of<RunEnd> = RunEnd::not_run;
template <>
inline constexpr Adjacency last_of<Adjacency> = Adjacency::no_shared_vertex;
template <>
inline constexpr Coordinates last_of<Coordinates> = Coordinates::float32;
template <>
inline constexpr StartRule last_of<StartRule> = StartRule::apart;
template <>
inline constexpr TestedFeatures last_of<TestedFeatures> = TestedFeatures::edge_edge;

template <class Wire>
void fields(Wire& wire, detector::Options& options) {
  auto& [culling, start, pairs, arithmetic, threads] = options;
  wire(culling, start, pairs, arithmetic, threads);
}

template <class Wire>
void fields(Wire& wire, detector::Problem& problem) {
  auto& [error, message] = problem;
  wire(error, message);
}

template <class Wire>
void fields(Wire& wire, detector::StepResult& result) {
  auto& [answer, problem, first, pairs, positive, negative, zero, against_all, violated, dirty,
         views, doubts, signs, primitives, apexes, counts, times] = result;
  wire(answer, problem, first, pairs, positive, negative, zero, against_all, violated, dirty, views,
       doubts, signs, primitives, apexes, counts, times);
}

template <class Wire>
void fields(Wire& wire, RunTimes& times) {
  auto& [create, steps, peak_bytes] = times;
  wire(create, steps, peak_bytes);
}

template <class Wire>
void fields(Wire& wire, CaseRun& run) {
  // The last three are the host's to say.
  auto& [end, explanation, steps, candidates, errors, has_answers, times, disturbances,
         processor_seconds, printed] = run;
  wire(end, explanation, steps, candidates, errors, has_answers, times);
}

template <class Wire>
void fields(Wire& wire, Configuration& configuration) {
  auto& [name, options, fault, is_timed] = configuration;
  wire(name, options, fault, is_timed);
}

template <class Wire>
void fields(Wire& wire, corpus::CaseView& view) {
  wire(view.q0, view.q1);
}

// Only what a detector may know travels, and never the expected facts.
template <class Wire>
void fields(Wire& wire, corpus::Case& c) {
  wire(c.id, c.triangles, c.frames, c.script, c.view);
}

template <class Wire>
void fields(Wire& wire, Claims& claims) {
  auto& [free_sound, not_late, first_time, first_pairs, all_pairs, no_spurious, deterministic,
         total, candidates] = claims;
  wire(free_sound, not_late, first_time, first_pairs, all_pairs, no_spurious, deterministic, total,
       candidates);
}

template <class Wire>
void fields(Wire& wire, Contract& contract) {
  auto& [adjacency, coordinates, margin, start, start_distance, least_nonzero, largest, features,
         time_tolerance, reports_pairs] = contract;
  wire(adjacency, coordinates, margin, start, start_distance, least_nonzero, largest, features,
       time_tolerance, reports_pairs);
}

template <class Wire>
void fields(Wire& wire, Isolation& isolation) {
  auto& [files, processes, calls] = isolation;
  wire(files, processes, calls);
}

template <class Wire>
void fields(Wire& wire, KeeperHello& hello) {
  wire(hello.wire_version, hello.isolation, hello.process, hello.has_copies);
}

template <class Wire>
void fields(Wire& wire, PluginDescription& description) {
  auto& [name, version, claims, contract, parts] = description;
  auto& [steps, query, candidates, takes_threads] = parts;
  wire(name, version, claims, contract, steps, query, candidates, takes_threads);
}

// The worker's first message: who it is, or why it cannot serve.
struct Hello {
  std::uint64_t wire_version = 0;
  PluginDescription description;
  bool serves = true;
  std::string refusal;  // why it does not
};

template <class Wire>
void fields(Wire& wire, Hello& hello) {
  wire(hello.wire_version, hello.description, hello.serves, hello.refusal);
}

// What a request asks for.
enum class RequestKind : std::uint8_t { run, queries };
template <>
inline constexpr RequestKind last_of<RequestKind> = RequestKind::queries;

// One case and how to run it; a RunReply comes back for each configuration, in order.
struct RunRequest {
  std::uint64_t number = 0;  // drawn for this request
  corpus::Case c;
  std::vector<Configuration> configurations;
};

template <class Wire>
void fields(Wire& wire, RunRequest& request) {
  wire(request.number, request.c, request.configurations);
}

struct RunReply {
  std::uint64_t number = 0;  // of the request
  std::uint64_t place = 0;   // of the configuration in it
  CaseRun run;
};

template <class Wire>
void fields(Wire& wire, RunReply& reply) {
  wire(reply.number, reply.place, reply.run);
}

// Elementary queries of a plug-in; one QueryReply comes back for all.
struct QueryRequest {
  std::uint64_t number = 0;  // drawn for this request
  std::vector<detector::FourPoints> queries;
};

template <class Wire>
void fields(Wire& wire, QueryRequest& request) {
  wire(request.number, request.queries);
}

template <class Wire>
void fields(Wire& wire, QueryAnswer& answer) {
  auto& [answered, first, explanation] = answer;
  wire(answered, first, explanation);
}

struct QueryReply {
  std::uint64_t number = 0;          // of the request
  std::vector<QueryAnswer> answers;  // one for each query
};

template <class Wire>
void fields(Wire& wire, QueryReply& reply) {
  wire(reply.number, reply.answers);
}

// What a worker receives: one of the two.
struct Request {
  RequestKind kind = RequestKind::run;
  RunRequest run;
  QueryRequest query;
};

template <class Wire>
void fields(Wire& wire, Request& request) {
  wire(request.kind);
  if (request.kind == RequestKind::run) {
    wire(request.run);
  } else {
    wire(request.query);
  }
}

template <class... T>
std::string encode(const T&... messages) {
  WireWriter writer;
  // A writer does not change the messages; the lists above are not const because readers use them
  // too.
  writer(const_cast<T&>(messages)...);
  return writer.take();
}

template <class T>
bool decode(const std::string& bytes, T& message) {
  WireReader reader(bytes);
  reader(message);
  return reader.complete();
}

// Differs if the two ends were built from sources with other plain data.
constexpr std::uint64_t wire_version() {
  std::uint64_t hash = 1;
  for (const std::size_t size :
       {sizeof(detector::Options), sizeof(detector::StepResult), sizeof(detector::PairContact),
        sizeof(detector::StepCounts), sizeof(detector::StepTimes), sizeof(Claims), sizeof(Contract),
        sizeof(corpus::Case), sizeof(detector::FourPoints), sizeof(QueryAnswer)}) {
    hash = hash * 1099511628211u + size;
  }
  return hash;
}

}  // namespace assay::properties
