// Counts how often each tag and each block of set pairs occurs in a run, which shows what the
// generators reached.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/numbering.h"

namespace assay::properties {

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
  std::array<BlockCount, all_values<PairBlock>.size()> blocks_;
};

inline void TagTable::add(const std::vector<std::string>& tags, std::uint64_t steps,
                          std::uint64_t collisions) {
  for (const auto& tag : tags) {
    TagCount& count = tags_[tag];
    ++count.cases;
    count.steps += steps;
    count.collisions += collisions;
  }
}

inline void TagTable::add_contacts(const detector::TrianglesView& triangles,
                                   const oracle::StepJudgement& judgement,
                                   std::span<const detector::ViewSign> signs,
                                   std::span<const std::uint8_t> violated) {
  const auto in_vv = [&](std::int32_t t) { return !violated.empty() && violated[at(t)] != 0; };
  for (const auto& contact : judgement.pairs) {
    const auto [a, b] = contact.pair;
    const PairBlock block = block_of(signs[at(a)], signs[at(b)], in_vv(a) || in_vv(b));
    BlockCount& count = blocks_[static_cast<std::size_t>(block)];
    const auto shared =
        static_cast<std::size_t>(std::min(shared_vertices(triangles, contact.pair), 2));
    ++count.contacts[shared];
    if (contact.time == judgement.first) ++count.first_contacts[shared];
  }
}

inline void TagTable::merge(const TagTable& other) {
  for (const auto& [tag, count] : other.tags_) {
    TagCount& own = tags_[tag];
    own.cases += count.cases;
    own.steps += count.steps;
    own.collisions += count.collisions;
  }
  for (std::size_t b = 0; b < all_values<PairBlock>.size(); ++b) {
    for (std::size_t i = 0; i < 3; ++i) {
      blocks_[b].contacts[i] += other.blocks_[b].contacts[i];
      blocks_[b].first_contacts[i] += other.blocks_[b].first_contacts[i];
    }
  }
}

inline std::string TagTable::text() const {
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{:<28} {:>9} {:>9} {:>10}\n", "tag", "cases", "steps", "collisions");
  for (const auto& [tag, count] : tags_) {
    fmt::format_to(to, "{:<28} {:>9} {:>9} {:>10}\n", tag, count.cases, count.steps,
                   count.collisions);
  }
  fmt::format_to(to, "\n{:<8} {:>32} {:>32}\n{:<8} {:>32} {:>32}\n", "pairs", "contacts",
                 "first contacts", "of", "apart / at a vertex / at an edge",
                 "apart / at a vertex / at an edge");
  for (std::size_t b = 0; b < all_values<PairBlock>.size(); ++b) {
    const auto row = [](const std::array<std::uint64_t, 3>& n) {
      return fmt::format("{} / {} / {}", n[0], n[1], n[2]);
    };
    fmt::format_to(to, "{:<8} {:>32} {:>32}\n", name_of(static_cast<PairBlock>(b)),
                   row(blocks_[b].contacts), row(blocks_[b].first_contacts));
  }
  return out;
}

}  // namespace assay::properties
