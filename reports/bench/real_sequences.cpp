#include "reports/bench/real_sequences.h"

#include <fmt/format.h>

#include <filesystem>

#include "corpus/scenes/scenes.h"

namespace assay::reports {
namespace {

struct Files {
  std::string name;
  std::vector<std::string> files;
  bool starts_clean;
};

std::vector<Files> files_of(const BenchSettings& settings) {
  std::vector<Files> list = {{"rod-twist",
                              {settings.file("scalable-ccd/rod-twist/frames/3036.ply"),
                               settings.file("scalable-ccd/rod-twist/frames/3037.ply")},
                              true},
                             {"thick-cloth",
                              {settings.file("ipc-toolkit/thick-cloth/t0.ply"),
                               settings.file("ipc-toolkit/thick-cloth/t1.ply")},
                              false},
                             {"kick", {}, false}};
  for (int f = 56; f <= 62; ++f) {
    list.back().files.push_back(settings.file(fmt::format("codim-ipc-kick/shell{}.obj.gz", f)));
  }
  return list;
}

corpus::Sequence read(const std::vector<std::string>& files) {
  const std::vector<std::filesystem::path> paths(files.begin(), files.end());
  auto sequence = corpus::read_sequence(paths);
  if (!sequence) throw UnusableData(sequence.error().message);
  return std::move(sequence.value());
}

std::string first_missing(const std::vector<std::string>& files) {
  std::error_code ignored;
  for (const auto& file : files) {
    if (!std::filesystem::exists(file, ignored)) return file;
  }
  return {};
}

}  // namespace

std::vector<RealSequence> real_sequences(const BenchSettings& settings,
                                         std::vector<std::string>& missing) {
  std::vector<RealSequence> list;
  for (const auto& [name, files, starts_clean] : files_of(settings)) {
    if (auto file = first_missing(files); !file.empty()) {
      missing.push_back(file);
      continue;
    }
    list.push_back({name, read(files), starts_clean});
  }
  if (auto bent = bent_bunny(settings)) {
    list.push_back({"bunny-bent", std::move(*bent), true});
  } else {
    missing.push_back(bunny_file(settings));
  }
  return list;
}

std::string bunny_file(const BenchSettings& settings) {
  return settings.file("ipc-toolkit/bunny.ply");
}

std::optional<corpus::Sequence> bent_bunny(const BenchSettings& settings) {
  const std::string file = bunny_file(settings);
  if (!first_missing({file}).empty()) return std::nullopt;
  auto mesh = corpus::read_mesh(file);
  if (!mesh) throw UnusableData(mesh.error().message);
  constexpr int frames = 6;
  auto bent = corpus::make_scene("bend", {0, frames, std::move(mesh.value())});
  if (!bent) throw UnusableData(bent.error().message);
  return std::move(bent.value());
}

std::optional<corpus::Sequence> rod_twist_step(const BenchSettings& settings) {
  const std::vector<std::string> files = files_of(settings).front().files;
  if (!first_missing(files).empty()) return std::nullopt;
  return read(files);
}

}  // namespace assay::reports
