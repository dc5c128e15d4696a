// Waivers of known failures: what the file must hold, and until when.
#include "reports/campaign/own_cases.h"
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

const std::string whole = R"({"schema": "assay-known/1", "waivers": [
  {"signature": "all-pairs: missing", "reason": "r", "link": "l", "expires": "2026-12-31"}]})";

class Waivers : public testing::Test {
 protected:
  auto read(const std::string& text) const { return read_waivers(scratch.write("k.json", text)); }
  // The file with one word in place of another is refused, in a line that says why.
  void expect_wrong(const std::string& word, const std::string& other,
                    const std::string& why) const {
    auto text = whole;
    text.replace(text.find(word), word.size(), other);
    const auto waivers = read(text);
    ASSERT_FALSE(waivers) << text;
    EXPECT_NE(waivers.error().message.find(why), std::string::npos) << waivers.error().message;
    EXPECT_EQ(waivers.error().message.find('\n'), std::string::npos);
  }
  const tests::Scratch scratch;
};

TEST_F(Waivers, SayWhatWhyWhereAndUntilWhen) {
  const auto waivers = read(whole);
  ASSERT_TRUE(waivers) << waivers.error().message;
  ASSERT_EQ(waivers.value().size(), 1u);
  const auto& waiver = waivers.value()[0];
  EXPECT_EQ(waiver.signature, "all-pairs: missing");
  EXPECT_EQ(waiver.reason, "r");
  EXPECT_EQ(waiver.link, "l");
  EXPECT_FALSE(is_expired(waiver, "2026-12-30"));
  EXPECT_FALSE(is_expired(waiver, "2026-12-31"));
  EXPECT_TRUE(is_expired(waiver, "2027-01-01"));
}

TEST_F(Waivers, OneThatIsNotWholeIsRefused) {
  expect_wrong("assay-known/1", "assay-known/2", "assay-known/1 expected");
  for (const std::string field : {"signature", "reason", "link", "expires"}) {
    expect_wrong("\"" + field + "\"", "\"other\"", "no field 'other'");
  }
  expect_wrong(R"("reason": "r", )", "", "reason is missing");
  expect_wrong(R"("reason": "r")", R"("reason": "")", "some text expected");
  for (const std::string day : {"2026-13-01", "2026-02-30", "tomorrow", "2026-1-1", "20261231"}) {
    expect_wrong("2026-12-31", day, "YYYY-MM-DD");
  }
  auto twice = whole;
  const auto begin = twice.find("{\"signature"), end = twice.find("}]") + 1;
  twice.insert(end, ", " + twice.substr(begin, end - begin));
  const auto waivers = read(twice);
  ASSERT_FALSE(waivers);
  EXPECT_NE(waivers.error().message.find("already"), std::string::npos);
}

TEST(KnownFailures, OfTheCorpusAreReadable) {
  const auto waivers = read_waivers(ASSAY_SOURCE_DIR "/corpus/known.json");
  EXPECT_TRUE(waivers) << waivers.error().message;
}

}  // namespace
}  // namespace assay::reports
