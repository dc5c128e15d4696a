// The hash that every row of a store carries, and what a process knows of its rows: no change of a
// row goes unseen.
#include "properties/campaign/database/rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "properties/campaign/stored/merge.h"
#include "properties/campaign/stored/store.h"
#include "properties/random.h"
#include "tests/problem_words.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

const std::string test_binding = R"({"schema": "assay-store/5", "shard": "1/1"})";

TEST(RowHash, TellsAllRowsApart) {
  const auto hash = [](const StoreTable& table, const Row& row) { return row_hash(table, row); };
  EXPECT_EQ(hash(note_table(), {"a", "b"}), hash(note_table(), {"a", "b"}));
  EXPECT_NE(hash(note_table(), {"ab", ""}), hash(note_table(), {"a", "b"}));
  EXPECT_NE(hash(note_table(), {"", "ab"}), hash(note_table(), {"ab", ""}));
  EXPECT_NE(hash(note_table(), {"a", "1:b"}), hash(note_table(), {"a1:b", ""}));
  EXPECT_NE(hash(met_table(), {"a", "b", "c"}), hash(failure_table(), {"a", "b", "c"}));
}

// One row in each table but trial, which has several.
class ChangedRows : public testing::Test {
 protected:
  const tests::Scratch scratch;
  const std::string file = scratch / "shard.sqlite";

  static TrialRecord trial(std::uint64_t i) {
    return {
        "t:1:broken:" + std::to_string(i), "broken", i, "HD", 1, 2, 3, 4, 5, 6, {{"tag:x", i}}, ~i};
  }
  Store open() const {
    auto store = Store::open(file, test_binding);
    EXPECT_TRUE(store) << store.error().message;
    return std::move(store.value());
  }
  void fill() const {
    Store store = open();
    for (std::uint64_t i = 0; i < 3; ++i) store.add(trial(i));
    store.add(trial(3), {{"t:1:broken:3", "bvh", "s", "what", "mesh", "small", false}},
              {{"bvh", "s"}});
    store.set({"canary", "c", "1/1", 1, "{}"});
    store.set_note("key", "value");
    ASSERT_TRUE(store.seal());
  }
  void change(const std::string& sql) const { Database(file, Database::Mode::write).run(sql); }
  // As somebody does who knows the rules: the hash is mended.
  void forge(const StoreTable& table, const std::string& where, std::size_t column,
             const std::string& text) const {
    const Database database(file, Database::Mode::write);
    std::vector<Row> rows;
    for_each_row(database, table, nullptr, where, {}, [&](const Row& row) { rows.push_back(row); });
    for (auto& row : rows) {
      row[column] = text;
      put_row(database, table, row);
    }
  }
  // All that a store says, read in full.
  static Expected<std::vector<std::string>> all_of(const std::string& path) {
    const auto store = Store::read(path);
    if (!store) return store.error();
    return catch_store_problem([&] {
      std::vector<std::string> all = {store.value().binding()};
      store.value().for_each_trial([&](const TrialRecord& r) {
        all.push_back(r.id + r.outcomes + counts_text(r.counts) + std::to_string(r.mesh));
      });
      for (const auto& f : store.value().failures())
        all.push_back(f.id + f.configuration + f.signature + f.explanation + f.mesh + f.smallest);
      for (const auto& [signature, count] : store.value().signatures())
        all.push_back(signature + std::to_string(count));
      for (const auto& e : store.value().evidence())
        all.push_back(e.kind + e.name + e.shard + std::to_string(e.progress) + e.facts);
      return all;
    });
  }
};

