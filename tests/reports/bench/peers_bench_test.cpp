// `assay bench --suite peers`: small runs with peers whose answers are known, one of which hangs
// and one of which crashes. Also the meshes of corpus/peers, each of which shows the worst miss of
// a peer.
#include "corpus/scenes/scenes.h"
#include "oracle/referee/distance_referee.h"
#include "properties/judging/exam.h"
#include "reports/bench/compared/comparison.h"
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

namespace fs = std::filesystem;

// A folder with these plug-ins of tests/plugins.
void put_peers(const tests::Scratch& scratch, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    const std::string file = "plugin_" + name + ".so";
    fs::copy_file(fs::path(ASSAY_PLUGIN_DIR) / file, fs::path(scratch / file));
  }
}

// One family of two cases: a step that ends in contact, and one that does not.
CaseFamily two_steps(const std::string& kind) {
  return {"steps", kind, 2, [] {
            std::vector<BenchCase> cases;
            for (const int frames : {2, 12}) {
              const auto scene = corpus::make_scene("bend", {320, frames, {}}).value();
              BenchCase timed;
              timed.c.id = frames == 2 ? "to the end" : "the first step";
              timed.c.triangles = scene.triangles;
              timed.c.frames = {scene.frames[0], scene.frames[1]};
              cases.push_back(timed);
            }
            return cases;
          }};
}

struct SmallRun {
  Peers peers;
  BenchReport report = {"peers"};
  std::vector<FamilyRow> families;
  std::vector<UnsafeAnswer> answers;
  std::vector<SubjectRow> rows;
  std::string remarks;

  explicit SmallRun(const std::vector<std::string>& names) {
    const tests::Scratch scratch;
    put_peers(scratch, names);
    peers = find_peers(scratch / "");
    Comparison comparison(peers.subjects, {.small_seconds = .2, .large_seconds = .2}, report);
    comparison.run({two_steps("generated")});
    families = comparison.rows();
    answers = comparison.unsafe();
    rows = by_subject(families, peers.subjects);
    remarks = remarks_text(comparison, peers.absent);
    add_figures(rows, comparison, report);
  }
};

TEST(PeersBench, ThoseOfAFolderStandBesideTheBuiltIn) {
  const SmallRun run({"always_free", "always_collision"});
  EXPECT_TRUE(run.report.wrong_answers.empty());
  EXPECT_FALSE(says(run.remarks, "by the oracle only"));
  ASSERT_EQ(run.rows.size(), 6u + 2u);
  for (const auto& row : run.rows) {
    EXPECT_EQ(row.counts.errors.steps, 2u) << row.subject->name;
    EXPECT_EQ(row.counts.errors.contact, 1u) << row.subject->name;
    ASSERT_TRUE(row.over) << row.subject->name;
    EXPECT_GT(row.over->value, 0);
  }
  const auto& exact = run.rows.front();
  EXPECT_EQ(exact.subject->name, "built-in, exact, bvh");
  EXPECT_EQ(exact.over->value, 1);
  EXPECT_EQ(exact.counts.errors.unsafe + exact.counts.errors.false_alarms, 0u);
  EXPECT_EQ(exact.answers, "answer, time, pairs");
  std::uint64_t missed = 0, confirmed = 0;
  for (const auto& row : run.rows) {
    if (row.subject->detector.built_in) continue;
    EXPECT_EQ(row.counts.errors.false_alarms, row.counts.errors.missed > 0 ? 0u : 1u);
    missed += row.counts.errors.missed;
    confirmed += row.counts.confirmed;
  }
  EXPECT_EQ(missed, 1u);
  EXPECT_EQ(confirmed, 2u) << "what is missed, and the pairs that are not named";
  EXPECT_EQ(std::count_if(run.answers.begin(), run.answers.end(),
                          [](const UnsafeAnswer& one) { return one.defect == "missed"; }),
            1);
}

