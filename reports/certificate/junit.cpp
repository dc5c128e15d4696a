#include "reports/certificate/junit.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "reports/certificate/summary.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& word) { return word.get<std::string>(); }

struct TestCase {
  std::string name;
  std::optional<std::string> failure, skipped;  // why
};

struct Suite {
  std::string name;
  std::vector<TestCase> cases;
};

Suite gates_suite(const Json& p) {
  Suite suite{"gates", {}};
  for (const auto& gate : p["gates"]) {
    std::string reasons;
    for (const auto& reason : gate["reasons"]) reasons += text(reason) + "\n";
    TestCase test{text(gate["gate"]), {}, {}};
    if (gate["state"] == "fails") {
      test.failure = reasons;
    } else if (gate["state"] == "not judged") {
      test.skipped = "not judged: " + reasons;
    }
    suite.cases.push_back(std::move(test));
  }
  return suite;
}

bool gate_fails(const Json& p, std::string_view name) {
  for (const auto& gate : p["gates"]) {
    if (gate["gate"] == name) return gate["state"] == "fails";
  }
  return false;
}

// A stratum fails for what makes a gate fail: its defects if the claims do not hold, and its bound
// if the bounds are not met.
Suite strata_suite(const Json& p) {
  Suite suite{"strata", {}};
  const bool claims_fail = gate_fails(p, "claims"), bounds_fail = gate_fails(p, "bounds");
  for (const auto& stratum : p["strata"]) {
    for (const auto& bound : stratum["bounds"]) {
      const auto count = [&](const char* name) { return bound[name].get<std::uint64_t>(); };
      const auto counts = fmt::format(
          "{} of {} trials hold, {} defects, {} undecided; bound {:.2e}", count("holds"),
          count("n"), count("defects"), count("undecided"), bound["bound"].get<double>());
      TestCase test{text(stratum["family"]) + ", " + text(bound["configuration"]), {}, {}};
      if ((claims_fail && count("defects") > 0) || (bounds_fail && !bound["met"].get<bool>())) {
        test.failure = counts;
      } else if (count("n") == 0) {
        test.skipped = "no trial";
      }
      suite.cases.push_back(std::move(test));
    }
  }
  return suite;
}

Suite laws_suite(const Json& p) {
  Suite suite{"laws", {}};
  if (p["laws"].is_null()) return suite;
  for (const auto& law : p["laws"]["laws"]) {
    const auto broken = law["broken"].get<std::uint64_t>();
    TestCase test{text(law["law"]), {}, {}};
    if (broken > 0) {
      test.failure = fmt::format("broken in {} steps", broken);
    } else if (law["premises"] == 0) {
      test.skipped = "its premise never held";
    }
    suite.cases.push_back(std::move(test));
  }
  return suite;
}

// Planted faults have to be found, and equivalent ones must not be.
Suite faults_suite(const Json& p) {
  Suite suite{"faults", {}};
  for (const auto& fault : p["power"]["faults"]) {
    const bool found = fault["found"].get<bool>();
    TestCase test{text(fault["fault"]), {}, {}};
    if (fault["status"] == "planted" && !found) {
      const auto why =
          fmt::format("not found within {} cases", fault["cases"].get<std::uint64_t>());
      // The policy of the plan may ask for less than all of them, so this fault fails only if the
      // gate fails.
      (gate_fails(p, "harness") && !fault["time_over"].get<bool>() ? test.failure : test.skipped) =
          why;
    } else if (fault["status"] == "equivalent" && found) {
      test.failure = "found, but registered as equivalent";
    } else if (fault["status"] == "open" && !found) {
      test.skipped = "open: no case is known that shows it";
    }
    suite.cases.push_back(std::move(test));
  }
  return suite;
}

Suite corpus_suite(const Json& p) {
  Suite suite{"corpus", {}};
  for (const auto& row : p["corpus"]) {
    std::string failed, waived;
    for (const auto& line : row["failed"])
      (line["waived"].get<bool>() ? waived : failed) +=
          fmt::format("{}: {}\n", text(line["id"]), text(line["what"]));
    TestCase test{text(row["input"]) + ", " + text(row["configuration"]), {}, {}};
    if (!failed.empty()) {
      test.failure = failed;
    } else if (!waived.empty()) {
      test.skipped = "waived: " + waived;
    }
    suite.cases.push_back(std::move(test));
  }
  return suite;
}

Suite failures_suite(const Json& p) {
  Suite suite{"failures", {}};
  for (const auto& failure : p["failures"]) {
    const auto line =
        fmt::format("{} ({}), {}; {}\n", text(failure["what"]), text(failure["configuration"]),
                    met_text(failure), text(failure["case"]));
    TestCase test{text(failure["signature"]), {}, {}};
    if (failure["waived"].get<bool>()) {
      test.skipped = "waived: " + line;
    } else {
      test.failure = line + "replay: " + text(failure["replay"]);
    }
    suite.cases.push_back(std::move(test));
  }
  return suite;
}

std::string xml_of(const Suite& suite) {
  std::size_t failures = 0, skipped = 0;
  std::string cases;
  for (const auto& test : suite.cases) {
    const auto head = fmt::format("    <testcase classname=\"assay.{}\" name=\"{}\"", suite.name,
                                  xml_escaped(test.name));
    const auto& why = test.failure ? test.failure : test.skipped;
    if (!why) {
      cases += head + "/>\n";
      continue;
    }
    (test.failure ? failures : skipped) += 1;
    const char* element = test.failure ? "failure" : "skipped";
    const std::string first = why->substr(0, why->find('\n'));
    cases += fmt::format("{}>\n      <{} message=\"{}\">{}</{}>\n    </testcase>\n", head, element,
                         xml_escaped(first), xml_escaped(*why), element);
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}  </testsuite>\n",
      suite.name, suite.cases.size(), failures, skipped, cases);
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  static const std::map<char, std::string_view> written = [] {
    std::map<char, std::string_view> all = {
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    for (char control = 0; control < ' '; ++control) {
      if (control != '\n' && control != '\t') all[control] = "?";
    }
    return all;
  }();
  return replaced(text, written);
}

std::string junit_text(const Json& predicate) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"assay\">\n";
  for (const auto make :
       {gates_suite, strata_suite, laws_suite, faults_suite, corpus_suite, failures_suite}) {
    const Suite suite = make(predicate);
    if (!suite.cases.empty()) out += xml_of(suite);
  }
  return out + "</testsuites>\n";
}

}  // namespace assay::reports
