#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "properties/worker/worker_process.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {

using detector::Arithmetic, detector::Culling, detector::Pairs;

properties::WorkerProcess BenchSubject::make_worker(double seconds) const {
  return {worker, plugin, {.seconds = seconds}};
}

BenchSubject variant_of(Arithmetic arithmetic, Culling culling, Pairs pairs) {
  BenchSubject subject;
  subject.name = fmt::format("{} {} {}", name_of(arithmetic), name_of(culling), name_of(pairs));
  subject.options = {culling, detector::Start::verified, pairs, arithmetic};
  subject.is_here = true;
  subject.detector.claims = properties::claims_of(subject.options);
  subject.counted = properties::claims_of({.pairs = pairs});
  return subject;
}

std::vector<BenchSubject> all_variants() {
  std::vector<BenchSubject> variants;
  for (const auto arithmetic : all_values<Arithmetic>) {
    for (const auto culling : all_values<Culling>) {
      for (const auto pairs : all_values<Pairs>)
        variants.push_back(variant_of(arithmetic, culling, pairs));
    }
  }
  std::stable_partition(variants.begin(), variants.end(),
                        [](const auto& variant) { return variant.name == "exact bvh all"; });
  return variants;
}

BenchSubject built_in_in_worker(const detector::Options& options) {
  BenchSubject subject;
  subject.worker = properties::worker_program();
  subject.name =
      fmt::format("built-in, {}, {}", name_of(options.arithmetic), name_of(options.culling));
  subject.options = options;
  subject.detector.claims = properties::claims_of(options);
  subject.detector.contract = properties::contract_of(options);
  subject.counted = properties::claims_of({}).only(properties::claims_from_outside);
  return subject;
}

namespace {

// The detectors for which corpus/peers has adapters, and why each may not be there: nothing where
// it is always built.
using KnownPeer = std::pair<std::string, std::string>;
std::vector<KnownPeer> known_peers() {
  std::vector<KnownPeer> known = {
      {"cubic_double", ""}, {"cubic_float", ""}, {"cubic_eigen", "libeigen3-dev was not there"},
      {"sampled_1", ""},    {"sampled_10", ""},  {"sampled_100", ""}};
  known.emplace_back("fcl_elementary", "libfcl-dev was not there");
  known.emplace_back("bullet_bernstein", "libbullet-dev was not there");
  std::istringstream of_sources(
      "tight_inclusion ipc_tight_inclusion ipc_additive fast_approximate_root eltopo_cubic ctcd "
      "eltopo_root_parity bsc tight_ccd arcsim codim_ipc libuipc ppf");
  for (std::string name; of_sources >> name;)
    known.emplace_back(name, "its source was not found when it was built (corpus/peers/README.md)");
  return known;
}

void add_library(const std::filesystem::path& file, Peers& peers) {
  auto opened = properties::Subject::open(properties::worker_program(), file.string(),
                                          properties::DetectorPart::by_library, {});
  const std::string file_name = file.stem().string();
  const auto why = !opened                                           ? opened.error().message
                   : !opened.value().description.parts.steps         ? "it holds no steps"
                   : opened.value().detector.contract.separation > 0 ? "it is asked for a distance"
                                                                     : "";
  if (!why.empty()) {
    peers.absent.push_back({file_name, why});
    return;
  }
  BenchSubject subject{std::move(opened.value())};
  subject.name = subject.description.name;
  subject.must_hold = false;
  subject.counted = subject.detector.claims;
  if (std::any_of(peers.subjects.begin(), peers.subjects.end(),
                  [&](const BenchSubject& other) { return other.name == subject.name; }))
    subject.name += fmt::format(" ({})", file_name);
  peers.subjects.push_back(std::move(subject));
}

// Known detectors stand in the order of their list. Others stand behind them, by name.
std::size_t place_of(const std::filesystem::path& file) {
  const auto known = known_peers();
  const auto found = std::ranges::find(known, file.stem().string(), &KnownPeer::first);
  return static_cast<std::size_t>(found - known.begin());
}

}  // namespace

Peers find_peers(const std::string& folder) {
  Peers peers;
  for (const auto arithmetic :
       {Arithmetic::exact, Arithmetic::bounded, Arithmetic::double_precision}) {
    for (const auto culling : {Culling::bvh, Culling::automatic})
      peers.subjects.push_back(
          built_in_in_worker({culling, detector::Start::verified, Pairs::all, arithmetic}));
  }
  std::set<std::pair<std::size_t, std::filesystem::path>> files;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".so") files.emplace(place_of(entry.path()), entry.path());
  }
  for (const auto& [place, file] : files) add_library(file, peers);
  for (const auto& [name, needs] : known_peers()) {
    if (std::ranges::any_of(files, [stem = name](auto& f) { return f.second.stem() == stem; }))
      continue;
    peers.absent.push_back(
        {name, needs.empty() ? fmt::format("{}.so is not in {}", name, folder) : needs});
  }
  return peers;
}

}  // namespace assay::reports
