// Names that are no text, or markup: of a plug-in, of a folder.
#include "properties/words.h"
#include "reports/certificate/verify.h"
#include "tests/reports/certificate/issued_folder.h"

namespace assay::tests {
namespace {

bool holds(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

TEST(Printable, IsUtf8WithoutControlCharacters) {
  const std::string unknown = "\xef\xbf\xbd";
  const std::pair<std::string, std::string> cases[] = {
      {"plain, gr\xc3\xbc\xc3\x9f, \xe2\x82\xac, \xf0\x9f\x90\xa2", ""},
      {"\x1b[31mred\x7f\n", "?[31mred??"},
      {"\xc2\x9b", "?"},
      {"a\xff", "a" + unknown},
      {"\xc3", unknown},                                            // cut
      {"\xc0\xaf", unknown + unknown},                              // too long a form
      {"\xed\xa0\x80", unknown + unknown + unknown},                // a surrogate
      {"\xf4\x90\x80\x80", unknown + unknown + unknown + unknown},  // above U+10FFFF
  };
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(properties::printable(text), expected.empty() ? text : expected);
}

// All the work is done when the certificate is written: no name may end it then.
TEST(OddText, OfAPlugInAndAFolderIsReplacedAndVerifies) {
  const Scratch scratch;
  const auto folder = scratch / "out";
  auto run = RunToStore();
  run.request.detector.name = "bad \xff name";
  run.request.detector.built_in = false;
  run.request.detector.configurations = {{"bad \xfe", {}}};
  run.meet_canary(3).judge("closed-generic", 10, 'H').judge("broken", 10, 'D');
  run.fail("E1_free_membrane", "all-pairs: missing", "what \xfd");
  store_and_issue(run, folder, {scratch / "\xff\xfe", "lib\xfc.so"});
  if (HasFatalFailure()) return;
  const auto text = read_text(folder + "/certificate.json");
  EXPECT_TRUE(nlohmann::ordered_json::accept(text)) << "JSON is UTF-8";
  EXPECT_TRUE(holds(text, "bad \xef\xbf\xbd name"));
  for (const char* file : {"/junit.xml", "/summary.md"}) {
    const auto rendered = read_text(folder + file);
    EXPECT_FALSE(holds(rendered, "\xff") || holds(rendered, "\xfe")) << file;
  }
  // The mesh is not written here: nothing else may be amiss.
  const auto verified = reports::verify_certificate(folder + "/certificate.json");
  ASSERT_EQ(verified.differences.size(), 1u) << verified.differences[1];
  EXPECT_TRUE(holds(verified.differences[0], "failures/")) << verified.differences[0];
}

TEST(OddText, IsNoMarkupInTheSummary) {
  const Scratch scratch;
  auto run = good_run();
  run.request.detector.name = "<img src=x onerror=alert(1)> & | `code` [a](b) *b*";
  store_and_issue(run, scratch / "out", {"out", ""});
  const auto summary = read_text(scratch / "out/summary.md");
  EXPECT_FALSE(holds(summary, "<")) << summary;
  EXPECT_TRUE(holds(summary,
                    "&lt;img src=x onerror=alert(1)&gt; &amp; \\| \\`code\\` \\[a\\](b) "
                    "\\*b\\*"))
      << summary;
}

}  // namespace
}  // namespace assay::tests
