// Counts how often each tag and each block of set pairs occurs in a run, which shows what the
// generators reached.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/step.h"

namespace assay::properties {

// The view sets of a pair's two triangles (L3, detector/README.md). A triangle in Vv counts as
// violated, whatever its sign.
enum class PairBlock : std::uint8_t {
  positive_negative,
  positive_zero,
  negative_zero,
  zero_zero,
  violated,  // at least one triangle is in Vv
  positive_positive,
  negative_negative,  // the last two are outside K, unless in two groups
};
inline constexpr std::size_t pair_blocks = 7;

const char* name_of(PairBlock block);
PairBlock block_of(detector::ViewSign a, detector::ViewSign b, bool either_violated);

class TagTable {
 public:
  // Adds one case, and how many of its steps collide.
  void add(const std::vector<std::string>& tags, std::uint64_t steps, std::uint64_t collisions);
  // Adds the contacts of one step. Both spans are by triangle: the signs of all, and Vv as 0 or 1,
  // or empty if no triangle is in Vv.
  void add_contacts(const detector::TrianglesView& triangles,
                    const oracle::StepJudgement& judgement,
                    std::span<const detector::ViewSign> signs,
                    std::span<const std::uint8_t> violated);
  void merge(const TagTable& other);

  struct TagCount {
    std::uint64_t cases = 0, steps = 0, collisions = 0;
  };
  // Each array is by the number of vertices that a pair shares: 0, 1, 2.
  struct BlockCount {
    std::array<std::uint64_t, 3> contacts = {}, first_contacts = {};
  };
  const std::map<std::string, TagCount>& tags() const { return tags_; }
  const BlockCount& block(PairBlock b) const { return blocks_[static_cast<std::size_t>(b)]; }

  // Two tables of plain text, tags ascending; one line a row.
  std::string text() const;

 private:
  std::map<std::string, TagCount> tags_;
  std::array<BlockCount, pair_blocks> blocks_;
};

}  // namespace assay::properties
