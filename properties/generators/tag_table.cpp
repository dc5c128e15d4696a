#include "properties/generators/tag_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "properties/claims/claims.h"
#include "properties/numbering.h"

namespace assay::properties {

using detector::ViewSign;

const char* name_of(PairBlock block) {
  constexpr const char* names[pair_blocks] = {"V+ V-",  "V+ V0", "V- V0", "V0 V0",
                                              "Vv any", "V+ V+", "V- V-"};
  return names[static_cast<std::size_t>(block)];
}

PairBlock block_of(ViewSign a, ViewSign b, bool either_violated) {
  if (either_violated) return PairBlock::violated;
  if (a == ViewSign::zero && b == ViewSign::zero) return PairBlock::zero_zero;
  if (a == ViewSign::zero || b == ViewSign::zero) {
    const ViewSign other = a == ViewSign::zero ? b : a;
    return other == ViewSign::positive ? PairBlock::positive_zero : PairBlock::negative_zero;
  }
  if (a != b) return PairBlock::positive_negative;
  return a == ViewSign::positive ? PairBlock::positive_positive : PairBlock::negative_negative;
}

void TagTable::add(const std::vector<std::string>& tags, std::uint64_t steps,
                   std::uint64_t collisions) {
  for (const auto& tag : tags) {
    TagCount& count = tags_[tag];
    ++count.cases;
    count.steps += steps;
    count.collisions += collisions;
  }
}

void TagTable::add_contacts(const detector::TrianglesView& triangles,
                            const oracle::StepJudgement& judgement, std::span<const ViewSign> signs,
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

void TagTable::merge(const TagTable& other) {
  for (const auto& [tag, count] : other.tags_) {
    TagCount& own = tags_[tag];
    own.cases += count.cases;
    own.steps += count.steps;
    own.collisions += count.collisions;
  }
  for (std::size_t b = 0; b < pair_blocks; ++b) {
    for (std::size_t i = 0; i < 3; ++i) {
      blocks_[b].contacts[i] += other.blocks_[b].contacts[i];
      blocks_[b].first_contacts[i] += other.blocks_[b].first_contacts[i];
    }
  }
}

std::string TagTable::text() const {
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
  for (std::size_t b = 0; b < pair_blocks; ++b) {
    const auto row = [](const std::array<std::uint64_t, 3>& n) {
      return fmt::format("{} / {} / {}", n[0], n[1], n[2]);
    };
    fmt::format_to(to, "{:<8} {:>32} {:>32}\n", name_of(static_cast<PairBlock>(b)),
                   row(blocks_[b].contacts), row(blocks_[b].first_contacts));
  }
  return out;
}

}  // namespace assay::properties
