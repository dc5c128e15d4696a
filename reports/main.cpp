// The command line. Options are checked here; the verbs are in *_command.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>
#include <system_error>
#include <thread>

#include "properties/case_check.h"
#include "reports/commands.h"
#include "reports/complaint.h"

namespace {

using namespace assay;

// A word of a fixed set, or one clear line.
template <class Parse>
CLI::Validator one_of(const std::string& words, Parse parse) {
  return CLI::Validator(
      [words, parse](const std::string& word) {
        return parse(word) ? std::string() : fmt::format("'{}' is not one of {}", word, words);
      },
      words);
}

// CLI11's own validator of positive numbers prints the whole range of double.
CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string& word) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(word, value);
        return is_number && value > 0 && std::isfinite(value)
                   ? std::string()
                   : fmt::format("'{}' is not a number above 0", word);
      },
      "NUMBER > 0");
}

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

// CLI11 reads "-1", and numbers beyond 64 bits, as the largest unsigned number.
CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& word) {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_number = error == std::errc() && end == word.data() + word.size();
        return is_number ? std::string()
                         : fmt::format("'{}' is not a whole number of 64 bits", word);
      },
      "NUMBER >= 0");
}

CLI::Validator share() {
  return CLI::Validator(
      [](const std::string& word) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(word, value);
        return is_number && value > 0 && value <= 1
                   ? std::string()
                   : fmt::format("'{}' is not a number above 0, at most 1", word);
      },
      "0 < SHARE <= 1");
}

template <class T, class Parse>
void add_choice(CLI::App* verb, const std::string& flag, std::optional<T>& target,
                const std::string& words, Parse parse, const std::string& about) {
  verb->add_option_function<std::string>(
          flag, [&target, parse](const std::string& word) { target = parse(word); }, about)
      ->check(one_of(words, parse));
}

void add_jobs(CLI::App* verb, int& jobs) {
  verb->add_option("--jobs", jobs, "Threads of the oracle; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_check(CLI::App& app, reports::CheckRequest& request) {
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
  verb->add_option("--time", request.time_limit, "Limit in seconds; what is left is undecided")
      ->check(positive());
  verb->add_option_function<std::string>(
          "--memory",
          [&request](const std::string& word) { request.memory_limit = parse_size(word); },
          "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)")
      ->check(one_of("a number above 0 with B, KB, MB or GB", parse_size));
  verb->add_flag("--fail-on-collision", request.fail_on_collision,
                 "Exit code 5 when they agree on a collision");
  verb->add_option("--json", request.json_file, "Write the report here (assay-check/1)");
}

void add_check_queries(CLI::App& app, reports::CheckQueriesRequest& request) {
  auto* verb =
      app.add_subcommand("check-queries", "Labelled VF and EE queries against their truth");
  verb->add_option("files", request.files, "Query files (.csv, .csv.gz)")->required();
  verb->add_option("--truth", request.truths, "Labels (.json), one file for each query file");
  const auto parse = [](std::string_view word) -> std::optional<reports::QueryMethod> {
    if (word == "oracle") return reports::QueryMethod::oracle;
    if (word == "referee") return reports::QueryMethod::referee;
    if (word == "detector-exact") return reports::QueryMethod::detector_exact;
    if (word == "detector-bounded") return reports::QueryMethod::detector_bounded;
    if (word == "detector-double") return reports::QueryMethod::detector_double;
    if (word == "detector-float") return reports::QueryMethod::detector_float;
    return std::nullopt;
  };
  verb->add_option_function<std::string>(
          "--method", [&request, parse](const std::string& word) { request.method = *parse(word); },
          "Who answers (default oracle)")
      ->check(one_of("oracle, referee, detector-exact, detector-bounded, detector-double, "
                     "detector-float",
                     parse));
  verb->add_option("--json", request.json_file, "Write the report here (assay-queries/1)");
}

void add_scene(CLI::App& app, reports::SceneRequest& request) {
  auto* verb = app.add_subcommand("scene", "Write the frames of a kinematic scene");
  verb->add_option("name", request.name, "One of `assay list scenes`")->required();
  verb->add_option("--mesh", request.mesh_file, "Deform this mesh instead of the scene's own");
  verb->add_option("--size", request.size, "Triangles wanted")->check(positive());
  verb->add_option("--frames", request.frames, "Frames")->check(positive());
  verb->add_option("--out", request.out, "Folder for frame_0000.ply, ...")->required();
}

void add_self_test(CLI::App& app, reports::SelfTestRequest& request) {
  auto* verb = app.add_subcommand("self-test",
                                  "The oracle against every other method on elementary queries");
  verb->add_option("--seed", request.seed, "Of all random queries")
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--queries", request.queries,
                   "Random small-integer queries; the other families follow this number")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
  verb->add_option("--time", request.time_limit, "Limit in seconds; what is left is undecided")
      ->check(positive());
  add_jobs(verb, request.jobs);
  verb->add_option("--replay", request.replay, "One case again, by its name family:seed:index");
}

// "2/8"
std::optional<properties::Shard> parse_shard(const std::string& word) {
  properties::Shard shard;
  const auto slash = word.find('/');
  if (slash == std::string::npos) return std::nullopt;
  if (!CLI::detail::lexical_cast(word.substr(0, slash), shard.index) ||
      !CLI::detail::lexical_cast(word.substr(slash + 1), shard.count)) {
    return std::nullopt;
  }
  return shard.index >= 1 && shard.index <= shard.count ? std::optional(shard) : std::nullopt;
}

