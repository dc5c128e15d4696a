// Suite `peers` compares those detectors of others that are there with the built-in one.
#include <algorithm>

#include "reports/bench/peers/peer_memory.h"
#include "reports/bench/peers/peer_runs.h"
#include "reports/bench/suites.h"

namespace assay::reports {
namespace {

// With --quick, keeps only the two public sequences of fewest triangles.
void keep_smallest_sequences(std::vector<ErrorFamily>& families, BenchReport& report) {
  std::vector<std::pair<Eigen::Index, std::string>> sizes;
  for (const auto& family : families) {
    if (family.kind == "real")
      sizes.emplace_back(family.cases().front().c.triangles.rows(), family.name);
  }
  std::sort(sizes.begin(), sizes.end());
  constexpr std::size_t kept = 2;
  for (std::size_t i = kept; i < sizes.size(); ++i) {
    std::erase_if(families, [&](const auto& family) { return family.name == sizes[i].second; });
    report.add_left_out(sizes[i].second, "left out: --quick takes the two smallest sequences");
  }
}

}  // namespace

BenchReport peers_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("peers");
  progress.phase("peers");
  auto peers = find_peers(settings.peers);
  report.absent_peers = std::move(peers.absent);
  std::vector<std::string> missing;
  auto families = error_families(settings, missing);
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  if (settings.scale < 1) keep_smallest_sequences(families, report);
  PeerRuns runs(peers.subjects, {.large_seconds = settings.case_seconds, .jobs = settings.jobs});
  std::vector<PeerCase> cases;
  for (const auto& family : families) {
    progress.phase(family.name);
    for (const auto& timed : family.cases()) {
      auto done = runs.run(family, timed, report.wrong_answers, report.unsafe_answers,
                           [&] { progress.tick(); });
      std::move(done.begin(), done.end(), std::back_inserter(cases));
    }
  }
  progress.phase("memory");
  report.peer_families = peers_by_family(cases, peers.subjects);
  report.peers = peer_rows(report.peer_families, peers.subjects);
  for (std::size_t i = 0; i < peers.subjects.size(); ++i)
    report.peers[i].bytes_a_triangle = bytes_a_triangle(peers.subjects[i]);
  return report;
}

}  // namespace assay::reports
