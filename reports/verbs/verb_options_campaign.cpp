// Options of `run`, `replay`, `shrink` and `list`.
#include "reports/verbs/option_words.h"
#include "reports/verbs/verb_options.h"

namespace assay::reports {
namespace {

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

void add_time_limit(CLI::App& verb, std::optional<double>& seconds) {
  verb.add_option("--time", seconds,
                  "Seconds by the clock for the campaign, in place of its own limit; what is left "
                  "over then is incomplete")
      ->check(positive());
}

void add_power(CLI::App& verb, std::string& folder) {
  verb.add_option("--power", folder,
                  "Folder of a run or certificate of this build: planted faults are proved by it, "
                  "not again");
}

}  // namespace

void add_run(CLI::App& app, RunCommandRequest& request) {
  auto* verb = app.add_subcommand(
      "run", "A campaign of random cases: detector against oracle, laws, planted faults");
  verb->add_option("--campaign", request.campaign,
                   "smoke, quick, nightly, release, faults, or a campaign file (.json)")
      ->capture_default_str();
  add_seed(verb, request.seed, "Of all random cases");
  add_time_limit(*verb, request.time_limit);
  add_power(*verb, request.power);
  verb->add_option_function<std::string>(
          "--shard", [&request](const std::string& word) { request.shard = *parse_shard(word); },
          "I/N: the part of the cases that this run makes (default 1/1)")
      ->check(one_of("I/N with 1 <= I <= N", parse_shard));
  add_jobs(verb, request.jobs);
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
  verb->add_option("--out", request.out, "Folder for the store and the failing meshes")->required();
}

void add_replay(CLI::App& app, ReplayRequest& request) {
  auto* verb = app.add_subcommand("replay", "One case of a campaign again, or a case file");
  verb->add_option("case", request.id_or_file, "Its id, CAMPAIGN:SEED:FAMILY:INDEX, or a file")
      ->required();
  verb->add_option("--export", request.export_folder,
                   "Write frames as OBJ and a ready GoogleTest into this folder");
  add_choice(verb, "--why", request.why, "A,B: two triangles", parse_pair,
             "A,B: why this pair of triangles was or was not tested");
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
}

void add_shrink(CLI::App& app, ShrinkRequest& request) {
  auto* verb = app.add_subcommand("shrink", "The smallest case that fails as a given one does");
  verb->add_option("file", request.file, "A case file (.json)")->required();
  verb->add_option("--out", request.out, "Where the smallest case goes")->required();
  verb->add_option("--time", request.seconds, "Seconds at most")
      ->check(positive())
      ->capture_default_str();
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
}

void add_report(CLI::App& app, ReportRequest& request) {
  auto* verb = app.add_subcommand("report", "Runs as one HTML page that works offline");
  verb->add_option("folders", request.folders, "Folders of runs, the oldest first")->required();
  verb->add_option("--out", request.out, "The page (.html)")->required();
}

void add_list(CLI::App& app, ListRequest& request) {
  auto* verb = app.add_subcommand("list", "List scenes, laws, faults, campaigns, or failures");
  verb->add_option("what", request.what, "scenes, laws, faults, campaigns, failures")
      ->check(CLI::IsMember({"scenes", "laws", "faults", "campaigns", "failures"}));
  verb->add_option("folder", request.folder, "Of a run, for failures");
}

void add_merge(CLI::App& app, MergeRequest& request) {
  auto* verb = app.add_subcommand("merge", "The stores of several shards become one");
  verb->add_option("folders", request.folders, "Folders of `assay run`, or of `assay merge`")
      ->required();
  verb->add_option("--out", request.out, "Folder for merged.sqlite and the failing meshes")
      ->required();
}

void add_certify(CLI::App& app, CertifyRequest& request) {
  auto* verb = app.add_subcommand(
      "certify", "Corpus, campaign, planted faults, self-test, speed: a certificate, or a defect");
  verb->add_option("--campaign", request.campaign,
                   "smoke, quick, nightly, release, or a campaign file (.json)")
      ->capture_default_str();
  add_seed(verb, request.seed, "Of all random cases; a fresh one a night");
  add_time_limit(*verb, request.time_limit);
  add_power(*verb, request.power);
  verb->add_option("--detector", request.detector, "A plug-in's library (default: the built-in)");
  verb->add_option("--out", request.out,
                   "Folder for the certificate; shards that it holds are taken")
      ->required();
  add_jobs(verb, request.jobs);
}

void add_verify(CLI::App& app, VerifyRequest& request) {
  auto* verb = app.add_subcommand("verify", "A certificate against the files beside it");
  verb->add_option("certificate", request.certificates,
                   "OUT/certificate.json; several nights of one detector are pooled")
      ->required();
}

}  // namespace assay::reports
