// A Problem is what kept this room from doing what it was asked, as a value: a named kind, for
// code that tells problems apart, and one line for the user. The only exception that leaves this
// room is std::bad_alloc.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <cstdint>
#include <string>
#include <string_view>

namespace assay::properties {

// The numbers are stable. Add new kinds at the end.
enum class ProblemKind : std::uint8_t {
  // Files and folders.
  not_found = 1,     // there is no such file
  cannot_read = 2,   // the system does not open, list or read it
  cannot_write = 3,  // the disk is full, or the file or folder may not be written
  busy = 4,          // another process is writing the file

  // The stores of a run.
  no_run = 5,          // a folder in which no run is stored
  foreign_file = 6,    // a file that is not the store of a run
  other_schema = 7,    // a store in a form that this build does not read
  damaged_store = 8,   // a store that was cut or changed: it holds what no run stores
  another_run = 9,     // of another plan, seed, shard, detector or build than the rest
  contradiction = 10,  // two stores say different things of one trial, failure or evidence
  wrong_shards = 11,   // a shard that is there twice, or of another number of shards
  stale_merge = 12,    // beside a merged store lies a shard that holds more
  wrong_plan = 13,     // a file that is not the plan of a campaign

  // The proof of planted faults that a run takes from another run.
  no_proof_needed = 14,   // the campaign plants no faults
  proof_in_the_way = 15,  // the proof lies in the folder that the run writes
  another_build = 16,     // the proof, or the worker, is of another build than this program
  weak_proof = 17,        // the run does not prove what the campaign asks for

  // Cases, workers and plug-ins.
  unknown_option = 18,      // a case states an option, or a word for it, that is none
  cannot_start = 19,        // a process that the system does not start
  not_a_plugin = 20,        // a library that does not load, or exports no assay_detector()
  other_abi_version = 21,   // a plug-in that was built for another version of the interface
  broken_plugin = 22,       // a gap in its table of functions, or a senseless description
  ended_while_loaded = 23,  // the worker ended while it loaded the plug-in
  hung_while_loaded = 24,   // the worker was given up while it loaded the plug-in
  step_failed = 25,         // a plug-in says itself that it could not answer a step
  broken_result = 26,       // a result that breaks the rules of the plug-in interface
  out_of_memory = 27,

  // The rows of a store.
  changed_row = 28,    // a row that does not fit its own hash: the disk or somebody changed it
  not_as_stored = 29,  // a row that is not as this process stored it, or found it when it began

  // What a plug-in is up to.
  broken_reply = 30,  // a worker sent what no worker sends: its plug-in meddles
  not_isolated = 31,  // isolation is required, and the system does not offer it
};
inline constexpr ProblemKind last_problem_kind = ProblemKind::not_isolated;

// The enumerator's name, for reports and tests.
std::string_view name_of(ProblemKind kind);

struct Problem {
  ProblemKind kind = ProblemKind::cannot_read;
  std::string message;  // one line, for a user; names the file where there is one
};

// A value or a Problem. Asking for the side that is not there ends the program.
template <class T>
using Expected = boost::outcome_v2::basic_result<T, Problem, boost::outcome_v2::policy::terminate>;

}  // namespace assay::properties
