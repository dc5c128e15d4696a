// The hash that every row of a store carries: no change of a row goes unseen.
#include <fmt/format.h>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/store.h"
#include "properties/random.h"
#include "tests/problem_words.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

const std::string test_binding = R"({"schema": "assay-store/8"})";

TEST(RowHash, TellsAllRowsApart) {
  const auto hash = [](const Row& row) { return row_hash(row); };
  EXPECT_EQ(hash({"note", "a", 0, "b"}), hash({"note", "a", 0, "b"}));
  EXPECT_NE(hash({"note", "ab", 0, ""}), hash({"note", "a", 0, "b"}));
  EXPECT_NE(hash({"note", "", 0, "ab"}), hash({"note", "ab", 0, ""}));
  EXPECT_NE(hash({"note", "a1:b", 0, ""}), hash({"notea", "1:b", 0, ""}));
  EXPECT_NE(hash({"note", "a", 1, ""}), hash({"note", "a", 11, ""}));
  EXPECT_NE(hash({"met", "a", 0, ""}), hash({"failure", "a", 0, ""}));
}

// One row of each kind but trial, of which there are several.
class ChangedRows : public testing::Test {
 protected:
  const tests::Scratch scratch;
  const std::string file = scratch / "run.sqlite";

  static TrialRecord trial(std::uint64_t i) {
    return {"t:1:broken:" + std::to_string(i), "broken", i, "HD", 1, 2, 3, 4, 5, 6,
            {{{"x", i}}, {}, {}, {}},          ~i};
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
    store.set({"canary", "c", 1, "{}"});
    store.set_note("key", "value");
    ASSERT_TRUE(store.seal());
  }
  void change(const std::string& sql) const { Database(file, Database::Mode::write).run(sql); }
  // As somebody does who knows the rules: the hash is mended.
  void forge(const std::string& where, const std::function<void(Row&)>& change) const {
    const Database database(file, Database::Mode::write);
    std::vector<Row> rows;
    for_each_row(database, where, {}, [&](const Row& row) { rows.push_back(row); });
    for (auto& row : rows) {
      change(row);
      put_row(database, row);
    }
  }
  // All that a store says, read in full.
  static Expected<std::vector<std::string>> all_of(const std::string& path) {
    const auto store = Store::read(path);
    if (!store) return store.error();
    return catch_store_problem([&] {
      std::vector<std::string> all = {store.value().binding()};
      store.value().for_each_trial(
          [&](const TrialRecord& r) { all.push_back(to_row(r).key + to_row(r).fields); });
      for (const auto& f : store.value().failures())
        all.push_back(f.id + f.configuration + f.signature + f.explanation + f.mesh + f.smallest);
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
      EXPECT_TRUE(says(resumed.error(), "was changed after it was written")) << place;
      const auto& line = resumed.error().message;
      EXPECT_TRUE(line.starts_with(fmt::format("{}: {}", file, kind))) << line;
      EXPECT_TRUE(line.ends_with(" was changed after it was written")) << line;
      if (kind == "binding") continue;  // it is read without a check of its hash
      if (kind == "note") continue;     // notes are not read here
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
                                           : "its tables are not those of the store of a run"))
        << more;
    // A table that is not there yet is made: a store may be killed before it is.
    EXPECT_EQ(static_cast<bool>(Store::open(file, test_binding)), is_gone) << more;
  }
}

}  // namespace
}  // namespace assay::properties