TEST(PeersBench, OneThatHangsOrCrashesEndsNothingElse) {
  const SmallRun run({"hang", "crash", "always_free", "query_alone"});
  EXPECT_TRUE(run.report.wrong_answers.empty());
  std::uint64_t ended = 0;
  for (const auto& row : run.rows) ended += row.counts.ended;
  EXPECT_GE(ended, 2u) << "the hanging one ends early in each case";
  for (const auto& row : run.rows) {
    if (row.counts.ended < 2) continue;
    EXPECT_EQ(row.counts.errors.undecided, 2u) << row.subject->name;
    EXPECT_FALSE(row.over) << row.subject->name;
  }
  tests::expect_says(run.remarks, {"hung", "absent: plugin_query_alone: it answers no steps",
                                   "absent: fcl_elementary: libfcl-dev was not installed",
                                   "absent: arcsim: its source was not found"});
}

TEST(PeersBench, OneThatIsAskedForADistanceTakesNoPart) {
  const tests::Scratch scratch;
  put_peers(scratch, {"keeps_distance"});
  setenv("ASSAY_KEEPS_DISTANCE", "ours separation=0.01", 1);
  const Peers peers = find_peers(scratch / "");
  unsetenv("ASSAY_KEEPS_DISTANCE");
  EXPECT_EQ(peers.subjects.size(), 6u) << "the built-in ones alone";
  ASSERT_FALSE(peers.absent.empty());
  EXPECT_EQ(peers.absent.front().name, "plugin_keeps_distance");
  EXPECT_EQ(peers.absent.front().why, "it answers about distances");
}

TEST(PeersBench, WhatNobodyPromisedStandsInBrackets) {
  SmallRun run({"always_free"});
  auto modest = *run.rows.back().subject;
  modest.error_claims.set(properties::Claim::free_sound, false);
  run.rows.back().subject = &modest;
  EXPECT_TRUE(says(subjects_text(run.rows, "detector"), "(1)"));
  const auto json = to_json(run.report, "version");
  EXPECT_EQ(json["subjects"].size(), run.rows.size());
  EXPECT_EQ(json["subjects"][0]["time_over_reference"]["median"], 1);
  // A line for each step of each subject that completed it.
  const auto csv = csv_of(run.report);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + 2 * run.rows.size());
}

TEST(PeersBench, AContactIsConfirmedOnlyWhereThereIsOne) {
  // A vertex that falls through a face at t = 0.5, and one that stops before it.
  for (const double end : {-1., .5}) {
    corpus::Case c;
    c.triangles.resize(2, 3);
    c.triangles << 0, 1, 2, 3, 4, 5;
    detector::Positions x(6, 3);
    x << -1, -1, 0, 2, -1, 0, -1, 2, 0, 0, 0, 1, 1, 0, 3, 0, 1, 3;
    c.frames = {x, x};
    c.frames[1](3, 2) = end;
    properties::StepDiff diff;
    diff.answered_free = true;
    diff.first_contact = {{0, 1}, {.5, .5}, {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}}};
    EXPECT_EQ(is_confirmed(c, 0, diff, {}, {}), end < 0);
    // Told too late: a witness before the time told.
    diff.answered_free = false;
    diff.late_first = true;
    detector::StepResult told;
    told.first = {.75, .75};
    EXPECT_EQ(is_confirmed(c, 0, diff, told, {}), end < 0);
    told.first = {.25, .25};
    EXPECT_FALSE(is_confirmed(c, 0, diff, told, {})) << "nothing has happened until then";
  }
}

// Whether the vertex and the face that the oracle finds within 1e-3 of each other, though their
// triangles do not meet, are so near by the referee of distances.
bool comes_within(const corpus::Case& c) {
  properties::Contract keeps_apart;
  keeps_apart.adjacency = properties::Adjacency::no_shared_vertex;
  keeps_apart.separation = 1e-3;
  const auto truth = properties::judge_case(c, keeps_apart);
  const auto& v = truth.at(0).pairs.at(0).feature.vertices;
  const auto step = corpus::steps_of(c)[0];
  const detector::SteppedMesh motion{start_of(c, step), end_of(c, step)};
  const auto path = [&](int i) { return motion.path(v[i]); };
  const detector::VertexFace query{path(0), {path(1), path(2), path(3)}};
  return oracle::distance_referee(four_points(query), {keeps_apart.separation, 0}).within ==
         detector::Decision::yes;
}

