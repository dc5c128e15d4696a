// `assay run` whose workers are killed from outside: it has the same results, and says that it was
// disturbed.
#include <sys/syscall.h>

#include "properties/random.h"
#include "tests/reports/campaign/started.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// Whether a process is an assay-worker of that host, or bwrap before one, and still alive.
bool is_worker_of(pid_t host, const std::string& process) {
  std::ifstream status("/proc/" + process + "/status");
  bool is_worker = false, is_alive = true, is_child = false;
  for (std::string line; std::getline(status, line);) {
    is_worker |= line == "Name:\tassay-worker" || line == "Name:\tbwrap";
    is_alive &= !line.starts_with("State:\tZ") && !line.starts_with("State:\tX");
    is_child |= line == "PPid:\t" + std::to_string(host);
  }
  return is_worker && is_alive && is_child;
}

std::vector<std::string> workers_of(pid_t host) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") == std::string::npos && is_worker_of(host, name))
      found.push_back(name);
  }
  return found;
}

// Signals one of the host's workers and never anything else: the descriptor stands for one process,
// which is looked at once more when it is held. False where there was none to signal.
bool signal_a_worker(pid_t host, int signal, properties::Random& random) {
  const auto workers = workers_of(host);
  if (workers.empty()) return false;
  const auto& worker =
      workers[static_cast<std::size_t>(random.below(static_cast<int>(workers.size())))];
  const auto process = static_cast<int>(syscall(SYS_pidfd_open, std::stoi(worker), 0));
  if (process < 0) return false;
  const bool sent = is_worker_of(host, worker) &&
                    syscall(SYS_pidfd_send_signal, process, signal, nullptr, 0) == 0;
  close(process);
  return sent;
}

// From the gates to the verdict, without the seconds behind it.
std::string judged_part(const std::string& text) {
  const auto from = text.find("\ngate "), to = text.rfind(", in ");
  return from == std::string::npos || to < from ? "" : text.substr(from, to - from);
}

struct Disturbed {
  std::uint64_t trials = 0, times = 0;
};

Disturbed disturbed_in(const std::string& out) {
  Disturbed sum;
  const auto store = value_of(properties::Store::read(out + "/run.sqlite"));
  store.for_each_trial([&](const properties::TrialRecord& trial) {
    sum.trials += trial.disturbed > 0 ? 1 : 0;
    sum.times += trial.disturbed;
  });
  return sum;
}

// None while there is no store yet.
std::uint64_t stored_trials(const std::string& out) {
  const auto store = properties::Store::read(out + "/run.sqlite");
  return store ? store.value().trial_count() : 0;
}

// A family of so many cases and two of half as many; without laws, for a plug-in has none.
std::string long_plan(int cases) { return plan_text(cases, R"(, "laws_every": 0)"); }

// ASSAY_KILLS says how many workers are killed: the test run_disturbed_often asks for 30, the long
// form is 300. The campaign grows with it, because more than 1 % of disturbed trials would rightly
// not hold.
TEST(RunDisturbed, WorkersKilledAtRandomMomentsChangeNeitherVerdictNorTallies) {
  const char* asked = std::getenv("ASSAY_KILLS");
  const int kills = asked ? std::max(1, std::atoi(asked)) : 10;
  const char* chosen = std::getenv("ASSAY_SEED");
  const std::string seed = chosen ? chosen : "1";
  const std::string replay = "ASSAY_SEED=" + seed + " ASSAY_KILLS=" + std::to_string(kills) + " " +
                             program_invocation_name + " --gtest_filter='RunDisturbed.Workers*'";
  SCOPED_TRACE("replay: " + replay);
  properties::Random random(std::strtoull(seed.c_str(), nullptr, 10), 0);

  const Scratch scratch;
  constexpr int cases_a_kill = 100;  // in all families together 200
  const auto plan = scratch.write("plan.json", long_plan(cases_a_kill * kills));
  const std::string out = scratch / "out", undisturbed = scratch / "undisturbed";
  const auto words = [&](const std::string& folder) {
    return std::vector<std::string>{
        "run",   "--campaign", plan, "--jobs", "2", "--detector", plugin("wrapped_builtin"),
        "--out", folder};
  };
  Started reference(words(undisturbed), scratch / "reference");
  const int expected = reference.end();
  const auto expected_text = read_text(scratch / "reference");
  ASSERT_TRUE(WIFEXITED(expected) && WEXITSTATUS(expected) == 0) << expected_text;
  EXPECT_FALSE(contains(expected_text, " ran again")) << "somebody else disturbs this machine";

  // Moments of the run, by its progress and so whatever else the machine does: a number of stored
  // trials, and some milliseconds more. Between two of them the run goes on: what is killed at
  // every attempt has crashed, rightly.
  constexpr double last_share = 0.9, widest = 0.7;
  std::vector<double> moments;
  const auto expected_trials = trials_of(undisturbed);
  const double apart = last_share * static_cast<double>(expected_trials.size()) / kills;
  for (int i = 0; i < kills; ++i) moments.push_back(apart * (i + widest * random.unit()));
  Started started(words(out), scratch / "text");
  std::uint64_t killed = 0;
  double least = 0;  // of stored trials
  for (const double moment : moments) {
    while (!started.has_ended() &&
           static_cast<double>(stored_trials(out)) < std::max(least, moment))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(random.below(20)));
    constexpr int terminated_of = 3;  // one of so many by SIGTERM, as a batch system does
    const int signal = random.one_in(terminated_of) ? SIGTERM : SIGKILL;
    // Just now there may be none: the next one starts soon.
    bool sent = false;
    while (!sent && !started.has_ended()) {
      sent = signal_a_worker(started.id(), signal, random);
      if (!sent) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    least = static_cast<double>(stored_trials(out)) + (1 - widest) * apart;
    killed += sent ? 1 : 0;
  }
  const int status = started.end();
  const auto text = read_text(scratch / "text");
  const auto disturbed = disturbed_in(out);
  EXPECT_EQ(killed, static_cast<std::uint64_t>(kills)) << text;

  ASSERT_TRUE(WIFEXITED(status)) << text;
  EXPECT_EQ(WEXITSTATUS(status), 0) << text;
  EXPECT_EQ(trials_of(out), expected_trials);
  EXPECT_TRUE(signatures_of(out).empty());
  EXPECT_TRUE(contains(judged_part(text), "\nholds: 0 trials with a defect, 0 undecided")) << text;
  EXPECT_EQ(judged_part(text), judged_part(expected_text));
  EXPECT_EQ(read_text(out + "/junit.xml"), read_text(undisturbed + "/junit.xml"));
  // But for the time at which each run was begun.
  const auto summary = [](const std::string& folder) {
    const auto told = read_text(folder + "/summary.md");
    const std::regex begun(" Begun 20[0-9T:-]{17}Z\\.");
    EXPECT_TRUE(std::regex_search(told, begun)) << told;
    return std::regex_replace(told, begun, "");
  };
  EXPECT_EQ(summary(out), summary(undisturbed));
  EXPECT_TRUE(contains(read_text(out + "/summary.md"), "## Assay: holds\n"));

  // What hit the canary, or a worker that had nothing left to do, disturbed no trial.
  EXPECT_GE(disturbed.times, 1u);
  EXPECT_LE(disturbed.times, killed);
  EXPECT_TRUE(says(text, "\n" + std::to_string(disturbed.trials) +
                             " trials ran again: their worker was killed from outside (" +
                             std::to_string(disturbed.times) + " times)\n"));
}

