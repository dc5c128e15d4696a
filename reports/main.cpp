// The command line. It finds the verb, and turns what goes wrong into one line and an exit code.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>
#include <vector>

#include "oracle/libraries.h"
#include "properties/words.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace {

using namespace assay;

// The verbs, in the order of `assay --help`.
constexpr reports::Action (*verbs[])(CLI::App&) = {
    reports::add_check,          reports::add_judge,          reports::add_check_queries,
    reports::add_scene,          reports::add_self_test,      reports::add_run,
    reports::add_replay,         reports::add_shrink,         reports::add_bench,
    reports::add_report,         reports::add_merge,          reports::add_verify,
    reports::add_list,           reports::add_certify,        reports::add_vectors,
    reports::add_verify_vectors, reports::add_answer_vectors, reports::add_score};

// CLI11 lists what it did not expect from the end.
std::string complaint_of(const CLI::ParseError& wrong, const CLI::App& app) {
  if (dynamic_cast<const CLI::ExtrasError*>(&wrong) == nullptr) return wrong.what();
  return fmt::format("not expected: {}", fmt::join(app.remaining(true), " "));
}

std::string meant_by(const std::string& word, CLI::App& app) {
  for (const auto* verb : app.get_subcommands({})) {
    if (properties::is_nearly(verb->get_name(), word))
      return fmt::format("; did you mean {}?", verb->get_name());
  }
  return "";
}

int run(int argc, char** argv) {
  CLI::App app(
      "Assay certifies continuous self-collision detectors for deforming triangle meshes.");
  app.set_version_flag("--version", [] { return reports::version_text(); });
  app.require_subcommand(1);

  std::vector<reports::Action> actions;
  for (const auto add_verb : verbs) actions.push_back(add_verb(app));

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
    if (known.empty()) {
      const bool is_word = !first.empty() && first[0] != '-';
      return reports::refuse((is_word
                                  ? fmt::format("unknown verb '{}'{}", first, meant_by(first, app))
                                  : complaint_of(wrong, app)) +
                             " (assay --help lists verbs)");
    }
    return reports::refuse(
        fmt::format("{} (assay {} --help lists options)", complaint_of(wrong, app), first));
  }
  const auto all = app.get_subcommands({});
  const auto chosen =
      std::find_if(all.begin(), all.end(), [](auto* verb) { return verb->parsed(); });
  return actions[static_cast<std::size_t>(chosen - all.begin())]();
}

// The program may end at once, because a store is whole at any moment.
constexpr const char* no_memory = "not enough memory for this input";

// Some destructors allocate, such as those of nlohmann-json. Where they find no memory while the
// exception that says so is on its way, the program would be ended by std::terminate. So there is
// some memory for them alone.
std::atomic<void*> memory_for_destructors = nullptr;
void find_memory() {
  void* const kept =
      std::uncaught_exceptions() > 0 ? memory_for_destructors.exchange(nullptr) : nullptr;
  if (!kept) throw std::bad_alloc();
  std::free(kept);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::size_t bytes_for_destructors = std::size_t{1} << 20;
  memory_for_destructors = std::malloc(bytes_for_destructors);
  std::set_new_handler(find_memory);
  // If a file exceeds a limit of the user, the call that writes it fails, and the program is not
  // ended by a signal.
  ::signal(SIGXFSZ, SIG_IGN);
  oracle::end_without_memory([] { ::_exit(reports::refuse(no_memory)); });
  // The modular gcd of CGAL prints remarks on unlucky primes to std::cout, so that is closed. This
  // program prints through stdio.
  std::cout.setstate(std::ios_base::badbit);
  try {
    const int code = run(argc, argv);
    return reports::output_was_written() ? code : reports::exit_usage;
  } catch (const std::bad_alloc&) {
    return reports::refuse(no_memory);
  } catch (const std::system_error& failure) {
    return reports::refuse(failure.what());
  } catch (const std::exception& failure) {
    reports::refuse(failure.what());
    return reports::exit_unsound;
  }
}