// By the oracle with all facts, and by another method than the oracle.
TEST(PeersBench, EveryStoredMeshHasTheContactThatIsMissed) {
  const auto files =
      value_of(corpus::case_files(std::string(ASSAY_SOURCE_DIR) + "/corpus/peers/meshes"));
  EXPECT_GE(files.size(), 27u);
  for (const auto& file : files) {
    const auto c = corpus::read_case(file).value();
    EXPECT_LE(c.triangles.rows(), 5) << file;
    const auto report = properties::check_case(c);
    EXPECT_TRUE(report.broken_facts.empty()) << file << ": " << report.broken_facts.front();
    EXPECT_TRUE(fs::exists(fs::path(file).replace_extension(".svg"))) << file;
    const bool is_of_distance = fs::path(file).stem().string().ends_with("_within");
    EXPECT_EQ(c.expected.answer == detector::Answer::free, is_of_distance) << file;
    if (is_of_distance) {
      EXPECT_TRUE(comes_within(c)) << file;
      continue;
    }
    properties::StepDiff diff;
    diff.answered_free = true;
    diff.first_contact = report.truth.at(0).pairs.at(0);
    const properties::Contract takes_all;
    EXPECT_TRUE(is_confirmed(c, 0, diff, {}, takes_all)) << file;
  }
}

TEST(PeersBench, EachPeerThatIsPresentMissesItsStoredMesh) {
  const Peers peers = find_peers(ASSAY_PEER_DIR);
  const fs::path folder = fs::path(ASSAY_SOURCE_DIR) / "corpus/peers/meshes";
  std::size_t present = 0;
  const auto expect_missed = [&](const BenchSubject& subject, const fs::path& file) {
    if (!fs::exists(file)) return;
    ++present;
    const std::vector<BenchCase> cases = {{corpus::read_case(file.string()).value()}};
    std::uint64_t peak_bytes = 0;
    ComparisonPlan plan;
    plan.on_case = [&](const Match& played) {
      peak_bytes = played.runs[0].first->times->peak_bytes;
    };
    const std::vector subjects = {subject};
    BenchReport report;
    Comparison comparison(subjects, plan, report);
    comparison.run({{"stored", "hard", 0, [&] { return cases; }}});
    ASSERT_EQ(comparison.rows().size(), 1u);
    const auto& counts = comparison.rows()[0].counts;
    EXPECT_EQ(counts.left_out, 0u) << subject.name;
    EXPECT_EQ(counts.errors.missed, 1u) << subject.name;
    EXPECT_EQ(counts.confirmed, 1u) << subject.name;
    EXPECT_GT(peak_bytes, 100'000u) << subject.name;
  };
  for (const auto& subject : peers.subjects) {
    if (subject.detector.built_in) continue;
    const auto name = subject.plugin->stem().string();
    expect_missed(subject, folder / (name + ".json"));
    // The strip of the top README shows the first.
    for (const auto& [peer, more] :
         {std::pair{"bullet_bernstein", "missed"}, std::pair{"fcl_elementary", "fcl_lengths"},
          std::pair{"tight_inclusion", "tight_inclusion_through"},
          std::pair{"arcsim", "arcsim_coplanar"}, std::pair{"arcsim", "arcsim_end"},
          std::pair{"arcsim", "arcsim_flat"}, std::pair{"ctcd", "ctcd_distance"},
          std::pair{"ipc_additive", "ipc_additive_parallel"}})
      if (name == peer) expect_missed(subject, folder / (std::string(more) + ".json"));
  }
  EXPECT_GE(present, 5u) << "these need no library";
}

}  // namespace
}  // namespace assay::reports
