#include "properties/laws/law_table.h"

#include <fmt/format.h>

#include "properties/laws/facts/case_facts.h"
#include "properties/random.h"

namespace assay::properties {

LawTable::LawTable() : tallies_(laws().size()) {}

bool is_checked_on(const Law& law, std::string_view case_id) {
  return Random(Random::hash(case_id), Random::hash(law.name)).one_in(law.one_in);
}

void LawTable::add(CaseFacts& facts) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const Law& law = laws()[i];
    if (is_checked_on(law, facts.source().id)) law.check(facts, tallies_[i]);
  }
}

void LawTable::merge(const LawTable& other) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) tallies_[i] += other.tallies_[i];
}

std::uint64_t LawTable::broken() const {
  std::uint64_t sum = 0;
  for (const auto& tally : tallies_) sum += tally.broken;
  return sum;
}

std::vector<const Law*> LawTable::starved(std::uint64_t premises, double least_close) const {
  std::vector<const Law*> list;
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& [premise, close, broken, first_broken] = tallies_[i];
    const bool rarely_close =
        static_cast<double>(close) < least_close * static_cast<double>(premise);
    if (premise < premises || rarely_close) list.push_back(&laws()[i]);
  }
  return list;
}

std::string LawTable::text() const {
  std::string out = fmt::format("{:<46} {:>9} {:>7} {:>7}\n", "law", "premise", "close", "broken");
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& tally = tallies_[i];
    const double share = tally.premise == 0 ? 0
                                            : 100 * static_cast<double>(tally.close) /
                                                  static_cast<double>(tally.premise);
    out += fmt::format("{:<46} {:>9} {:>5.1f} % {:>7}\n", laws()[i].name, tally.premise, share,
                       tally.broken);
    if (tally.broken != 0) out += fmt::format("    {}\n", tally.first_broken);
  }
  return out;
}

}  // namespace assay::properties