TEST_F(ChangedRows, AreNamedOnResumeOnReadingAndOnMerging) {
  for (const auto* table : store_tables()) {
    for (const auto& column : table->columns) {
      std::filesystem::remove(file);
      fill();
      // The last row of the table, by its key.
      const std::string key = table->columns[0].name;
      change(fmt::format("UPDATE {0} SET {1}={2} WHERE {3}=(SELECT max({3}) FROM {0})", table->name,
                         column.name, column.is_number ? "77" : "'other'", key));
      const std::string place = fmt::format("{}.{}", table->name, column.name);
      const auto resumed = Store::open(file, test_binding);
      ASSERT_FALSE(resumed) << place;
      EXPECT_TRUE(says(resumed.error(), "was changed after it was written")) << place;
      const auto& line = resumed.error().message;
      EXPECT_TRUE(line.starts_with(fmt::format("{}: {} ", file, table->name))) << line;
      EXPECT_TRUE(line.ends_with(" was changed after it was written")) << line;
      const std::vector<std::filesystem::path> files = {file};
      const auto merged = merge_stores(files, scratch / "merged.sqlite");
      ASSERT_FALSE(merged) << place;
      EXPECT_EQ(merged.error().message, line);
      EXPECT_FALSE(std::filesystem::exists(scratch / "merged.sqlite"));
      if (std::string(table->name) == "note") continue;  // but for the binding, notes are not read
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
    const auto resumed = Store::open(flipped, test_binding);
    if (resumed) {
      EXPECT_EQ(resumed.value().known_rows().size(), 9u) << "byte " << at;
    }
  }
  EXPECT_GT(refused, flips / 4);
}

// A hash that fits does not help: the process that writes knows its rows.
TEST_F(ChangedRows, AreSeenByTheirWriterWhateverTheirHash) {
  fill();
  Store store = open();
  store.add(trial(4));
  ASSERT_TRUE(store.check_against(store.known_rows()));
  const auto told = [&](const std::string& line) {
    const auto checked = store.check_against(store.known_rows());
    ASSERT_FALSE(checked) << line;
    EXPECT_EQ(checked.error().kind, ProblemKind::not_as_stored);
    EXPECT_EQ(checked.error().message, fmt::format("{}: {}", file, line));
  };
  forge(trial_table(), "WHERE id='t:1:broken:4'", 3, "HH");
  told("trial t:1:broken:4 was changed while this run was at work");
  // Reading it back for further work is refused as well.
  EXPECT_THROW(store.for_each_trial([](const TrialRecord&) {}), StoreProblem);
  forge(trial_table(), "WHERE id='t:1:broken:4'", 3, "HD");
  ASSERT_TRUE(store.check_against(store.known_rows()));
  // A row that was there before, one too many, and one that is gone.
  forge(evidence_table(), "", 4, "[]");
  told("evidence canary, c, 1/1 was changed while this run was at work");
  EXPECT_THROW(store.set({"canary", "c", "1/1", 2, "{}"}), StoreProblem);
  forge(evidence_table(), "", 4, "{}");
  forge(trial_table(), "WHERE id='t:1:broken:2'", 0, "t:1:broken:9");
  told("trial t:1:broken:9 was not stored by this run");
  change("DELETE FROM trial WHERE id='t:1:broken:9'");
  ASSERT_TRUE(store.check_against(store.known_rows()));
  change("DELETE FROM met");
  told("met t:1:broken:3, bvh was taken away while this run was at work");
}

TEST_F(ChangedRows, WhatWasTakenBackIsNotMissed) {
  fill();
  Store store = open();
  store.set({"fault", "f", "1/1", 1, "{}"});
  store.set({"fault", "f", "1/1", 2, "[]"});
  store.set({"fault", "f", "1/1", 1, "{}"});  // came less far
  ASSERT_TRUE(store.check_against(store.known_rows()));
  store.drop_evidence("fault");
  store.keep_failures({"other"});
  EXPECT_TRUE(store.failures().empty());
  const auto checked = store.check_against(store.known_rows());
  EXPECT_TRUE(checked) << checked.error().message;
}

TEST_F(ChangedRows, AStoreWithMoreThanItsTablesIsDamaged) {
  for (const std::string more :
       {"CREATE TABLE tea(id TEXT)", "CREATE VIEW tea AS SELECT * FROM trial",
        "CREATE TRIGGER tea AFTER INSERT ON trial BEGIN DELETE FROM met; END", "DROP TABLE met"}) {
    std::filesystem::remove(file);
    fill();
    change(more);
    const auto read = Store::read(file);
    ASSERT_FALSE(read) << more;
    EXPECT_TRUE(says(read.error(), "its tables are not those of the store of a run")) << more;
    const auto opened = Store::open(file, test_binding);
    // A table that is not there yet is made: a store may be killed between its first two.
    EXPECT_EQ(static_cast<bool>(opened), more == "DROP TABLE met") << more;
  }
}

}  // namespace
}  // namespace assay::properties
