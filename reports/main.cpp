// The command line. It finds the verb, and turns each problem into one line and an exit code.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <system_error>
#include <vector>

#include "corpus/problem.h"
#include "oracle/libraries.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace {

using namespace assay;

// The verbs, in the order of `assay help`.
constexpr reports::VerbAction (*verbs[])(CLI::App&) = {
    reports::add_check,  reports::add_run,    reports::add_certify,  reports::add_bench,
    reports::add_list,   reports::add_replay, reports::add_shrink,   reports::add_verify,
    reports::add_report, reports::add_scene,  reports::add_self_test};

using Words = std::vector<std::string>;

// Help on a terminal of 80 columns: CLI11's own, except for the usage and for broken lines.
class Formatter : public CLI::Formatter {
 public:
  Formatter() {
    label("Positionals", reports::OptionGroup::input);
    column_width(26);
  }

 private:
  std::string make_description(const CLI::App* app) const override {
    return reports::wrapped(app->get_description() + ".", 0) + "\n\n";
  }
  std::string make_usage(const CLI::App* app, std::string) const override {
    if (app->get_name().empty()) return "Usage: assay VERB [OPTION...]\n";
    std::string required = "Usage: assay " + app->get_name(), others;
    for (const bool is_positional : {true, false}) {
      for (const auto* option : app->get_options()) {
        if (option->get_positional() != is_positional) continue;
        const auto word = make_option_name(option, is_positional) + make_option_opts(option);
        if (option->get_required())
          required += " " + word;
        else if (is_positional)
          required += " [" + word + "]";
        else
          others = " [OPTION...]";
      }
    }
    return required + others + "\n";
  }
  std::string make_footer(const CLI::App* app) const override { return app->get_footer(); }
  std::string make_option_opts(const CLI::Option* option) const override {
    const auto value = option->get_type_name();
    const bool is_list = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
    return (value.empty() ? "" : " " + value) + (is_list ? "..." : "");
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    auto about = option->get_description();
    if (option->get_required() && !is_positional) about += " (needed)";
    if (const auto value = option->get_default_str(); !value.empty())
      about += fmt::format(" (default {})", value);
    return row(make_option_name(option, is_positional) + make_option_opts(option), about,
               get_column_width());
  }
  std::string make_subcommand(const CLI::App* verb) const override {
    constexpr std::size_t width = 18;
    return row(verb->get_name(), verb->get_description(), width);
  }
  static std::string row(std::string name, const std::string& about, std::size_t width) {
    name.insert(0, 2, ' ');
    name += name.size() < width ? std::string(width - name.size(), ' ')
                                : "\n" + std::string(width, ' ');
    return name + reports::wrapped(about, width) + "\n";
  }
};

int refuse_verb(const CLI::App& app, const std::string& word) {
  for (const auto& [name, input] : {std::pair("judge", "LOG"), {"check-queries", "QUERIES.csv"}}) {
    if (word == name)
      return reports::refuse(fmt::format("{} is now called check: assay check {}", name, input));
  }
  Words names;
  for (const auto* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return reports::refuse(fmt::format("unknown verb '{}'{} (assay help lists verbs)", word,
                                     corpus::did_you_mean(names, word)));
}

int print_help(const CLI::App& app) {
  // Groups have an empty line before them, and behind them another one.
  fmt::print("{}", CLI::detail::find_and_replace(app.help(), "\n\n\n", "\n\n"));
  return reports::exit_holds;
}

// Returns one line that says what is wrong with the words of a verb. Unexpected words are named
// first: if an option is misspelt, that is why another one is missing.
std::string complaint_of(const CLI::ParseError& wrong, const Words& unexpected,
                         const CLI::App& verb) {
  if (!unexpected.empty()) {
    const auto option = std::ranges::find_if(unexpected, [](auto& word) { return word[0] == '-'; });
    const auto name = option == unexpected.end() ? "" : option->substr(0, option->find('='));
    Words names;
    for (const auto* verb_option : verb.get_options()) names.push_back(verb_option->get_name());
    return fmt::format("not expected: {}{}", fmt::join(unexpected, " "),
                       corpus::did_you_mean(names, name));
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
  CLI::App app(
      "Assay certifies continuous self-collision detectors (continuous collision detection, CCD) "
      "for deforming triangle meshes, against an exact oracle");
  app.set_help_flag();
  app.formatter(std::make_shared<Formatter>());
  app.option_defaults()->group(reports::OptionGroup::question);
  app.footer(reports::exit_codes_text());
  std::vector<reports::VerbAction> actions;
  for (const auto add_verb : verbs) actions.push_back(add_verb(app));
  // These two only stand in the list of verbs; they are not parsed as verbs.
  for (const auto& [word, about] :
       {std::pair("help", "This list; `assay help VERB` says what a verb does"),
        {"version", "The versions of this program and of the libraries behind its answers"}})
    app.add_subcommand(word, about)->group(reports::beside_the_verbs)->disabled();
  if (words.empty()) return reports::refuse("name a verb (assay help lists verbs)");
  const auto is_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
  const bool is_of_all = words[0] == "help" || is_help(words[0]);
  if (is_of_all && words.size() == 1) return print_help(app);
  if (words[0] == "version" || words[0] == "--version") {
    const auto commit = reports::commit_text();
    fmt::print("{}\n{}", reports::version_text(), commit.empty() ? "" : "commit " + commit + "\n");
    return reports::exit_holds;
  }
  const auto& name = words[is_of_all];
  const auto action = std::ranges::find(actions, name, &reports::VerbAction::name);
  if (action == actions.end()) return refuse_verb(app, name);
  const auto& verb = *app.get_subcommand(name);
  if (is_of_all || std::any_of(words.begin() + 1, words.end(), is_help)) return print_help(verb);
  try {
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& wrong) {
    return reports::refuse(fmt::format("{} (assay {} --help lists options)",
                                       complaint_of(wrong, app.remaining(true), verb), name));
  }
  return action->act();
}

// The program may end at once, because a store is whole at any moment.
constexpr const char* no_memory = "not enough memory for this input";

// Some destructors allocate, such as those of nlohmann-json. If they found no memory while
// std::bad_alloc is on its way, std::terminate would end the program. So some memory is reserved
// for them.
std::atomic<void*> memory_for_destructors = nullptr;
void find_memory() {
  void* const memory =
      std::uncaught_exceptions() > 0 ? memory_for_destructors.exchange(nullptr) : nullptr;
  if (!memory) throw std::bad_alloc();
  std::free(memory);
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
