// Options of `check`, `check-queries`, `self-test` and `certify`.
#include <array>

#include "properties/judging/case_check.h"
#include "properties/words.h"
#include "reports/terminal/joined.h"
#include "reports/verbs/option_words.h"
#include "reports/verbs/verb_options.h"

namespace assay::reports {
namespace {

// "6GB", "512MB", "1000" (bytes); KB, MB, GB are 2^10, 2^20, 2^30 bytes. Nothing for other words.
std::optional<std::uint64_t> parse_size(const std::string& word) {
  const auto digits = word.find_first_not_of("0123456789");
  const std::string number = word.substr(0, digits);
  const std::string unit = digits == std::string::npos ? "" : word.substr(digits);
  constexpr std::size_t most_digits = 9;
  if (number.empty() || number.size() > most_digits) return std::nullopt;
  const std::array<std::pair<const char*, int>, 5> shifts = {
      {{"", 0}, {"B", 0}, {"KB", 10}, {"MB", 20}, {"GB", 30}}};
  for (const auto& [name, shift] : shifts) {
    if (unit != name) continue;
    const std::uint64_t bytes = std::stoull(number) << shift;
    return bytes > 0 ? std::optional(bytes) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

void add_check(CLI::App& app, CheckRequest& request) {
  auto* verb = app.add_subcommand("check", "Detector against oracle on the steps of one mesh");
  verb->add_option("frames", request.files,
                   "Two or more frames (OBJ, PLY, OFF; .gz too), or one case file (.json)")
      ->required();
  auto* plugin = verb->add_option("--detector", request.plugin_library,
                                  "Judge this plug-in (.so) by its claims, not the built-in");
  add_choice(verb, "--culling", request.culling,
             "view-auto, view-point, view-line, normal-cone, bvh, none", properties::culling_named,
             "How the detector culls (default view-auto)");
  add_choice(verb, "--start", request.start, "verified, clean, unknown", properties::start_named,
             "What is known of the first frame (default verified)");
  add_choice(verb, "--pairs", request.pairs, "all, first", properties::pairs_named,
             "Which pairs are asked for (default all)");
  add_choice(verb, "--arithmetic", request.arithmetic, "exact, bounded, double, float",
             properties::arithmetic_named, "What the detector computes in (default exact)");
  for (const char* of_the_built_in : {"--culling", "--start", "--pairs", "--arithmetic"}) {
    plugin->excludes(verb->get_option(of_the_built_in));
  }
  auto* no_oracle = verb->add_flag_callback(
      "--no-oracle", [&request] { request.use_oracle = false; },
      "Detector only; prints `not judged`");
  verb->add_option("--second-opinion", request.second_opinion,
                   "Check the oracle itself by other methods, on this share of its questions")
      ->check(share())
      ->excludes(no_oracle);
  add_jobs(verb, request.jobs);
  verb->add_option("--time", request.time_limit,
                   "Limit in seconds of processor time, all threads together; what is left is "
                   "undecided")
      ->check(positive());
  add_choice(verb, "--memory", request.memory_limit, "a number above 0 with B, KB, MB or GB",
             parse_size, "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)");
  verb->add_flag("--fail-on-collision", request.fail_on_collision,
                 "Exit code 5 when they agree on a collision");
  verb->add_option("--json", request.json_file, "Write the report here (assay-check/1)");
}

void add_check_queries(CLI::App& app, CheckQueriesRequest& request) {
  auto* verb =
      app.add_subcommand("check-queries", "Labelled VF and EE queries against their truth");
  verb->add_option("files", request.files, "Query files (.csv, .csv.gz)")->required();
  verb->add_option("--truth", request.truths, "Labels (.json), one file for each query file");
  const auto parse = [](std::string_view word) {
    return properties::value_of<QueryMethod>(query_method_names, word);
  };
  verb->add_option_function<std::string>(
          "--method", [&request, parse](const std::string& word) { request.method = *parse(word); },
          "Who answers (default oracle)")
      ->check(one_of(joined(query_method_names, ", "), parse));
  verb->add_option("--json", request.json_file, "Write the report here (assay-queries/1)");
}

void add_self_test(CLI::App& app, SelfTestRequest& request) {
  auto* verb = app.add_subcommand("self-test",
                                  "The oracle against every other method on elementary queries");
  add_seed(verb, request.seed, "Of all random queries");
  verb->add_option("--queries", request.queries,
                   "Random small-integer queries; the other families follow this number")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
  verb->add_option("--time", request.time_limit, "Limit in seconds; what is left is undecided")
      ->check(positive());
  add_jobs(verb, request.jobs);
  verb->add_option("--replay", request.replay, "One case again, by its name family:seed:index");
}

}  // namespace assay::reports