// Plug-ins that end their own process: on one kind of case always, or now and then. None of them is
// ever certified.
class RunSelfKill : public RunFixture {
 protected:
  Outcome verdict(const std::string& name) {
    plan = scratch.write("plan.json", plan_text(100, R"(, "shrink_share": 0.002)"));
    out = scratch / name;
    return run("--jobs 2 --detector " + plugin(name));
  }
};

// On which troubled_builtin.cpp kills itself.
bool is_fatal(std::uint64_t triangles) { return triangles % 5 == 0; }

TEST_F(RunSelfKill, AlwaysOnOneKindOfCaseIsADefectOfTotal) {
  const std::vector<std::pair<std::string, std::string>> ends = {
      {"kills_itself", "killed by signal 9 (Killed), three times in a row"},
      {"terminates_itself", "killed by signal 15 (Terminated), three times in a row"},
      {"segfaults", "killed by signal 11 (Segmentation fault)\n"},
      {"aborts", "killed by signal 6 (Aborted)\n"}};
  for (const auto& [name, how] : ends) {
    SCOPED_TRACE(name);
    const auto ended =
        expect_ended(verdict(name), 1, {"\nDEFECT total: crashed ", "  " + how, "\nDEFECT: "});
    EXPECT_FALSE(contains(ended.out, " ran again")) << ended.out;
    EXPECT_TRUE(contains(read_text(out + "/summary.md"), "## Assay: defect\n"));

    // On that kind of case, on each of them, and on no other.
    const auto store = value_of(properties::Store::read(out + "/run.sqlite"));
    std::uint64_t fatal = 0;
    store.for_each_trial([&](const properties::TrialRecord& trial) {
      EXPECT_EQ(trial.outcomes, is_fatal(trial.triangles) ? "D" : "H") << trial.id;
      fatal += is_fatal(trial.triangles) ? 1 : 0;
    });
    EXPECT_GE(fatal, 10u);
    // Refined, one of the others becomes such a case.
    EXPECT_EQ(signatures_of(out),
              (properties::Counts{{"law L18_RefinedMeshHasTheSameContacts, total: crashed", 1},
                                  {"total: crashed", fatal}}));
  }
}

TEST_F(RunSelfKill, AtRandomDoesNotHoldAndIsNeverCertified) {
  plan = scratch.write("plan.json", plan_text(100, R"(, "shrink_share": 0.002)"));
  const auto made = run_assay("certify --jobs 2 --campaign " + plan + " --out " + out +
                              " --detector " + plugin("killed_at_random"));
  // The third death in a row is the detector's own, be it in the first run of a case or in its
  // second.
  const bool is_defect = contains(made.out, "killed by signal 9 (Killed), three times in a row");
  EXPECT_EQ(made.exit_code, is_defect ? 1 : 3) << made.err;
  expect_says(made.out,
              {" trials ran again: their worker was killed from outside (", "\ncomplete   FAILS\n",
               " of 200 trials were disturbed from outside: more than 1 %\n"});
  EXPECT_EQ(contains(made.out, "\nDEFECT "), is_defect) << made.out;
  EXPECT_FALSE(contains(made.out, "certified")) << made.out;
  const std::string verdict = is_defect ? "defect" : "incomplete";
  expect_says(read_text(out + "/summary.md"), {"## Assay: " + verdict + "\n"});
  const auto p = predicate_in(out);
  EXPECT_EQ(p["verdict"], verdict);
  EXPECT_EQ(p["gates"][3]["gate"], "complete");
  EXPECT_EQ(p["gates"][3]["state"], "fails");
  std::uint64_t disturbed = 0;
  for (const auto& stratum : p["times"]["strata"])
    disturbed += stratum["disturbed"].get<std::uint64_t>();
  EXPECT_GT(disturbed, 2u);
  expect_ended("verify " + out + "/certificate.json", made.exit_code, {"verified: "});
}

}  // namespace
}  // namespace assay::tests
