// `assay certify` and `assay verify` through the program: their verdicts, and that all tampering is
// found.
#include "reports/certificate/statement.h"
#include "tests/reports/json_schema.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;
using reports::verify_certificate;

class Certify : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out", certificate = out + "/certificate.json";
  std::string plan = scratch.write(
      "plan.json", plan_text(12, R"(, "shrink_share": 0.4, "policy": {"self_test_queries": 20})"));

  Outcome certify(const std::string& more = "") const {
    return run_assay("certify --campaign " + plan + " --out " + out + " " + more);
  }
  // How the line of a failure ends in the folder of the certificate. Where a certificate tells its
  // library by name alone, that is put beside it.
  int replayed_beside(const Json& failure, const std::string& library) const {
    const auto beside = out + "/plugin_" + library + ".so";
    std::filesystem::remove(beside);
    std::filesystem::create_symlink(plugin(library), beside);
    const auto line = failure["replay"].get<std::string>();
    const std::string verb = "assay replay ", option = " --detector ", way = told_plugins(out);
    EXPECT_TRUE(line.starts_with(verb)) << line;
    EXPECT_TRUE(line.ends_with(option + way + "plugin_" + library + ".so")) << line;
    const auto words = line.substr(verb.size(), line.rfind(option) - verb.size());
    return run_assay("replay " + words + option + (way.empty() ? "./" : way) + "plugin_" + library +
                         ".so",
                     "cd " + out + " && ")
        .exit_code;
  }
  static void write(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
  }
};

// Too little for it is one line, and no certificate.
TEST_F(Certify, UnderLimitsOfTheUserIsRefusedInALine) {
  for (const std::string limit : {"--fsize=8192", "--as=40000000"}) {
    SCOPED_TRACE(limit);
    expect_one_line(
        run_assay("certify --campaign " + plan + " --out " + out, "prlimit " + limit + " "));
    EXPECT_FALSE(std::filesystem::exists(certificate));
    std::filesystem::remove_all(out);
  }
}

// Another value of the same kind.
Json changed(const Json& value) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_number_float()) return value.get<double>() * 0.5 + 0.25;
  if (value.is_number()) return value.get<std::int64_t>() + 1;
  if (value.is_string()) return value.get<std::string>() + "x";
  return "x";  // null, and what is empty
}

void expect_tampering_is_seen(const std::string& file, const std::string& certificate) {
  const std::string whole = read_text(file);
  ASSERT_FALSE(whole.empty()) << file;
  // First, last and some between; of a store all kinds of pages.
  constexpr std::size_t places = 12;
  for (std::size_t i = 0; i <= places; ++i) {
    std::string bytes = whole;
    const std::size_t at = (whole.size() - 1) * i / places;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    EXPECT_FALSE(verify_certificate(certificate).differences.empty()) << file << " byte " << at;
  }
  std::filesystem::remove(file);
  EXPECT_FALSE(verify_certificate(certificate).differences.empty()) << file << " removed";
  std::ofstream(file, std::ios::binary | std::ios::trunc) << whole;
}

