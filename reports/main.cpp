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
#include <system_error>
#include <vector>

#include "corpus/meant_word.h"
#include "oracle/libraries.h"
#include "reports/manual/help_text.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace {

using namespace assay;

// The verbs, in the order of `assay help`.
constexpr reports::AddedVerb (*verbs[])(CLI::App&) = {
    reports::add_check,   reports::add_judge,          reports::add_check_queries,
    reports::add_run,     reports::add_certify,        reports::add_bench,
    reports::add_list,    reports::add_replay,         reports::add_shrink,
    reports::add_verify,  reports::add_report,         reports::add_merge,
    reports::add_vectors, reports::add_verify_vectors, reports::add_answer_vectors,
    reports::add_score,   reports::add_scene,          reports::add_self_test};

using Words = std::vector<std::string>;
using Manuals = std::vector<reports::VerbManual>;

int refuse_verb(const std::string& word, const Manuals& manuals) {
  return reports::refuse(fmt::format("unknown verb '{}'{} (assay help lists verbs)", word,
                                     corpus::did_you_mean(corpus::names_among(manuals), word)));
}

// `help`, `help VERB`.
int help(const Words& words, const Manuals& manuals) {
  if (words.empty()) {
    fmt::print("{}", reports::help_text(manuals));
    return reports::exit_holds;
  }
  const auto asked = std::ranges::find(manuals, words[0], &reports::VerbManual::name);
  if (asked == manuals.end()) return refuse_verb(words[0], manuals);
  fmt::print("{}", reports::help_text(*asked));
  return reports::exit_holds;
}

// One line that says what is wrong with the words of a verb. What was not expected goes first:
// where an option is misspelt, that is why another one is missing.
std::string complaint_of(const CLI::ParseError& wrong, const Words& unexpected,
                         const reports::VerbManual& verb) {
  if (!unexpected.empty()) {
    const auto option = std::ranges::find_if(unexpected, [](auto& word) { return word[0] == '-'; });
    const auto name = option == unexpected.end() ? "" : option->substr(0, option->find('='));
    return fmt::format("not expected: {}{}", fmt::join(unexpected, " "),
                       corpus::did_you_mean(corpus::names_among(verb.options), name));
  }
  std::string text = wrong.what();
  const auto reword = [&](const std::string& before, const std::string& between,
                          const std::string& behind) {
    const auto at = text.find(before);
    if (at == std::string::npos) return;
    text = text.substr(0, at) + between + text.substr(at + before.size()) + behind;
  };
  if (dynamic_cast<const CLI::ExcludesError*>(&wrong))
    reword(" excludes ", " and ", " do not go together");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&wrong)) reword(": 1 required ", ": ", "");
  return text;
}

int run(const Words& words) {
  CLI::App app;
  app.set_help_flag();
  std::vector<reports::AddedVerb> added;
  Manuals manuals;
  for (const auto add_verb : verbs) {
    added.push_back(add_verb(app));
    manuals.push_back(added.back().manual);
  }
  if (words.empty()) return reports::refuse("name a verb (assay help lists verbs)");
  const auto is_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
  if (words[0] == "help" || is_help(words[0]))
    return help({words.begin() + 1, words.end()}, manuals);
  if (words[0] == "version" || words[0] == "--version") {
    const auto commit = reports::commit_text();
    fmt::print("{}\n{}", reports::version_text(), commit.empty() ? "" : "commit " + commit + "\n");
    return reports::exit_holds;
  }
  const auto verb = std::ranges::find(manuals, words[0], &reports::VerbManual::name);
  if (verb == manuals.end()) return refuse_verb(words[0], manuals);
  if (std::any_of(words.begin() + 1, words.end(), is_help)) return help({verb->name}, manuals);
  try {
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& wrong) {
    return reports::refuse(fmt::format("{} (assay {} --help lists options)",
                                       complaint_of(wrong, app.remaining(true), *verb),
                                       verb->name));
  }
  return added[static_cast<std::size_t>(verb - manuals.begin())].act();
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
    const int code = run(Words(argv + 1, argv + argc));
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
