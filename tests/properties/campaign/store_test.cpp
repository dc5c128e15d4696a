// The store of a campaign: which rows survive kills and damage, and to which run a store belongs.
#include "properties/campaign/ledger/store.h"

#include <fmt/format.h>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/database.h"
#include "properties/campaign/phases/phases.h"
#include "properties/random.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using tests::Scratch;

class Stores : public testing::Test {
 protected:
  Scratch scratch;
  std::string file = scratch / "trials.sqlite";
  Store open(const std::string& binding = "one") const { return test::open_store(file, binding); }
  // The store is refused with these words, in one line that names the file.
  static void expect_refused(const Expected<Store>& store, const std::string& path,
                             std::string_view words) {
    ASSERT_FALSE(store) << path;
    EXPECT_TRUE(says(store.error(), words));
    EXPECT_TRUE(says(store.error(), path));
    EXPECT_FALSE(says(store.error(), "\n"));
  }
  static void expect_no_open(const std::string& path, const std::string& binding,
                             std::string_view words) {
    expect_refused(Store::open(path, binding), path, words);
  }
  static void expect_no_read(const std::string& path, std::string_view words) {
    expect_refused(Store::read(path), path, words);
  }
  static FailureRecord failure(const std::string& id, const std::string& signature) {
    FailureRecord failure{.case_id = id, .configuration = "view-point", .claim = signature};
    failure.mesh = "mesh of " + id;
    return failure;
  }
  // A failure of trial i whose mesh is not kept.
  static FailureRecord met(std::uint64_t i, const std::string& configuration,
                           const std::string& signature) {
    return {.case_id = record(i).id, .configuration = configuration, .claim = signature};
  }
  static TrialRecord record(std::uint64_t i) {
    return {"p:1:broken:" + std::to_string(i), "broken", i, "HD", 1, 2, 3, 4, 5, 6,
            {{{"x", i}}, {}, {}, {}},          ~i};
  }
};

TEST_F(Stores, KeepWhatIsAdded) {
  auto shown = failure("a", "s");
  shown.flaky = true;
  {
    Store store = open();
    // The same again counts once.
    for (const std::uint64_t i : {10u, 2u, 0u, 2u}) store.add(record(i));
    for (const std::string id : {"b", "b"}) store.add(failure(id, "s"));
    store.add(shown);
    shown.smallest = "small";
    store.set_smallest(shown);
    store.add(record(7), {met(7, "one", "s"), met(7, "two", "s"), met(7, "three", "t")});
    store.set_note("key", "old");
    store.set_note("key", "new");
  }
  const Store store = open();
  std::vector<std::uint64_t> places;
  store.for_each_trial([&](const TrialRecord& r) {
    places.push_back(r.index);
    EXPECT_EQ(to_row(r), to_row(record(r.index)));
  });
  EXPECT_EQ(places, (std::vector<std::uint64_t>{0, 2, 7, 10}));
  EXPECT_EQ(store.trial_count(), 4u);
  EXPECT_TRUE(store.has_trial("p:1:broken:2"));
  EXPECT_FALSE(store.has_trial("p:1:broken:1"));
  const auto failures = store.failures();
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_EQ(to_row(failures[0]), to_row(shown));
  EXPECT_EQ(to_row(failures[1]), to_row(failure("b", "s")));
  EXPECT_EQ(store.signatures(), (Counts{{"s", 2}, {"t", 1}}));
  EXPECT_EQ(store.note("key"), "new");
  EXPECT_EQ(store.note("none"), std::nullopt);
  EXPECT_EQ(store.binding(), "one");
}

TEST_F(Stores, ATrialIsStoredWithItsFailuresOrNotAtAll) {
  // A process that is killed at once after each of its trials: nothing of them is lost or half
  // there.
  for (std::uint64_t i = 0; i < 5; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      Store store = open();
      store.add(record(i), {failure("f" + std::to_string(i), "s"), met(i, "one", "s")});
      raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const Store store = open();
    EXPECT_EQ(store.trial_count(), i + 1);
    EXPECT_EQ(store.failures().size(), i + 1);
    EXPECT_EQ(store.signatures(), (Counts{{"s", 2 * (i + 1)}}));
  }
}

TEST_F(Stores, AreForOneRunAndThatOneAtATime) {
  { open("one"); }
  expect_no_open(file, "two", "holds another run");
  const Store store = open("one");
  EXPECT_EQ(store.binding(), "one");
  expect_no_open(file, "one", "another process writes this file");
  EXPECT_TRUE(Store::read(file));
}

TEST_F(Stores, ThatAreNoneAreRefused) {
  expect_no_read(file, "no such file");
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto text = scratch.write("text.sqlite", std::string(5000, 'x'));
  expect_no_open(text, "one", "not a database");
  expect_no_read(text, "not a database");
  EXPECT_EQ(tests::read_text(text), std::string(5000, 'x'));
  // A database of somebody else, and one without anything, are read by nobody and left alone.
  const auto empty = scratch.write("empty.sqlite", "");
  expect_no_read(empty, "not the store of a run");
  EXPECT_EQ(std::filesystem::file_size(empty), 0u);
  expect_no_open(scratch / "no/such/folder.sqlite", "one", "No such file");
  std::filesystem::create_directory(scratch / "folder.sqlite");
  expect_no_open(scratch / "folder.sqlite", "one", "unable to open");
}