// The files beside it are those of tampering_test.cpp.
TEST_F(Certify, ACertificateVerifiesAndNoFieldCanBeChanged) {
  // Beside the usual strata those of what the built-in detector alone is asked.
  auto campaign = Json::parse(read_text(plan));
  for (const char* question : {"limits", "within"})
    campaign["strata"].push_back({{"family", question}, {"cases", 12}});
  plan = scratch.write("plan.json", campaign.dump());
  const auto made = expect_ended(
      certify(), 0,
      {"curated cases      each of 6 ", "breathing-sphere   each of 10 ", "speed (a ratio)",
       "self-test of the oracle: 0 contradictions", "verdict: certified in ", "/assay verify "});
  const Json statement = read_json(certificate);
  EXPECT_EQ(statement["_type"], "https://in-toto.io/Statement/v1");
  EXPECT_EQ(statement["predicateType"], "urn:assay:certificate:8");
  EXPECT_EQ(statement["subject"][0]["digest"]["sha256"].get<std::string>().size(), 64u);
  const Json& p = statement["predicate"];
  EXPECT_EQ(p["verdict"], "certified");
  EXPECT_TRUE(p["harness_problems"].empty()) << p["harness_problems"];
  EXPECT_EQ(p["strata"][0]["trials"], 12);
  EXPECT_EQ(p["strata"][0]["distinct"], 12);
  EXPECT_EQ(p["strata"][0]["discards"], 0);
  for (const std::size_t s : {3, 4}) {
    const auto& stratum = p["strata"][s];
    ASSERT_EQ(stratum["bounds"].size(), 1u) << stratum;
    EXPECT_EQ(stratum["bounds"][0]["configuration"], stratum["family"]);
    EXPECT_EQ(stratum["bounds"][0]["n"], 12);
    EXPECT_LT(stratum["bounds"][0]["bound"], 1);
    const auto& asked = p["detector"]["configurations"][7 + s];
    EXPECT_EQ(asked["name"], stratum["family"]);
    EXPECT_EQ(asked["claims"].size(), 12u) << asked;
    const auto name = stratum["family"].get<std::string>();
    EXPECT_TRUE(contains(read_text(out + "/summary.md"), "| " + name + " |")) << name;
    EXPECT_TRUE(contains(read_text(out + "/junit.xml"), name + ", " + name)) << name;
    EXPECT_TRUE(contains(made.out, name + std::string(25 - name.size(), ' ') + name)) << made.out;
  }
  EXPECT_TRUE(contains(p["judged_up_to"].dump(), "path-free")) << p["judged_up_to"];
  EXPECT_EQ(p["times"]["speed"].size(), 3u);
  EXPECT_TRUE(contains(read_text(out + "/summary.md"), "## Assay: certified"));
  EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "failures=\"0\""));
  const auto verified = expect_ended("verify " + certificate, 0, {"verified: tiny of "});

  expect_certificate_schema(statement);

  // Every leaf: those that lie so far apart in the file are changed together, and each has a line.
  const std::string whole = read_text(certificate);
  const Json leaves = statement.flatten();
  constexpr std::size_t apart = 40;
  EXPECT_GT(leaves.size(), 10 * apart);
  for (std::size_t first = 0; first < apart; ++first) {
    Json tampered = statement;
    std::vector<std::string> places;
    std::size_t leaf = 0;
    for (const auto& [place, value] : leaves.items()) {
      if (leaf++ % apart != first) continue;
      tampered[Json::json_pointer(place)] = changed(value);
      places.push_back(place);
    }
    write(certificate, tampered.dump(1) + "\n");
    const auto lines = verify_certificate(certificate).differences;
    ASSERT_EQ(lines.size(), places.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      EXPECT_TRUE(lines[i].starts_with(places[i] + ": ")) << places[i] << ": " << lines[i];
  }
  // A field too many, one too few, another layout, no JSON at all.
  Json more = statement, less = statement;
  more["predicate"]["more"] = 1;
  less["predicate"].erase("digests");
  for (const std::string& text : {more.dump(1) + "\n", less.dump(1) + "\n", statement.dump(),
                                  std::string("{"), std::string()}) {
    write(certificate, text);
    EXPECT_FALSE(verify_certificate(certificate).differences.empty());
  }
  write(certificate, changed(Json(whole)));
  expect_ended("verify " + certificate, 1, {"NOT VERIFIED: "});
  write(certificate, whole);

  // The trials again, some of them and all.
  const auto some = expect_ended("verify --again 0.3 --seed 7 " + certificate, 0,
                                 {"again: 15 of 48 trials, seed 7: all results are as stored\n"});
  EXPECT_EQ(run_assay("verify --again 0.3 --seed 7 " + certificate).out, some.out);
  expect_ended("verify --again 1 " + certificate, 0, {"again: 48 of 48 trials, seed "});

  // The same again: the same but for times.
  expect_ended(certify(), 0);
  Json first = statement, second = read_json(certificate);
  EXPECT_NE(first, second);
  for (Json* s : {&first, &second}) (*s)["predicate"].erase("times");
  EXPECT_EQ(first, second);

  // What is beside it and is of no digest is named.
  EXPECT_FALSE(contains(verified.out, "not examined"));
  write(out + "/page.html", "anything");
  expect_ended("verify " + certificate, 0, {"these files, so they were not examined: page.html\n"});
  std::filesystem::remove(out + "/page.html");

  // In another folder: digests are of rows and bytes, not of places.
  const std::string elsewhere = scratch / "some/where else";
  expect_ended("certify --campaign " + plan + " --out '" + elsewhere + "'", 0);
  EXPECT_EQ(predicate_in(elsewhere)["digests"], p["digests"]);

  // Its folder stands for it. Alone, as it is sent by mail, it is no defect, and says what it
  // lacks.
  EXPECT_EQ(run_assay("verify " + out).exit_code, 0);
  const auto alone = scratch.write("certificate.json", read_text(certificate));
  for (const auto& command : {"verify " + alone, "verify " + (scratch / ""),
                              "report " + (scratch / "") + " --out " + (scratch / "p.html"),
                              "report " + alone + " --out " + (scratch / "p.html")})
    expect_refused(command, "are not beside it: ask its issuer for the whole folder");
  const auto of_check = scratch.write("o.json", R"({"schema": "assay-check/1"})");
  expect_refused("report " + of_check + " --out " + (scratch / "p.html"),
                 "schema \"assay-check/1\" is neither a certificate nor a run");
}

