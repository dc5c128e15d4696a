#include "reports/bench/workers/peer_subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace assay::reports {
namespace {

using detector::Arithmetic;
using detector::Culling;

// The detectors for which corpus/peers has adapters, and what each is built with.
struct KnownPeer {
  const char *file, *needs;
};
constexpr const char* of_tight_inclusion =
    "Tight-Inclusion was not found when it was built (corpus/peers/README.md)";
constexpr const char* of_ipc_toolkit =
    "the IPC Toolkit was not found when it was built (corpus/peers/README.md)";
constexpr KnownPeer known_peers[] = {{"cubic_double", nullptr},
                                     {"cubic_float", nullptr},
                                     {"cubic_eigen", "libeigen3-dev was not there"},
                                     {"sampled_1", nullptr},
                                     {"sampled_10", nullptr},
                                     {"sampled_100", nullptr},
                                     {"fcl_elementary", "libfcl-dev was not there"},
                                     {"bullet_bernstein", "libbullet-dev was not there"},
                                     {"tight_inclusion", of_tight_inclusion},
                                     {"ipc_tight_inclusion", of_ipc_toolkit},
                                     {"ipc_additive", of_ipc_toolkit}};

PeerSubject built_in(Arithmetic arithmetic, Culling culling) {
  PeerSubject subject;
  subject.name = fmt::format("built-in, {}, {}", name_of(arithmetic), name_of(culling));
  subject.options = {culling, detector::Start::verified, detector::Pairs::all, arithmetic};
  subject.claims = properties::claims_of(subject.options);
  return subject;
}

void add_library(const std::filesystem::path& file, Peers& peers) {
  properties::WorkerProcess worker(properties::worker_program(), file);
  const auto described = worker.describe();
  const std::string name = file.stem().string();
  if (!described) {
    peers.absent.push_back({name, described.error().message});
    return;
  }
  const auto& d = described.value();
  if (!d.parts.steps) {
    peers.absent.push_back({name, "it holds no steps"});
    return;
  }
  PeerSubject subject;
  const bool is_taken = std::any_of(peers.subjects.begin(), peers.subjects.end(),
                                    [&](const PeerSubject& other) { return other.name == d.name; });
  subject.name = is_taken ? fmt::format("{} ({})", d.name, name) : d.name;
  subject.version = d.version;
  subject.library = file.string();
  subject.claims = claims_on_steps(d);
  subject.contract = d.contract;
  peers.subjects.push_back(std::move(subject));
}

// Known detectors stand in the order of their list. Others stand behind them, by name.
std::size_t place_of(const std::filesystem::path& file) {
  const auto* known = std::find_if(std::begin(known_peers), std::end(known_peers),
                                   [&](const KnownPeer& peer) { return file.stem() == peer.file; });
  return static_cast<std::size_t>(known - std::begin(known_peers));
}

}  // namespace

properties::WorkerProcess PeerSubject::make_worker(double seconds) const {
  std::optional<std::filesystem::path> plugin;
  if (!is_built_in()) plugin = library;
  return {properties::worker_program(), plugin, {.seconds = seconds}};
}

properties::Claims PeerSubject::asked() const {
  return is_built_in() ? properties::claims_of({}).only(properties::claims_from_outside) : claims;
}

Peers find_peers(const std::string& folder) {
  Peers peers;
  for (const auto arithmetic :
       {Arithmetic::exact, Arithmetic::bounded, Arithmetic::double_precision}) {
    for (const auto culling : {Culling::bvh, Culling::automatic})
      peers.subjects.push_back(built_in(arithmetic, culling));
  }
  std::vector<std::filesystem::path> files;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return std::pair(place_of(a), a) < std::pair(place_of(b), b);
  });
  for (const auto& file : files) add_library(file, peers);
  for (const auto& [file, needs] : known_peers) {
    const bool is_there = std::any_of(
        files.begin(), files.end(), [name = file](const auto& one) { return one.stem() == name; });
    if (is_there) continue;
    peers.absent.push_back({file, needs ? needs : fmt::format("{}.so is not in {}", file, folder)});
  }
  return peers;
}

}  // namespace assay::reports
