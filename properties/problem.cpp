#include "properties/problem.h"

namespace assay::properties {

std::string_view name_of(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::not_found:
      return "not_found";
    case ProblemKind::cannot_read:
      return "cannot_read";
    case ProblemKind::cannot_write:
      return "cannot_write";
    case ProblemKind::busy:
      return "busy";
    case ProblemKind::no_run:
      return "no_run";
    case ProblemKind::foreign_file:
      return "foreign_file";
    case ProblemKind::other_schema:
      return "other_schema";
    case ProblemKind::damaged_store:
      return "damaged_store";
    case ProblemKind::another_run:
      return "another_run";
    case ProblemKind::contradiction:
      return "contradiction";
    case ProblemKind::wrong_shards:
      return "wrong_shards";
    case ProblemKind::stale_merge:
      return "stale_merge";
    case ProblemKind::wrong_plan:
      return "wrong_plan";
    case ProblemKind::no_proof_needed:
      return "no_proof_needed";
    case ProblemKind::proof_in_the_way:
      return "proof_in_the_way";
    case ProblemKind::another_build:
      return "another_build";
    case ProblemKind::weak_proof:
      return "weak_proof";
    case ProblemKind::unknown_option:
      return "unknown_option";
    case ProblemKind::cannot_start:
      return "cannot_start";
    case ProblemKind::not_a_plugin:
      return "not_a_plugin";
    case ProblemKind::other_abi_version:
      return "other_abi_version";
    case ProblemKind::broken_plugin:
      return "broken_plugin";
    case ProblemKind::ended_while_loaded:
      return "ended_while_loaded";
    case ProblemKind::hung_while_loaded:
      return "hung_while_loaded";
    case ProblemKind::step_failed:
      return "step_failed";
    case ProblemKind::broken_result:
      return "broken_result";
    case ProblemKind::out_of_memory:
      return "out_of_memory";
    case ProblemKind::changed_row:
      return "changed_row";
    case ProblemKind::not_as_stored:
      return "not_as_stored";
    case ProblemKind::broken_reply:
      return "broken_reply";
    case ProblemKind::not_isolated:
      return "not_isolated";
  }
  return "unnamed";
}

}  // namespace assay::properties