TEST_F(Certify, ADefectIsNamedWithAMeshThatReplays) {
  expect_ended(certify("--detector " + plugin("always_free")), 1, {"verdict: defect in "});
  const Json statement = read_json(certificate), &p = statement["predicate"];
  expect_certificate_schema(statement);
  EXPECT_EQ(p["verdict"], "defect");
  EXPECT_EQ(p["failed_gate"], "corpus");
  EXPECT_EQ(p["gates"][2]["gate"], "claims");
  EXPECT_EQ(p["gates"][2]["state"], "fails");
  ASSERT_FALSE(p["failures"].empty());
  const Json& failure = p["failures"][0];
  EXPECT_EQ(failure["claim"], "free-sound");
  EXPECT_LE(failure["after"]["triangles"].get<int>(), failure["before"]["triangles"].get<int>());
  const auto replay = failure["replay"].get<std::string>();
  // A line for the folder of the certificate, wherever that lies.
  ASSERT_TRUE(replay.starts_with("assay replay failures/")) << replay;
  EXPECT_EQ(replayed_beside(failure, "always_free"), 1) << replay;
  EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "in the folder of the run: " + replay));
  EXPECT_TRUE(contains(read_text(out + "/summary.md"), replay));
  for (const std::string file : {"/certificate.json", "/junit.xml", "/summary.md"})
    EXPECT_FALSE(contains(read_text(out + file), scratch / "")) << file;
  expect_ended("verify " + certificate, 1, {"verdict defect\n"});
  expect_tampering_is_seen(out + "/" + failure["file"].get<std::string>(), certificate);
}

// Some faults show in a curated case alone: that one is shrunk and shown as a trial's mesh is.
TEST_F(Certify, WhatTheCorpusAloneShowsHasItsMeshToo) {
  const auto made = expect_ended(certify("--detector " + plugin("fault_view-line_one-corner")), 1,
                                 {"\nDEFECT ", "  case corpus/M_Leither: "});
  const Json statement = read_json(certificate), &p = statement["predicate"];
  expect_certificate_schema(statement);
  EXPECT_EQ(p["failed_gate"], "corpus");
  EXPECT_EQ(p["gates"][0]["state"], "holds") << "no defect of a trial";
  EXPECT_EQ(p["gates"][2]["state"], "holds");
  ASSERT_EQ(p["failures"].size(), 1u);
  const Json& failure = p["failures"][0];
  EXPECT_EQ(failure["met"], 0);
  EXPECT_EQ(failure["case"], "corpus/M_Leither");
  ASSERT_FALSE(failure["after"].is_null());
  EXPECT_LT(failure["after"]["triangles"].get<int>(), failure["before"]["triangles"].get<int>());
  EXPECT_EQ(replayed_beside(failure, "fault_view-line_one-corner"), 1);
  EXPECT_TRUE(contains(read_text(out + "/summary.md"), "met only in the corpus"));
  expect_ended("verify " + certificate, 1, {"verdict defect\n"});
  const auto page = scratch / "page.html";
  ASSERT_EQ(run_assay("report " + out + " --out " + page).exit_code, 0);
  expect_says(read_text(page), {failure["signature"].get<std::string>(), "\"scene\":{"});

  // Once more: what is shrunk already stays as it is.
  ASSERT_EQ(certify("--detector " + plugin("fault_view-line_one-corner")).exit_code, 1);
  EXPECT_EQ(predicate_in(out)["failures"], p["failures"]);
}

TEST_F(Certify, ACertificateOfAnOlderSchemaIsRefusedByName) {
  Json old;
  old["predicate"]["schema"] = "assay-certificate/1";
  std::filesystem::create_directories(out);
  write(certificate, old.dump(1) + "\n");
  expect_ended("verify " + certificate, 1,
               {"its schema is assay-certificate/1, this assay verifies "
                "assay-certificate/8: use the assay that issued the certificate"});
}

TEST_F(Certify, BadInputIsOneLine) {
  expect_refused("certify", "--out");
  expect_refused(certify("--frobnicate"), "frobnicate");
  expect_refused("certify --campaign nowhere --out " + out, "nowhere");
  expect_refused("verify " + scratch / "none.json", "no such file");
  expect_refused("verify", "CERTIFICATE is required");
  expect_refused("verify --again 0 " + plan, "--again");
  expect_refused("verify --again 1.5 " + plan, "--again");
  expect_refused("verify --seed 3 " + plan, "--again");
}

}  // namespace
}  // namespace assay::tests
