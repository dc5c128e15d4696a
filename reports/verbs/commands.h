// The verbs of the command line. Each takes checked options, prints, and returns an exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "detector/options.h"
#include "properties/campaign/request.h"

namespace assay::reports {

struct CheckRequest {
  std::vector<std::string> files;            // frames of one mesh, or one case file
  std::optional<detector::Culling> culling;  // default: the case's own, or view-auto
  std::optional<detector::Start> start;
  std::optional<detector::Pairs> pairs;
  std::optional<detector::Arithmetic> arithmetic;
  std::string plugin_library;  // empty: the built-in detector
  bool use_oracle = true;
  std::optional<double> second_opinion;  // share in (0,1]; needs the oracle
  int jobs = 1;
  std::optional<double> time_limit;           // seconds
  std::optional<std::uint64_t> memory_limit;  // bytes
  bool fail_on_collision = false;
  std::string json_file;  // empty: none
};
int run_check(const CheckRequest& request);

enum class QueryMethod : std::uint8_t {
  oracle,
  referee,
  detector_exact,
  detector_bounded,
  detector_double,
  detector_float
};
// Of the command line and the report, in the order of QueryMethod.
inline constexpr const char* query_method_names[] = {
    "oracle", "referee", "detector-exact", "detector-bounded", "detector-double", "detector-float"};
struct CheckQueriesRequest {
  std::vector<std::string> files;
  std::vector<std::string> truths;  // none, or one a file
  QueryMethod method = QueryMethod::oracle;
  std::string json_file;
};
int run_check_queries(const CheckQueriesRequest& request);

struct SceneRequest {
  std::string name;
  std::string mesh_file;  // empty: the scene's own shape
  int size = 0, frames = 0;
  std::string out;
};
int run_scene(const SceneRequest& request);

int run_list_scenes();

struct CertifyRequest {
  std::string campaign = "smoke";  // a name or a file
  std::uint64_t seed = 1;
  std::optional<double> time_limit;  // seconds, in place of the campaign's
  std::string power;                 // a folder with the proof of planted faults; empty: none
  std::string detector;              // a plug-in's library; empty: the built-in detector
  std::string out;
  int jobs = 1;
};
int run_certify(const CertifyRequest& request);

struct VerifyRequest {
  std::vector<std::string> certificates;  // several: nights, pooled
};
int run_verify(const VerifyRequest& request);

struct SelfTestRequest {
  std::uint64_t seed = 1;
  std::uint64_t queries = 20'000;    // random small-integer queries
  std::optional<double> time_limit;  // seconds
  int jobs = 1;
  std::string replay;  // "family:seed:index"; empty: the whole self-test
};
int run_self_test(const SelfTestRequest& request);

struct RunCommandRequest {
  std::string campaign = "quick";  // a name or a file
  std::uint64_t seed = 1;
  std::optional<double> time_limit;  // seconds, in place of the campaign's
  std::string power;                 // a folder with the proof of planted faults; empty: none
  properties::Shard shard;
  int jobs = 1;
  std::string detector;  // a plug-in's library; empty: the built-in detector
  std::string out;
};
int run_campaign(const RunCommandRequest& request);

struct MergeRequest {
  std::vector<std::string> folders;
  std::string out;
};
int run_merge(const MergeRequest& request);

struct ReplayRequest {
  std::string id_or_file;
  std::string export_folder;  // empty: none
  std::optional<detector::TrianglePair> why;
  std::string detector;
};
int run_replay(const ReplayRequest& request);

struct ShrinkRequest {
  std::string file, out;
  double seconds = 60;
  std::string detector;
};
int run_shrink(const ShrinkRequest& request);

struct BenchRequest {
  std::string suite;                          // is_bench_suite
  std::string data;                           // folder of the public data
  std::string json_file, csv_file, svg_file;  // empty: none
};
bool is_bench_suite(std::string_view name);
int run_bench(const BenchRequest& request);

struct ReportRequest {
  std::vector<std::string> folders;  // of runs, oldest first
  std::string out;                   // one HTML file
};
int run_report(const ReportRequest& request);

struct ListRequest {
  std::string what = "scenes";  // scenes, laws, faults, campaigns, failures
  std::string folder;           // of a run, for failures
};
int run_list(const ListRequest& request);

// "assay 0.1.0 (CGAL 5.5.1, GMP ..., ...)"
std::string version_text();

}  // namespace assay::reports
