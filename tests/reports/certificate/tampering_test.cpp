// Hundreds of changes to the folder of a good certificate: for each change, `assay verify` prints a
// line and ends with exit code 1 or 2. No change may pass, because every byte counts: the
// certificate holds the digests of the other files, and is itself compared byte by byte.
#include <fmt/format.h>

#include "properties/campaign/ledger/database.h"
#include "properties/random.h"
#include "tests/reports/certificate/issued_folder.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using properties::Random;

const std::string deep_lists = std::string(100'000, '[') + std::string(100'000, ']');

std::string deep_objects() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += R"({"a":)";
  return text + "1" + std::string(100'000, '}');
}

class Tampering : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string good = scratch / "good", bad = scratch / "bad";
  Random random{7, 1};

  void SetUp() override {
    store_and_issue(good_run(), good, {good, ""});
    expect_ended("verify " + good + "/certificate.json", 0);
  }

  // A copy of the folder, changed by `change`, does not verify.
  template <class Change>
  void expect_seen(const std::string& tampering, const Change& change) {
    fs::remove_all(bad);
    fs::copy(good, bad, fs::copy_options::recursive);
    change();
    const auto seen = run_assay("verify " + bad + "/certificate.json");
    if (seen.exit_code == 1) {
      const auto last = seen.out.rfind('\n', seen.out.size() - 2);
      ASSERT_NE(last, std::string::npos) << tampering << ": no line says why\n" << seen.out;
      EXPECT_TRUE(seen.out.substr(last + 1).starts_with("NOT VERIFIED: ")) << tampering << seen.out;
      EXPECT_EQ(seen.err, "") << tampering;
    } else {
      EXPECT_EQ(seen.exit_code, 2) << tampering << "\n" << seen.out << seen.err;
      EXPECT_EQ(std::count(seen.err.begin(), seen.err.end(), '\n'), 1) << tampering << seen.err;
    }
  }
  void expect_text_seen(const std::string& file, const std::string& tampering,
                        const std::string& text) {
    expect_seen(file + ": " + tampering, [&] { write_bytes(bad + "/" + file, text); });
  }

  // What may be done to any file.
  void damage(const std::string& file) {
    const auto whole = read_text(good + "/" + file);
    ASSERT_FALSE(whole.empty()) << file;
    for (int i = 0; i < 8; ++i) {
      auto bytes = whole;
      const auto at = random.next() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      expect_text_seen(file, fmt::format("bit at {}", at), bytes);
    }
    for (int i = 0; i < 4; ++i) {
      const auto size = random.next() % whole.size();
      expect_text_seen(file, fmt::format("cut at {}", size), whole.substr(0, size));
    }
    expect_text_seen(file, "empty", "");
    expect_text_seen(file, "longer by a line", whole + "\n");
    expect_text_seen(file, "zeros", std::string(whole.size(), '\0'));
    expect_seen(file + " removed", [&] { fs::remove(bad + "/" + file); });
    expect_seen(file + " is a folder", [&] {
      fs::remove(bad + "/" + file);
      fs::create_directory(bad + "/" + file);
    });
  }

  // Every place of a JSON file once: taken away, or something else put there.
  void change_json(const std::string& file, std::size_t most) {
    const Json whole = Json::parse(read_text(good + "/" + file));
    std::vector<Json::json_pointer> places = {Json::json_pointer("")};
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!whole[places[i]].is_structured()) continue;
      for (const auto& [key, value] : whole[places[i]].items()) places.push_back(places[i] / key);
    }
    // Those near the root are few, and matter most.
    std::vector<Json::json_pointer> chosen(places.begin() + 1,
                                           places.begin() + std::min<long>(40, places.size()));
    while (chosen.size() < std::min(most, places.size() - 1))
      chosen.push_back(places[1 + random.next() % (places.size() - 1)]);
    const std::vector<Json> others = {
        nullptr,       true,           -1,         1e300,   std::uint64_t(1) << 63, "",
        Json::array(), Json::object(), {{"a", 1}}, {1, "2"}};
    for (const auto& place : chosen) {
      Json less = whole;
      auto& parent = less[place.parent_pointer()];
      if (parent.is_array()) {
        parent.erase(std::stoul(place.back()));
      } else {
        parent.erase(place.back());
      }
      expect_text_seen(file, "without " + place.to_string(), less.dump(1) + "\n");
      Json other = whole;
      // Another type: of a number, a text, a list or an object never one that is equal to it.
      do {
        other[place] = others[static_cast<std::size_t>(random.below(10))];
      } while (other[place] == whole[place]);
      expect_text_seen(file, place.to_string() + " is " + other[place].dump(),
                       other.dump(1) + "\n");
    }
    // Words in place of a value that the library would not write.
    const auto with = [&](const std::string& word) {
      Json marked = whole;
      marked[chosen[static_cast<std::size_t>(random.below(static_cast<int>(chosen.size())))]] =
          "MARK";
      auto text = marked.dump(1) + "\n";
      return text.replace(text.find("\"MARK\""), 6, word);
    };
    for (const std::string word :
         {"NaN", "Infinity", "1e999", "-1e999", "123456789012345678901234567890", "\"\xff\xfe\"",
          "\"\\ud800\"", "{", "]", "'x'"})
      expect_text_seen(file, word, with(word));
    expect_text_seen(file, "deep lists", with(deep_lists));
    expect_text_seen(file, "deep objects", with(deep_objects()));
    expect_text_seen(file, "nothing but deep lists", deep_lists);
    expect_text_seen(file, "lists that do not end", std::string(100'000, '['));
    for (const std::string text : {"null", "[]", "{}", "\"\"", "1", "true", "\xef\xbb\xbf{}"})
      expect_text_seen(file, text, text);
  }

  // A column of the first row of each kind, or one of its fields, the hash mended.
  void forge_rows(const std::string& file) {
    const std::vector<std::string> words = {
        "",     "NaN",      "-1",         "99999999999999999999",
        "1e99", "1/0",      "0/0",        "1/99999999999999999",
        "{}",   "\xff\xfe", deep_lists,   deep_objects(),
        "[[",   "null",     R"({"a":1})", "HHHHHHHHHHHHHHHH"};
    const auto a_word = [&] {
      return words[static_cast<std::size_t>(random.below(static_cast<int>(words.size())))];
    };
    std::map<std::string, properties::Row> kinds;
    {
      const properties::Database database(good + "/" + file, properties::Database::Mode::read);
      for_each_row(database, "", {},
                   [&](const properties::Row& row) { kinds.emplace(row.kind, row); });
    }
    for (const auto& [kind, row] : kinds) {
      const auto forge = [&](const std::string& what, const std::string& word, const auto& change) {
        properties::Row forged = row;
        change(forged, word);
        if (forged == row) return;
        expect_seen(fmt::format("{}: {} of {} is {}", file, what, kind, word.substr(0, 20)),
                    [&] { put_instead(bad + "/" + file, row, forged); });
      };
      using Column = std::string properties::Row::*;
      for (const Column column :
           {&properties::Row::kind, &properties::Row::key, &properties::Row::fields}) {
        for (int i = 0; i < 4; ++i)
          forge("a column", a_word(),
                [&](properties::Row& to, const std::string& word) { to.*column = word; });
      }
      const Json stored = Json::parse(row.fields);
      for (const auto& [name, value] : stored.items()) {
        forge(name, a_word(), [&](properties::Row& to, const std::string& word) {
          // What is JSON stands there as it is, because a copy of it may be too deep; else a text.
          const auto put = Json::accept(word)
                               ? word
                               : Json(word).dump(-1, ' ', false, Json::error_handler_t::replace);
          Json fields = stored;
          fields[name] = "@";
          const auto text = fields.dump();
          const auto place = text.find(R"("@")");
          to.fields = text.substr(0, place) + put + text.substr(place + 3);
        });
      }
    }
  }
  static void put_instead(const std::string& file, const properties::Row& row,
                          const properties::Row& forged) {
    const properties::Database database(file, properties::Database::Mode::write);
    properties::Statement(database, "DELETE FROM ledger WHERE kind=? AND key=?")
        .bind(row.kind)
        .bind(row.key)
        .next();
    put_row(database, forged);
  }
  void bind_to(const std::string& file, const std::string& place, const Json& value) {
    expect_seen(fmt::format("{}: binding {} is {}", file, place, value.dump().substr(0, 20)), [&] {
      const properties::Database database(bad + "/" + file, properties::Database::Mode::write);
      std::string text;
      for_each_row(database, "WHERE kind='binding'", {},
                   [&](const properties::Row& row) { text = row.fields; });
      Json binding = Json::parse(text);
      binding[Json::json_pointer(place)] = value;
      put_row(database, {"binding", "", 0, binding.dump()});
    });
  }
};

TEST_F(Tampering, OfTheCertificateIsSeen) {
  damage("certificate.json");
  change_json("certificate.json", 120);
}

TEST_F(Tampering, OfTheCampaignIsSeen) {
  damage("campaign.json");
  change_json("campaign.json", 40);
}

TEST_F(Tampering, OfTheStoreIsSeen) {
  const std::string file = "run.sqlite";
  damage(file);
  forge_rows(file);
  for (const auto& value : {Json(nullptr), Json(-1), Json(1e300), Json("x"), Json::array()}) {
    for (const char* place :
         {"/seed", "/shares", "/detector/configurations", "/campaign/strata", "/digests"})
      bind_to(file, place, value);
  }
  for (const std::uint64_t shares : {0, 2, 1'000'001}) bind_to(file, "/shares", shares);
}

TEST_F(Tampering, OfItsRenderingsIsSeen) {
  for (const std::string file : {"junit.xml", "summary.md"}) damage(file);
}

}  // namespace
}  // namespace assay::tests
