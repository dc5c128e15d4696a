// Man pages and completion, as `assay help --write` writes them.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Pages : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_EQ(run_assay("help --write " + (folder / "")).exit_code, 0);
  }

  // What a shell prints; `command` is quoted by nobody, so it stands in a file.
  static std::string printed_by(const std::string& shell, const std::string& command) {
    const auto script = folder.write("script", command);
    const auto out = folder / "printed";
    EXPECT_EQ(std::system((shell + " " + script + " >" + out + " 2>&1").c_str()), 0)
        << read_text(out);
    return read_text(out);
  }
  static bool has(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
  }
  static std::vector<std::filesystem::path> man_pages() {
    std::vector<std::filesystem::path> pages;
    for (const auto& file : std::filesystem::directory_iterator(folder / "man"))
      pages.push_back(file.path());
    std::sort(pages.begin(), pages.end());
    return pages;
  }
  // What bash offers for the last of the words.
  static std::string completed(const std::string& words) {
    return printed_by("bash", "set -u\nsource " + (folder / "completion/assay.bash") +
                                  "\nCOMP_WORDS=(" + words + ")\n" +
                                  "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_assay\n" +
                                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  }
  static inline const Scratch folder;
};

TEST_F(Pages, ThereIsOneOfEachVerb) {
  EXPECT_EQ(man_pages().size(), 19u);
  const auto all = read_text(folder / "man/assay.1");
  for (const auto& page : man_pages()) {
    const auto text = read_text(page.string());
    EXPECT_EQ(text.rfind(".TH ASSAY", 0), 0u);
    const auto verb = page.stem().string();
    if (verb == "assay") continue;
    std::string name = verb;
    for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2)
      name.insert(at, "\\");
    EXPECT_TRUE(contains(all, ".BR " + name + " (1)")) << name;
    for (const std::string section : {"SYNOPSIS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"})
      EXPECT_TRUE(contains(text, "\n.SH " + section + "\n")) << verb;
  }
  EXPECT_TRUE(contains(read_text(folder / "man/assay-check.1"), "\\-\\-fail\\-on\\-collision"));
}

TEST_F(Pages, FormattersHaveNothingToSay) {
  if (!has("groff")) GTEST_SKIP() << "no groff";
  for (const auto& page : man_pages()) {
    SCOPED_TRACE(page);
    const auto warned =
        printed_by("bash", "groff -man -Tutf8 -ww -z " + page.string() + " 2>&1\n" +
                               (has("mandoc") ? "mandoc -Tlint -Wwarning " + page.string() : ""));
    EXPECT_EQ(warned, "");
  }
  const auto shown = printed_by(
      "bash", "groff -P-c -man -Tascii " + (folder / "man/assay-check.1") + " | sed 's/.\\x08//g'");
  EXPECT_TRUE(contains(shown, "--culling WORD")) << shown;
}

TEST_F(Pages, BashCompletesVerbsOptionsAndTheirWords) {
  EXPECT_EQ(completed("assay che"), "check\ncheck-queries\n");
  EXPECT_EQ(completed("assay vers"), "version\n");
  EXPECT_EQ(completed("assay help verify-"), "verify-vectors\n");
  EXPECT_EQ(completed("assay run --cam"), "--campaign\n");
  EXPECT_EQ(completed("assay run --campaign ni"), "nightly\n");
  EXPECT_EQ(completed("assay certify --seed 3 --campaign sm"), "smoke\n");
  EXPECT_EQ(completed("assay check a.obj --culling view-"), "view-auto\nview-point\nview-line\n");
  EXPECT_EQ(completed("assay scene twi"), "twist\n");
  EXPECT_EQ(completed("assay list fa"), "faults\nfailures\n");
  EXPECT_EQ(completed("assay bench --suite seq"), "sequences\n");
  const auto options = completed("assay merge --");
  EXPECT_TRUE(contains(options, "--out\n")) << options;
  EXPECT_FALSE(contains(options, "--campaign\n")) << options;
}

TEST_F(Pages, BashCompletesFilesAndFolders) {
  const Scratch scratch;
  scratch.write("frame_1.obj", "");
  std::filesystem::create_directory(scratch / "frames");
  EXPECT_EQ(completed("assay check " + (scratch / "frame_")), (scratch / "frame_1.obj") + "\n");
  EXPECT_EQ(completed("assay merge --out " + (scratch / "fr")), (scratch / "frames") + "\n");
  EXPECT_EQ(completed("assay run --campaign " + (scratch / "frame_")),
            (scratch / "frame_1.obj") + "\n");
}

TEST_F(Pages, ZshReadsItsScript) {
  if (!has("zsh")) GTEST_SKIP() << "no zsh";
  // The functions of zsh's own completion are replaced by ones that print what they are told.
  const auto told = printed_by("zsh", R"(_describe() { print -l "describe $1" }
_arguments() { print -l -- "$@" }
_files() { }
words=(assay run --cam) CURRENT=3
source )" + (folder / "completion/_assay") +
                                          "\nwords=(assay ch) CURRENT=2\n_assay\n");
  EXPECT_TRUE(contains(told, "--campaign[")) << told;
  EXPECT_TRUE(contains(told, "(smoke quick nightly release faults)")) << told;
  EXPECT_TRUE(contains(told, "describe verb")) << told;
}

TEST_F(Pages, AreRefusedWhereNothingCanBeWritten) {
  expect_refused(run_assay("help --write /proc/nowhere"), "/proc/nowhere/man: cannot be made");
}

}  // namespace
}  // namespace assay::tests
