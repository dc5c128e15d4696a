// The verbs of the command line.
//
// There is one file for each verb: NAME_command.cpp holds what is asked of it (its request), its
// options and what it does, so that a new option is a change of one file.
#pragma once

#include "reports/terminal/option_words.h"

namespace assay::reports {

// Each function adds its verb, with all its options, to the command line.
Action add_answer_vectors(CLI::App& app);
Action add_bench(CLI::App& app);
Action add_certify(CLI::App& app);
Action add_check(CLI::App& app);
Action add_check_queries(CLI::App& app);
Action add_judge(CLI::App& app);
Action add_list(CLI::App& app);
Action add_merge(CLI::App& app);
Action add_replay(CLI::App& app);
Action add_report(CLI::App& app);
Action add_run(CLI::App& app);
Action add_scene(CLI::App& app);
Action add_score(CLI::App& app);
Action add_self_test(CLI::App& app);
Action add_shrink(CLI::App& app);
Action add_vectors(CLI::App& app);
Action add_verify(CLI::App& app);
Action add_verify_vectors(CLI::App& app);

}  // namespace assay::reports
