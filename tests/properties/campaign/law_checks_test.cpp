// A crash inside a law is a broken law, and nothing else is lost by it.
#include <csignal>
#include <new>

#include "properties/campaign/trials/case_tally.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

const LawTally held{7, 2, 0, ""};

std::vector<LawTally> checks_with(std::size_t count, std::size_t bad,
                                  const std::function<void()>& what_it_does) {
  return check_in_copies(
      count, [](std::size_t) { return "a:1:b:2"; },
      [&](std::size_t i) {
        if (i == bad) what_it_does();
        return held;
      });
}

TEST(LawChecks, ACrashBreaksTheLawAndNoOther) {
  const auto tallies = checks_with(4, 1, [] { std::abort(); });
  const LawTally crashed{1, 0, 1, "a:1:b:2: the check ended: killed by signal 6 (Aborted)"};
  EXPECT_EQ(tallies, (std::vector<LawTally>{held, crashed, held, held}));
}

TEST(LawChecks, AnExitIsACrashToo) {
  for (const int code : {0, 3}) {
    const auto tallies = checks_with(3, 2, [&] { std::_Exit(code); });
    ASSERT_EQ(tallies.size(), 3u);
    EXPECT_EQ(tallies[2].broken, 1u);
    EXPECT_TRUE(says(tallies[2].first_broken, "exited with code " + std::to_string(code)));
  }
}

TEST(LawChecks, NumbersAndWordsArrive) {
  const LawTally broken{1ull << 60, 3, 2, "case \"x\", step 1:\n\xff"};
  const auto tallies = check_in_copies(
      1000, [](std::size_t) { return "c"; },
      [&](std::size_t i) { return i == 998 ? broken : held; });
  ASSERT_EQ(tallies.size(), 1000u);
  EXPECT_EQ(tallies[998].premise, broken.premise);
  EXPECT_TRUE(tallies[998].first_broken.starts_with("case \"x\", step 1:\n"));
  EXPECT_EQ(tallies[999], held);
  EXPECT_TRUE(check_in_copies(0, {}, [](std::size_t) -> LawTally { std::abort(); }).empty());
}

TEST(LawChecks, WhatIsThrownIsThrown) {
  EXPECT_THROW(checks_with(2, 1, [] { throw std::bad_alloc(); }), std::bad_alloc);
  try {
    checks_with(2, 1, [] { throw std::logic_error("no such thing"); });
    FAIL();
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "no such thing");
  }
}

TEST(LawChecks, WhoIsKilledFromOutsideBeginsAgain) {
  // Only a file outlives the copies.
  const tests::Scratch scratch;
  const std::string mark = scratch / "killed once";
  const auto tallies = checks_with(2, 1, [&] {
    if (std::filesystem::exists(mark)) return;
    std::ofstream(mark) << "x";
    std::raise(SIGTERM);
  });
  EXPECT_EQ(tallies, (std::vector<LawTally>{held, held}));
  EXPECT_THROW(checks_with(2, 1, [] { std::raise(SIGKILL); }), std::runtime_error);
}

}  // namespace
}  // namespace assay::properties
