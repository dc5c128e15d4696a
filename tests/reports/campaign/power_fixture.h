// A run that plants all faults and finds them, for tests of --power.
#pragma once

#include "properties/campaign/ledger/run_folder.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {

class PowerFixture : public testing::Test {
 protected:
  using Json = nlohmann::ordered_json;
  using Rows = std::vector<properties::Row>;

  // The curated cases show each of the faults, so that few random ones will do. The tests of a
  // process share it and leave it as it is.
  static void SetUpTestSuite() {
    shared = std::make_unique<Scratch>();
    const auto plan = shared->write("proof.json", faults_text("proof", 20, 1));
    const auto made =
        run_assay("run --seed 7 --jobs 2 --campaign " + plan + " --out " + proof_folder());
    ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
    ASSERT_TRUE(contains(made.out, " by their curated case alone\n")) << made.out;
  }
  static void TearDownTestSuite() { shared.reset(); }
  static std::string proof_folder() { return *shared / "proof"; }

  // A campaign that plants faults. `half`: cases of one of its two families, in the other as many.
  static std::string faults_text(const std::string& name, int cases_of_a_fault, int seeds,
                                 int half = 8) {
    const Json plan = {{"schema", "assay-campaign/1"},
                       {"name", name},
                       {"strata",
                        {{{"family", "closed-generic"}, {"cases", half}},
                         {{"family", "unclosed-generic"}, {"cases", half}},
                         {{"family", "broken"}, {"cases", half}}}},
                       {"seconds", nullptr},
                       {"fault_cases", cases_of_a_fault},
                       {"fault_seeds", seeds},
                       {"policy", {{"self_test_queries", 20}}}};
    return plan.dump();
  }

  static std::optional<properties::Store> open(const std::string& file) {
    std::string binding;
    {
      const auto read = properties::Store::read(file);
      EXPECT_TRUE(read) << read.error().message;
      if (!read) return std::nullopt;
      binding = read.value().binding();
    }
    auto opened = properties::Store::open(file, binding);
    EXPECT_TRUE(opened) << opened.error().message;
    if (!opened) return std::nullopt;
    return std::move(opened.value());
  }
  static Rows rows_of(const std::string& file, const std::string& kind) {
    Rows rows;
    const auto store = open(file);
    if (!store) return rows;
    for (auto& row : store->evidence()) {
      if (row.kind == kind) rows.push_back(std::move(row));
    }
    return rows;
  }
  // Another binding of a folder's only store.
  static void rebind(const std::string& folder, const std::string& digest) {
    auto store = open(folder + "/run.sqlite");
    ASSERT_TRUE(store);
    auto binding = Json::parse(store->binding());
    binding["digests"][digest] = std::string(64, '0');
    store->set({"binding", "", 0, binding.dump()});
    EXPECT_TRUE(store->seal());
  }
  // Makes of the first planted fault that a run took over one that was not found: its name.
  static std::string hide_a_fault(const std::string& file) {
    auto store = open(file);
    if (!store) return "";
    for (auto& row : store->evidence()) {
      if (row.kind != "fault") continue;
      auto facts = Json::parse(row.fields);
      if (facts["status"] != "planted") continue;
      facts["curated"] = false;
      for (auto& needed : facts["needed"]) needed = nullptr;
      row.fields = facts.dump();
      store->set(row);
      EXPECT_TRUE(store->seal());
      return row.key;
    }
    ADD_FAILURE() << file << " has no fault that was taken over";
    return "";
  }
  // Makes the campaign that a run took its proof from another one.
  static void rename_source(const std::string& file, const std::string& key,
                            const std::string& campaign) {
    auto sources = rows_of(file, "power");
    ASSERT_EQ(sources.size(), 1u);
    auto store = open(file);
    ASSERT_TRUE(store);
    store->drop("power");
    auto fields = nlohmann::json::parse(sources[0].fields);
    sources[0].key = key;
    fields["campaign"] = campaign;
    sources[0].fields = fields.dump();
    store->set(sources[0]);
  }

  const Scratch scratch;
  const std::string library = " --detector " + plugin("wrapped_builtin");
  const std::string with_proof = " --power " + proof_folder();

 private:
  inline static std::unique_ptr<Scratch> shared;
};

}  // namespace assay::tests
