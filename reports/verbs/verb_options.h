// The options of the verbs: what the command line says goes into the verb's request; what is wrong
// in it is refused in one clear line. The groups are in verb_options_check, _campaign and _bench.
#pragma once

#include <CLI/CLI.hpp>

#include "reports/verbs/commands.h"

namespace assay::reports {

// Each request holds the defaults, and has to outlive the parsing.
void add_check(CLI::App& app, CheckRequest& request);
void add_check_queries(CLI::App& app, CheckQueriesRequest& request);
void add_self_test(CLI::App& app, SelfTestRequest& request);
void add_certify(CLI::App& app, CertifyRequest& request);
void add_run(CLI::App& app, RunCommandRequest& request);
void add_replay(CLI::App& app, ReplayRequest& request);
void add_shrink(CLI::App& app, ShrinkRequest& request);
void add_merge(CLI::App& app, MergeRequest& request);
void add_verify(CLI::App& app, VerifyRequest& request);
void add_report(CLI::App& app, ReportRequest& request);
void add_list(CLI::App& app, ListRequest& request);
void add_scene(CLI::App& app, SceneRequest& request);
void add_bench(CLI::App& app, BenchRequest& request);

}  // namespace assay::reports
