// The one header of ours through which rapidcheck runs a law.
//
// rapidcheck draws a 64-bit number, and nothing else: the number and the law's name make a case's
// id, and the id makes the case. Shrinking is off, as it would only make the number smaller
// (minimal meshes are the reducer's). A case that the law does not apply to is discarded.
//
//   LAW_TEST(L3_FirstContactIsACandidate);
//
// RC_PARAMS="seed=... max_success=..." runs other cases or more of them, ASSAY_CASE=ID one alone.
#pragma once

#include <fmt/format.h>
#include <rapidcheck.h>

#include "properties/laws/law.h"
#include "tests/properties/laws/judged_case.h"
#include "tests/test.h"

namespace assay::properties::test {

// Most cases are small: a law is put to large meshes by the campaign.
inline constexpr Eigen::Index most_triangles = 40;

inline const bool parameters_are_set = [] {
  return setenv("RC_PARAMS", "seed=20114 max_success=20 max_discard_ratio=100", 0) == 0;
}();

inline std::string drawn_id(const Law& law, std::uint64_t number) {
  const auto stratum = families()[number % families().size()].name;
  return fmt::format("{}:{}:{}:0", law.name, number, stratum);
}

inline LawTally tally_of(const Law& law, const std::string& id) {
  LawTally tally;
  corpus::Case c = case_of(id).c;
  if (c.triangles.rows() > most_triangles) return tally;
  const JudgedCase judged(std::move(c), setting_for(law, id));
  CaseFacts facts = judged.facts();
  law.check(facts, tally);
  if (tally.broken != 0) {
    std::printf("%s\nreplay: ASSAY_CASE=%s ctest --preset law -R Laws.%s\n",
                tally.first_broken.c_str(), id.c_str(), std::string(law.name).c_str());
  }
  return tally;
}

inline void run_law(std::string_view name) {
  const Law* law = law_named(name);
  ASSERT_NE(law, nullptr);
  if (const char* only = std::getenv("ASSAY_CASE")) {
    const LawTally tally = tally_of(*law, only);
    EXPECT_GT(tally.premise, 0u) << "the law does not apply to this case";
    EXPECT_EQ(tally.broken, 0u) << tally.first_broken;
    return;
  }
  LawTally sum;
  std::uint64_t cases = 0;
  const bool holds = rc::check(std::string(law->statement), [&] {
    // Of the full size from the first draw on: all bits of the number are random.
    const auto number =
        *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
    const LawTally tally = tally_of(*law, drawn_id(*law, number));
    ++cases;
    sum += tally;
    RC_PRE(tally.premise > 0u);
    RC_ASSERT(tally.broken == 0u);
  });
  std::printf("%llu cases, premise %llu times, close %llu times\n",
              static_cast<unsigned long long>(cases), static_cast<unsigned long long>(sum.premise),
              static_cast<unsigned long long>(sum.close));
  EXPECT_TRUE(holds) << sum.first_broken;
  EXPECT_GT(sum.premise, 0u);
}

}  // namespace assay::properties::test

#define LAW_TEST(name) \
  TEST(Laws, name) { assay::properties::test::run_law(#name); }
