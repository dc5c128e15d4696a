// The deforming meshes of the public data, as sequences of frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/formats/sequence_reader.h"
#include "reports/bench/suites.h"

namespace assay::reports {

struct RealSequence {
  std::string name;
  corpus::Sequence frames;
  bool starts_clean = false;  // closed, and without contact at the first frame
};

// rod-twist, thick-cloth, kick, and the bunny as scene `bend` bends it. Data that is not there is
// left out and named in `missing`. Throws UnusableData.
std::vector<RealSequence> real_sequences(const BenchSettings& settings,
                                         std::vector<std::string>& missing);

std::string bunny_file(const BenchSettings& settings);
// The bunny as it is bent into a ring in five steps; nothing if it is not there. Throws
// UnusableData.
std::optional<corpus::Sequence> bent_bunny(const BenchSettings& settings);

// The step of rod-twist alone, of which wanted.h asks most; nothing if it is not there. Throws
// UnusableData.
std::optional<corpus::Sequence> rod_twist_step(const BenchSettings& settings);

}  // namespace assay::reports
