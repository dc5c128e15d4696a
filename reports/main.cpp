// The command line. Options are checked in verb_options_*.cpp; the verbs are in *_command.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>
#include <system_error>
#include <thread>

#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/exit_code.h"
#include "reports/verb_options.h"

namespace {

using namespace assay;

int run(int argc, char** argv) {
  CLI::App app(
      "Assay certifies continuous self-collision detectors for deforming triangle meshes.");
  app.set_version_flag("--version", [] { return reports::version_text(); });
  app.require_subcommand(1);

  reports::CheckRequest check;
  reports::CheckQueriesRequest queries;
  reports::SceneRequest scene;
  reports::CertifyRequest certify;
  reports::SelfTestRequest self_test;
  reports::RunCommandRequest campaign;
  reports::ReplayRequest replay;
  reports::ShrinkRequest shrink;
  reports::BenchRequest bench;
  reports::MergeRequest merge;
  reports::VerifyRequest verify;
  reports::ReportRequest report;
  reports::ListRequest list;
  check.jobs = certify.jobs = self_test.jobs = campaign.jobs =
      static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  reports::add_check(app, check);
  reports::add_check_queries(app, queries);
  reports::add_scene(app, scene);
  reports::add_self_test(app, self_test);
  reports::add_run(app, campaign);
  reports::add_replay(app, replay);
  reports::add_shrink(app, shrink);
  reports::add_bench(app, bench);
  reports::add_report(app, report);
  reports::add_merge(app, merge);
  reports::add_verify(app, verify);
  reports::add_list(app, list);
  reports::add_certify(app, certify);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    const int code = app.exit(asked, text, text);
    fmt::print("{}", text.str());
    return code;
  } catch (const CLI::ParseError& wrong) {
    const std::string first = argc > 1 ? argv[1] : "";
    const auto verbs =
        app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == first; });
    const bool is_verb = !verbs.empty();
    return reports::refuse((first.empty() || first[0] == '-' || is_verb
                                ? std::string(wrong.what())
                                : fmt::format("unknown verb '{}'", first)) +
                           " (assay --help lists verbs and options)");
  }
  if (app.got_subcommand("check")) return reports::run_check(check);
  if (app.got_subcommand("check-queries")) return reports::run_check_queries(queries);
  if (app.got_subcommand("scene")) return reports::run_scene(scene);
  if (app.got_subcommand("certify")) return reports::run_certify(certify);
  if (app.got_subcommand("run")) return reports::run_campaign(campaign);
  if (app.got_subcommand("self-test")) return reports::run_self_test(self_test);
  if (app.got_subcommand("replay")) return reports::run_replay(replay);
  if (app.got_subcommand("verify")) return reports::run_verify(verify);
  if (app.got_subcommand("merge")) return reports::run_merge(merge);
  if (app.got_subcommand("bench")) return reports::run_bench(bench);
  if (app.got_subcommand("shrink")) return reports::run_shrink(shrink);
  if (app.got_subcommand("report")) return reports::run_report(report);
  return reports::run_list(list);
}

}  // namespace

int main(int argc, char** argv) {
  // CGAL's modular gcd remarks on unlucky primes there; this program prints through stdio.
  std::cout.setstate(std::ios_base::badbit);
  try {
    const int code = run(argc, argv);
    return reports::output_was_written() ? code : reports::exit_usage;
  } catch (const std::bad_alloc&) {
    return reports::refuse("not enough memory for this input");
  } catch (const std::system_error& failure) {
    return reports::refuse(failure.what());
  } catch (const std::exception& failure) {
    reports::refuse(failure.what());
    return reports::exit_unsound;
  }
}
