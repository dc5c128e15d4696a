// The store of a campaign: what is kept, across kills and damage, and whose it is.
#include "properties/campaign/ledger/store.h"

#include <sys/wait.h>
#include <unistd.h>

#include "tests/problem_words.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using tests::Scratch;

class Stores : public testing::Test {
 protected:
  Scratch scratch;
  std::string file = scratch / "trials.sqlite";
  Store open(const std::string& binding = "one") const {
    auto store = Store::open(file, binding);
    EXPECT_TRUE(store) << store.error().message;
    return std::move(store.value());
  }
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
  static StoredFailure failure(const std::string& id, const std::string& signature) {
    return {id, "view-point", signature, "what", "mesh of " + id, "", false};
  }
  static TrialRecord record(std::uint64_t i) {
    return {"p:1:broken:" + std::to_string(i), "broken", i, "HD", 1, 2, 3, 4, 5, 6,
            {{{"x", i}}, {}, {}, {}},          ~i};
  }
};

TEST_F(Stores, KeepWhatIsAdded) {
  {
    Store store = open();
    for (const std::uint64_t i : {10u, 2u, 0u}) store.add(record(i));
    store.add(failure("b", "s"));
    auto shown = failure("a", "s");
    shown.flaky = true;
    store.add(shown);
    shown.smallest = "small";
    store.set_smallest(shown);
    store.add(record(7), {}, {{"one", "s"}, {"two", "s"}, {"three", "t"}});
    store.set_note("key", "old");
    store.set_note("key", "new");
  }
  const Store store = open();
  std::vector<std::uint64_t> places;
  store.for_each_trial([&](const TrialRecord& r) {
    places.push_back(r.index);
    const auto expected = record(r.index);
    EXPECT_EQ(r.id, expected.id);
    EXPECT_EQ(r.family, "broken");
    EXPECT_EQ(r.outcomes, "HD");
    EXPECT_EQ(r.triangles, 1u);
    EXPECT_EQ(r.steps, 2u);
    EXPECT_EQ(r.collisions, 3u);
    EXPECT_EQ(r.pairs, 4u);
    EXPECT_EQ(r.oracle_us, 5u);
    EXPECT_EQ(r.detector_us, 6u);
    EXPECT_EQ(r.counts, expected.counts);
    EXPECT_EQ(r.mesh, expected.mesh);
  });
  EXPECT_EQ(places, (std::vector<std::uint64_t>{0, 2, 7, 10}));
  EXPECT_EQ(store.trial_count(), 4u);
  EXPECT_TRUE(store.has_trial("p:1:broken:2"));
  EXPECT_FALSE(store.has_trial("p:1:broken:1"));
  const auto failures = store.failures();
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_EQ(failures[0].id, "a");
  EXPECT_EQ(failures[0].smallest, "small");
  EXPECT_TRUE(failures[0].flaky);
  EXPECT_EQ(failures[1].id, "b");
  EXPECT_EQ(failures[1].mesh, "mesh of b");
  EXPECT_TRUE(failures[1].smallest.empty());
  EXPECT_FALSE(failures[1].flaky);
  EXPECT_EQ(store.signatures(), (Counts{{"s", 2}, {"t", 1}}));
  EXPECT_EQ(store.note("key"), "new");
  EXPECT_EQ(store.note("none"), std::nullopt);
  EXPECT_EQ(store.binding(), "one");
}

TEST_F(Stores, TheSameTrialAgainCountsOnce) {
  Store store = open();
  store.add(record(1));
  store.add(record(1));
  store.add(failure("a", "s"));
  store.add(failure("a", "s"));
  EXPECT_EQ(store.trial_count(), 1u);
  EXPECT_EQ(store.failures().size(), 1u);
}

TEST_F(Stores, ATrialIsStoredWithItsFailuresOrNotAtAll) {
  // A process that is killed at once after each of its trials: nothing of them is lost or half
  // there.
  for (std::uint64_t i = 0; i < 5; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      Store store = open();
      store.add(record(i), {failure("f" + std::to_string(i), "s")}, {{"one", "s"}, {"two", "s"}});
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

TEST_F(Stores, OfAnotherRunAreRefused) {
  { open("one"); }
  expect_no_open(file, "two", "holds another run");
  EXPECT_EQ(open("one").binding(), "one");
}

TEST_F(Stores, AreForOneRunAtATime) {
  const Store store = open();
  expect_no_open(file, "one", "another run is writing it");
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

// Whoever reads a folder of an older build may say so instead of calling it damaged.
TEST_F(Stores, OfAnotherSchemaAreTold) {
  { open(R"({"schema": "assay-store/2"})"); }
  expect_no_read(file, "is of schema \"assay-store/2\"");
  expect_no_open(file, R"({"schema": "assay-store/8"})", "run it again");
}

// Up to assay-store/5 a store had other tables.
TEST_F(Stores, OfTheTablesOfBeforeAreToldInOneLine) {
  Database(file, Database::Mode::write)
      .run(
          "CREATE TABLE note(key TEXT NOT NULL, value TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY "
          "KEY(key)) WITHOUT ROWID; INSERT INTO note VALUES('binding', '{\"schema\": "
          "\"assay-store/5\"}', '')");
  constexpr auto line =
      ": is of schema \"assay-store/5\", this assay reads assay-store/8: run it again";
  expect_no_read(file, line);
  expect_no_open(file, R"({"schema": "assay-store/8"})", line);
}

TEST_F(Stores, DamageIsSeen) {
  {
    Store store = open();
    for (std::uint64_t i = 0; i < 400; ++i) store.add(record(i));
  }
  const std::string whole = tests::read_text(file);
  ASSERT_GT(whole.size(), 20'000u);
  std::string hole = whole;
  std::fill(hole.begin() + 8192, hole.begin() + 16384, '\x5a');
  expect_no_open(scratch.write("hole.sqlite", hole), "one", "the file is damaged");
  expect_no_open(scratch.write("cut.sqlite", whole.substr(0, whole.size() / 2)), "one",
                 "disk image is malformed");
}

// What other rooms ask of a store comes back as a value, even in the middle of its rows.
TEST_F(Stores, DamageThatIsMetLateIsAValueToo) {
  {
    Store store = open(R"({"schema": "assay-store/8"})");
    for (std::uint64_t i = 0; i < 400; ++i) {
      store.add(record(i), {failure(record(i).id, "s")}, {{"one", "s"}});
    }
  }
  const auto whole = Store::read(file).value().kept_failures();
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole.value().list.size(), 400u);
  EXPECT_EQ(whole.value().times_met, (Counts{{"s", 400}}));
  // Of the whole file is seen at once.
  std::string hole = tests::read_text(file);
  std::fill(hole.begin() + 16384, hole.end(), '\x5a');
  expect_no_read(scratch.write("hole.sqlite", hole), "disk image is malformed");
  Database(file, Database::Mode::write)
      .run("UPDATE ledger SET fields='{}' WHERE kind='failure' AND key LIKE 'p:1:broken:99,%'");
  const auto changed = Store::read(file);
  ASSERT_TRUE(changed);
  const auto kept = changed.value().kept_failures();
  ASSERT_FALSE(kept);
  EXPECT_TRUE(says(kept.error(), "was changed after it was written"));
}

}  // namespace
}  // namespace assay::properties