const std::string test_binding = R"({"schema": "assay-store/9"})";

// Whoever reads a folder of an older build may say so instead of calling it damaged. Up to
// assay-store/5 a store had other tables.
TEST_F(Stores, OfAnotherSchemaAreToldInOneLine) {
  { open(R"({"schema": "assay-store/2"})"); }
  expect_no_read(file, "is of schema \"assay-store/2\"");
  expect_no_open(file, test_binding, "repeat the run");
  std::filesystem::remove(file);
  Database(file, Database::Mode::write)
      .run(
          "CREATE TABLE note(key TEXT NOT NULL, value TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY "
          "KEY(key)) WITHOUT ROWID; INSERT INTO note VALUES('binding', '{\"schema\": "
          "\"assay-store/5\"}', '')");
  constexpr auto line =
      ": is of schema \"assay-store/5\", this program reads assay-store/9: repeat the run";
  expect_no_read(file, line);
  expect_no_open(file, test_binding, line);
}

// What other rooms ask of a store comes back as a value, even in the middle of its rows.
TEST_F(Stores, DamageIsSeenAndAValue) {
  {
    Store store = open(test_binding);
    for (std::uint64_t i = 0; i < 400; ++i) store.add(record(i), {failure(record(i).id, "s")});
  }
  const auto whole = Store::read(file).value().kept_failures();
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole.value().list.size(), 400u);
  EXPECT_EQ(whole.value().times_met, (Counts{{"s", 400}}));
  const std::string bytes = tests::read_text(file);
  ASSERT_GT(bytes.size(), 20'000u);
  std::string hole = bytes;
  std::fill(hole.begin() + 8192, hole.begin() + 16384, '\x5a');
  expect_no_open(scratch.write("hole.sqlite", hole), test_binding, "the file is damaged");
  // Of the whole file is seen at once.
  std::fill(hole.begin() + 16384, hole.end(), '\x5a');
  expect_no_read(scratch.write("rest.sqlite", bytes.substr(0, 16384) + hole.substr(16384)),
                 "disk image is malformed");
  expect_no_open(scratch.write("cut.sqlite", bytes.substr(0, bytes.size() / 2)), test_binding,
                 "disk image is malformed");
  Database(file, Database::Mode::write)
      .run("UPDATE ledger SET fields='{}' WHERE kind='failure' AND key LIKE 'p:1:broken:99,%'");
  const auto changed = Store::read(file);
  ASSERT_TRUE(changed);
  const auto kept = changed.value().kept_failures();
  ASSERT_FALSE(kept);
  EXPECT_TRUE(says(kept.error(), "was changed after it was written"));
}

// The hash that every row of a store carries: no change of a row goes unseen.

TEST(RowHash, TellsAllRowsApart) {
  const std::vector<Row> rows = {
      {"note", "a", 0, "b"},   {"note", "ab", 0, ""},   {"note", "", 0, "ab"},
      {"note", "a1:b", 0, ""}, {"notea", "1:b", 0, ""}, {"note", "a", 1, ""},
      {"note", "a", 11, ""},   {"met", "a", 0, ""},     {"failure", "a", 0, ""}};
  for (const auto& a : rows)
    for (const auto& b : rows) EXPECT_EQ(row_hash(a) == row_hash(b), a == b);
}

// One row of each kind but trial, of which there are several.
class ChangedRows : public Stores {
 protected:
  void fill() const {
    Store store = open(test_binding);
    for (std::uint64_t i = 0; i < 3; ++i) store.add(record(i));
    auto shown = failure(record(3).id, "s");
    shown.smallest = "small";
    store.add(record(3), {shown});
    store.set({"canary", "c", 1, "{}"});
    store.set_note("key", "value");
    ASSERT_TRUE(store.seal());
  }
  void change(const std::string& sql) const { Database(file, Database::Mode::write).run(sql); }
  // All that a store says, read in full.
  static Expected<std::vector<std::string>> all_of(const std::string& path) {
    const auto store = Store::read(path);
    if (!store) return store.error();
    return catch_store_problem([&] {
      std::vector<std::string> all = {store.value().binding()};
      store.value().for_each_trial(
          [&](const TrialRecord& r) { all.push_back(to_row(r).key + to_row(r).fields); });
      for (const auto& f : store.value().failures())
        all.push_back(to_row(f).key + to_row(f).fields);
      for (const auto& [signature, count] : store.value().signatures())
        all.push_back(signature + std::to_string(count));
      for (const auto& e : store.value().evidence())
        all.push_back(row_name(e) + std::to_string(e.progress) + e.fields);
      return all;
    });
  }
};

