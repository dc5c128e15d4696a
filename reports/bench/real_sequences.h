// The deforming meshes of the public data, as sequences of frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "reports/bench/suites.h"

namespace assay::reports {

struct RealSequence {
  std::string name;
  corpus::Sequence frames;
  bool starts_clean = false;  // in no contact at its first frame, and closed
};

// rod-twist, thick-cloth, kick, and the bunny as scene `bend` bends it. What is not there is left
// out and named in `missing`. Throws UnusableData.
std::vector<RealSequence> real_sequences(const BenchSettings& settings,
                                         std::vector<std::string>& missing);

std::string bunny_file(const BenchSettings& settings);
// As it is bent into a ring in five steps; nothing where it is not there. Throws UnusableData.
std::optional<corpus::Sequence> bent_bunny(const BenchSettings& settings);

// The step of rod-twist alone, of which wanted.h asks most; nothing where it is not there. Throws
// UnusableData.
std::optional<corpus::Sequence> rod_twist_step(const BenchSettings& settings);

}  // namespace assay::reports
