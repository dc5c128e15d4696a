// What travels between the host and its worker, field by field. A new field of a result or an
// option does not compile here until it is named: in the binding and in the call below it.
#pragma once

#include <span>

#include "detector/mesh/problem.h"
#include "detector/step_result.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/plugin_description.h"
#include "properties/worker/wire.h"

namespace assay::properties {

template <>
struct TravelsAsBytes<detector::Point> : std::true_type {};
template <>
struct TravelsAsBytes<detector::MovingPoint> : std::true_type {};
template <>
struct TravelsAsBytes<detector::TimeEnclosure> : std::true_type {};
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
struct TravelsAsBytes<Claims> : std::true_type {};
template <>
struct TravelsAsBytes<Contract> : std::true_type {};

template <class Wire>
void fields(Wire& wire, detector::Options& options) {
  auto& [culling, start, pairs, arithmetic, release, ghost_test] = options;
  wire(culling, start, pairs, arithmetic, release, ghost_test);
}

template <class Wire>
void fields(Wire& wire, detector::Problem& problem) {
  auto& [error, message] = problem;
  wire(error, message);
}

template <class Wire>
void fields(Wire& wire, detector::StepResult& result) {
  auto& [answer, problem, first, pairs, positive, negative, zero, against_all, violated, dirty,
         doubts, signs, primitives, apexes, counts, times] = result;
  wire(answer, problem, first, pairs, positive, negative, zero, against_all, violated, dirty,
       doubts, signs, primitives, apexes, counts, times);
}

template <class Wire>
void fields(Wire& wire, CaseRun& run) {
  // The last two are the host's to say.
  auto& [end, what, steps, disturbances, processor_seconds] = run;
  wire(end, what, steps);
}

template <class Wire>
void fields(Wire& wire, Configuration& configuration) {
  auto& [name, options, fault] = configuration;
  wire(name, options, fault);
}

template <class Wire>
void fields(Wire& wire, corpus::CaseView& view) {
  wire(view.q0, view.q1);
}

// Only what a detector may know: never the expected facts.
template <class Wire>
void fields(Wire& wire, corpus::Case& c) {
  wire(c.id, c.triangles, c.frames, c.script, c.view);
}

template <class Wire>
void fields(Wire& wire, PluginDescription& description) {
  auto& [name, version, claims, contract] = description;
  wire(name, version, claims, contract);
}

template <class Wire>
void fields(Wire& wire, Problem& problem) {
  auto& [kind, message] = problem;
  wire(kind, message);
}

// The worker's first message: who it is, or why it cannot serve.
struct Hello {
  std::uint64_t wire_version = 0;
  PluginDescription description;
  bool serves = true;
  Problem problem;  // why it does not
};

template <class Wire>
void fields(Wire& wire, Hello& hello) {
  wire(hello.wire_version, hello.description, hello.serves, hello.problem);
}

// One case and how to run it; a CaseRun comes back for each configuration, in order.
struct RunRequest {
  corpus::Case c;
  std::vector<Configuration> configurations;
};

template <class Wire>
void fields(Wire& wire, RunRequest& request) {
  wire(request.c, request.configurations);
}

template <class... T>
std::string encode(const T&... messages) {
  WireWriter writer;
  // A writer reads only; the lists above serve both directions.
  writer(const_cast<T&>(messages)...);
  return writer.take();
}

template <class T>
bool decode(const std::string& bytes, T& message) {
  WireReader reader(bytes);
  reader(message);
  return reader.complete();
}

// Differs where the two ends were built from sources with other plain data.
constexpr std::uint64_t wire_version() {
  std::uint64_t hash = 1;
  for (const std::size_t size :
       {sizeof(detector::Options), sizeof(detector::StepResult), sizeof(detector::PairContact),
        sizeof(detector::StepCounts), sizeof(detector::StepTimes), sizeof(Claims), sizeof(Contract),
        sizeof(corpus::Case)}) {
    hash = hash * 1099511628211u + size;
  }
  return hash;
}

}  // namespace assay::properties