void add_run(CLI::App& app, reports::RunCommandRequest& request) {
  auto* verb = app.add_subcommand(
      "run", "A campaign of random cases: detector against oracle, laws, planted faults");
  verb->add_option("--campaign", request.campaign,
                   "smoke, quick, nightly, release, faults, or a campaign file (.json)")
      ->capture_default_str();
  verb->add_option("--seed", request.seed, "Of all random cases")
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--time", request.time_limit,
                   "Seconds for all of it, in place of the campaign's own")
      ->check(positive());
  verb->add_option_function<std::string>(
          "--shard", [&request](const std::string& word) { request.shard = *parse_shard(word); },
          "I/N: the part of the cases that this run makes (default 1/1)")
      ->check(one_of("I/N with 1 <= I <= N", parse_shard));
  add_jobs(verb, request.jobs);
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
  verb->add_option("--out", request.out, "Folder for the store and the failing meshes")->required();
}

// "3,17"
std::optional<detector::TrianglePair> parse_pair(const std::string& word) {
  detector::TrianglePair pair;
  const auto comma = word.find(',');
  if (comma == std::string::npos) return std::nullopt;
  if (!CLI::detail::lexical_cast(word.substr(0, comma), pair.a) ||
      !CLI::detail::lexical_cast(word.substr(comma + 1), pair.b) || pair.a == pair.b) {
    return std::nullopt;
  }
  if (pair.a > pair.b) std::swap(pair.a, pair.b);
  return pair;
}

void add_replay(CLI::App& app, reports::ReplayRequest& request) {
  auto* verb = app.add_subcommand("replay", "One case of a campaign again, or a case file");
  verb->add_option("case", request.id_or_file, "Its id, CAMPAIGN:SEED:FAMILY:INDEX, or a file")
      ->required();
  verb->add_option("--export", request.export_folder,
                   "Write frames as OBJ and a ready GoogleTest into this folder");
  verb->add_option_function<std::string>(
          "--why", [&request](const std::string& word) { request.why = parse_pair(word); },
          "A,B: why this pair of triangles was or was not tested")
      ->check(one_of("A,B: two triangles", parse_pair));
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
}

void add_shrink(CLI::App& app, reports::ShrinkRequest& request) {
  auto* verb = app.add_subcommand("shrink", "The smallest case that fails as a given one does");
  verb->add_option("file", request.file, "A case file (.json)")->required();
  verb->add_option("--out", request.out, "Where the smallest case goes")->required();
  verb->add_option("--time", request.seconds, "Seconds at most")
      ->check(positive())
      ->capture_default_str();
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
}

void add_merge(CLI::App& app, reports::MergeRequest& request) {
  auto* verb = app.add_subcommand("merge", "The stores of several shards become one");
  verb->add_option("folders", request.folders, "Folders of `assay run`, or of `assay merge`")
      ->required();
  verb->add_option("--out", request.out, "Folder for merged.sqlite and the failing meshes")
      ->required();
}

void add_certify(CLI::App& app, reports::CertifyRequest& request) {
  auto* verb = app.add_subcommand(
      "certify", "Corpus, campaign, planted faults, self-test, speed: a certificate, or a defect");
  verb->add_option("--campaign", request.campaign,
                   "smoke, quick, nightly, release, or a campaign file (.json)")
      ->capture_default_str();
  verb->add_option("--seed", request.seed, "Of all random cases; a fresh one a night")
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
  verb->add_option("--out", request.out,
                   "Folder for the certificate; shards that it holds are taken")
      ->required();
  add_jobs(verb, request.jobs);
}

void add_bench(CLI::App& app, reports::BenchRequest& request) {
  const char* data = std::getenv("ASSAY_DATA");
  request.data = data && *data ? data : "../shared/data";
  auto* verb = app.add_subcommand("bench", "Speeds and memory beside what is wanted");
  verb->add_option("--suite", request.suite, "What to measure")
      ->check(one_of("elementary, view, growth, claims", reports::is_bench_suite))
      ->required();
  verb->add_option("--data", request.data,
                   "Folder of the public data (default $ASSAY_DATA, else ../shared/data); rows of "
                   "what is not there say so");
  verb->add_option("--json", request.json_file, "Write all figures here (assay-bench/1)");
  verb->add_option("--svg", request.svg_file,
                   "Draw the break-even scatter of suite claims here (SVG)");
}

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
  std::string listed = "scenes", listed_folder;
  check.jobs = certify.jobs = self_test.jobs = campaign.jobs =
      static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  add_check(app, check);
  add_check_queries(app, queries);
  add_scene(app, scene);
  add_self_test(app, self_test);
  add_run(app, campaign);
  add_replay(app, replay);
  add_shrink(app, shrink);
  add_bench(app, bench);
  add_merge(app, merge);
  auto* list = app.add_subcommand("list", "List scenes, laws, faults, campaigns, or failures");
  list->add_option("what", listed, "scenes, laws, faults, campaigns, failures")
      ->check(CLI::IsMember({"scenes", "laws", "faults", "campaigns", "failures"}));
  list->add_option("folder", listed_folder, "Of a run, for failures");
  add_certify(app, certify);
  auto* verify_verb = app.add_subcommand("verify", "A certificate against the files beside it");
  verify_verb
      ->add_option("certificate", verify.certificates,
                   "OUT/certificate.json; several nights of one detector are pooled")
      ->required();

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
  return reports::run_list(listed, listed_folder);
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