TEST_F(ChangedRows, AreNamedOnResumeAndOnReading) {
  for (const std::string kind : {"trial", "failure", "met", "canary", "note", "binding"}) {
    for (const std::string column : {"key", "progress", "fields", "hash"}) {
      std::filesystem::remove(file);
      fill();
      // The last row of the kind, by its key.
      change(
          fmt::format("UPDATE ledger SET {0}={1} WHERE kind='{2}' AND key=(SELECT max(key) FROM "
                      "ledger WHERE kind='{2}')",
                      column, column == "progress" ? "77" : "'other'", kind));
      const std::string place = kind + "." + column;
      if (place == "binding.fields") continue;  // it is another run
      const auto resumed = Store::open(file, test_binding);
      ASSERT_FALSE(resumed) << place;
      const auto& line = resumed.error().message;
      EXPECT_TRUE(line.starts_with(fmt::format("{}: {}", file, kind))) << line;
      EXPECT_TRUE(line.ends_with(" was changed after it was written")) << line;
      // The binding is read without a check of its hash, and notes are not read here.
      if (kind == "binding" || kind == "note") continue;
      const auto read = all_of(file);
      ASSERT_FALSE(read) << place;
      EXPECT_EQ(read.error().message, line);
    }
  }
}

TEST_F(ChangedRows, AFlippedBitIsSeenOrSaysNothing) {
  fill();
  const auto whole = tests::read_text(file);
  const auto truth = all_of(file);
  ASSERT_TRUE(truth);
  Random random(1, 2);
  int refused = 0;
  constexpr int flips = 400;
  for (int i = 0; i < flips; ++i) {
    std::string bytes = whole;
    // Most of a small store is empty pages: half of the flips go where something stands.
    auto at = random.next() % bytes.size();
    while (i % 2 == 0 && bytes[at] == 0) at = random.next() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
    // A name of its own: what SQLite keeps beside a file may outlive it.
    const auto flipped = scratch.write(fmt::format("flipped-{}.sqlite", i), bytes);
    const auto read = all_of(flipped);
    if (!read) {
      ++refused;
      EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
    } else {
      EXPECT_EQ(read.value(), truth.value()) << "byte " << at;
    }
    if (Store::open(flipped, test_binding)) {
      EXPECT_EQ(all_of(flipped).value(), truth.value()) << "byte " << at;
    }
  }
  EXPECT_GT(refused, flips / 4);
}

TEST_F(ChangedRows, AStoreWithMoreThanItsTablesIsDamaged) {
  for (const std::string more :
       {"CREATE TABLE tea(id TEXT)", "CREATE VIEW tea AS SELECT * FROM ledger",
        "CREATE TRIGGER tea AFTER INSERT ON ledger BEGIN DELETE FROM ledger; END",
        "DROP TABLE ledger"}) {
    std::filesystem::remove(file);
    fill();
    change(more);
    const auto read = Store::read(file);
    ASSERT_FALSE(read) << more;
    // Without its table nobody knows what it was.
    const bool is_gone = more == "DROP TABLE ledger";
    EXPECT_TRUE(says(read.error(), is_gone ? "not the store of a run"
                                           : "not the store of a run: its tables differ"))
        << more;
    // A table that is not there yet is made: a store may be killed before it is.
    EXPECT_EQ(static_cast<bool>(Store::open(file, test_binding)), is_gone) << more;
  }
}

// A store that fails in the middle of the work: whoever runs a campaign is told by a value.

// As if somebody changed the file while it is written.
void drop_table(const std::filesystem::path& file) {
  Database(file, Database::Mode::write).run("DROP TABLE ledger");
}

// Drops the table when a phase begins, and notes how far the campaign came.
struct Saboteur : CampaignObserver {
  void on_begin(std::uint64_t /*trials*/) override { on_phase("begin"); }
  void on_phase(const char* begun) override {
    last = begun;
    if (begun == phase) drop_table(file);
  }
  std::string file, phase, last;
};

TEST_F(Stores, ThatFailEndACampaignByAValue) {
  // Two in the threads of the trials: where they ask what is stored, and where they store.
  for (const std::string phase : {"begin", "trials", "shrinking"}) {
    Saboteur saboteur;
    saboteur.file = scratch / (phase + ".sqlite");
    saboteur.phase = phase;
    const auto request = test::request_of(4, 2);
    auto store = test::open_store(saboteur.file, binding_of(request));
    const auto ran = run_campaign(request, "", store, saboteur);
    ASSERT_FALSE(ran) << phase;
    EXPECT_TRUE(says(ran.error(), "no such table: ledger"));
    EXPECT_EQ(saboteur.last, phase);
  }
}

TEST_F(Stores, ThatFailAreAValueForWhoeverKeepsARow) {
  auto store = open();
  ASSERT_TRUE(store.keep(to_row(Issuance{"out"})));
  drop_table(file);
  const auto kept = store.keep(to_row(Issuance{"out"}));
  ASSERT_FALSE(kept);
  EXPECT_TRUE(says(kept.error(), "no such table: ledger"));
}

}  // namespace
}  // namespace assay::properties
