// The command line. Options are checked in verb_options_*.cpp; the verbs are in *_command.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "reports/terminal/complaint.h"
#include "reports/terminal/exit_code.h"
#include "reports/verbs/commands.h"
#include "reports/verbs/verb_options.h"

namespace {

using namespace assay;

// Each verb with its request, which holds what was said on the command line.
class Verbs {
 public:
  explicit Verbs(CLI::App& app) : app_(app) {}

  template <class Request>
  void add(void (*add_options)(CLI::App&, Request&), int (*run)(const Request&)) {
    auto request = std::make_shared<Request>();
    if constexpr (requires { request->jobs; }) {
      request->jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    }
    add_options(app_, *request);
    runs_.push_back([request, run] { return run(*request); });
  }

  int run_chosen() const {
    const auto all = app_.get_subcommands({});
    const auto chosen =
        std::find_if(all.begin(), all.end(), [](auto* verb) { return verb->parsed(); });
    return runs_[static_cast<std::size_t>(chosen - all.begin())]();
  }

 private:
  CLI::App& app_;
  std::vector<std::function<int()>> runs_;  // in the order of the verbs
};

int run(int argc, char** argv) {
  CLI::App app(
      "Assay certifies continuous self-collision detectors for deforming triangle meshes.");
  app.set_version_flag("--version", [] { return reports::version_text(); });
  app.require_subcommand(1);

  Verbs verbs(app);
  verbs.add(reports::add_check, reports::run_check);
  verbs.add(reports::add_check_queries, reports::run_check_queries);
  verbs.add(reports::add_scene, reports::run_scene);
  verbs.add(reports::add_self_test, reports::run_self_test);
  verbs.add(reports::add_run, reports::run_campaign);
  verbs.add(reports::add_replay, reports::run_replay);
  verbs.add(reports::add_shrink, reports::run_shrink);
  verbs.add(reports::add_bench, reports::run_bench);
  verbs.add(reports::add_report, reports::run_report);
  verbs.add(reports::add_merge, reports::run_merge);
  verbs.add(reports::add_verify, reports::run_verify);
  verbs.add(reports::add_list, reports::run_list);
  verbs.add(reports::add_certify, reports::run_certify);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    const int code = app.exit(asked, text, text);
    fmt::print("{}", text.str());
    return code;
  } catch (const CLI::ParseError& wrong) {
    const std::string first = argc > 1 ? argv[1] : "";
    const auto known =
        app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == first; });
    const bool is_verb = !known.empty();
    return reports::refuse((first.empty() || first[0] == '-' || is_verb
                                ? std::string(wrong.what())
                                : fmt::format("unknown verb '{}'", first)) +
                           " (assay --help lists verbs and options)");
  }
  return verbs.run_chosen();
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
