#include "reports/certificate/verify.h"

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"
#include "properties/campaign/gates/statistics.h"
#include "properties/campaign/ledger/run_folder.h"
#include "reports/certificate/junit.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"

namespace assay::reports {

namespace {

using Json = nlohmann::ordered_json;
using corpus::json_text;
using Lines = std::vector<std::string>;

// An empty object or list is a leaf, as a number is.
bool is_leaf(const Json& json) { return !json.is_structured() || json.empty(); }

void compare_leaves(const Json* stated, const Json* computed, const std::string& place,
                    Lines& lines) {
  if (computed == nullptr) {
    lines.push_back(
        fmt::format("{}: {} is stated, nothing of it is stored", place, json_text(*stated)));
  } else if (stated == nullptr) {
    lines.push_back(fmt::format("{}: is not stated, {} is computed", place, json_text(*computed)));
  } else {
    lines.push_back(fmt::format("{}: {} is stated, {} is computed", place, json_text(*stated),
                                json_text(*computed)));
  }
}

// Reports each leaf that only one side has, or that differs. A side that has nothing at this place
// is null. Equal parts are passed over as a whole, so that no place is named in vain.
void compare_fields(const Json* stated, const Json* computed, const Json::json_pointer& place,
                    Lines& lines) {
  const bool has_both = stated != nullptr && computed != nullptr;
  if (has_both && *stated == *computed) return;
  if ((stated == nullptr || is_leaf(*stated)) && (computed == nullptr || is_leaf(*computed)))
    return compare_leaves(stated, computed, place.to_string(), lines);
  if (has_both && stated->type() != computed->type()) {
    compare_fields(stated, nullptr, place, lines);
    compare_fields(nullptr, computed, place, lines);
    return;
  }
  const auto part_of = [](const Json* whole, const Json::json_pointer& name) {
    return whole != nullptr && whole->contains(name) ? &whole->at(name) : nullptr;
  };
  const Json nothing = Json::object();
  for (const auto& [name, value] : (stated == nullptr ? nothing : *stated).items())
    compare_fields(&value, part_of(computed, Json::json_pointer() / name), place / name, lines);
  for (const auto& [name, value] : (computed == nullptr ? nothing : *computed).items()) {
    if (part_of(stated, Json::json_pointer() / name) == nullptr)
      compare_fields(nullptr, &value, place / name, lines);
  }
}

void compare_file(const std::filesystem::path& file, const std::string& sha256, Lines& lines) {
  std::error_code ignored;
  // Only a regular file is read, because a pipe would keep its reader waiting.
  if (!std::filesystem::is_regular_file(file, ignored)) {
    lines.push_back(fmt::format("{}: no such file", file.string()));
    return;
  }
  const auto digest = corpus::sha256_of_file(file);
  if (!digest) {
    lines.push_back(digest.error().message);
  } else if (digest.value() != sha256) {
    lines.push_back(fmt::format("{}: its bytes are not those that were certified", file.string()));
  }
}

// The schema that the certificate names, if it is that of another version.
std::optional<std::string> other_schema(const Json& statement) {
  const auto predicate = statement.find("predicate");
  if (predicate == statement.end() || !predicate->is_object()) return std::nullopt;
  const auto schema = predicate->find("schema");
  if (schema == predicate->end() || *schema == certificate_schema) return std::nullopt;
  constexpr std::string_view name = "assay-certificate/";
  const auto text = schema->is_string() ? schema->get<std::string>() : std::string();
  const bool is_version = text.starts_with(name) &&
                          text.find_first_not_of("0123456789", name.size()) == std::string::npos;
  return is_version ? std::optional(text) : std::nullopt;
}

// Reads the certificate into the result. Returns false if the result says already why it does not
// verify.
bool read_certificate(const std::filesystem::path& certificate, Verification& result) {
  auto& lines = result.differences;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(certificate, ignored)) {
    lines.push_back(fmt::format("{}: no such file", certificate.string()));
    return false;
  }
  const auto bytes = corpus::read_bytes(certificate);
  if (!bytes) {
    lines.push_back(bytes.error().message);
    return false;
  }
  auto stated = corpus::parse_json(bytes.value(), certificate);
  if (!stated) {
    lines.push_back(stated.error().message);
    return false;
  }
  if (!stated.value().is_object()) {
    lines.push_back(fmt::format("{}: is no JSON object", certificate.string()));
    return false;
  }
  result.statement = std::move(stated.value());
  if (const auto older = other_schema(result.statement)) {
    lines.push_back(
        fmt::format("{}: of schema {}, this assay verifies {}: verify it with the assay "
                    "that issued it",
                    certificate.string(), *older, certificate_schema));
    return false;
  }
  return true;
}

std::filesystem::path folder_of(const std::filesystem::path& certificate) {
  return certificate.has_parent_path() ? certificate.parent_path() : ".";
}

void compare(const std::filesystem::path& certificate, const properties::Expected<Json>& made,
             Verification& result) {
  auto& lines = result.differences;
  if (!made) {
    lines.push_back(made.error().message);
    return;
  }
  const auto folder = folder_of(certificate);
  const Json& computed = made.value();
  compare_fields(&result.statement, &computed, Json::json_pointer(), lines);
  // The bytes of the file are compared as well, because a compressed certificate would be read
  // like its contents, and assay writes none.
  if (lines.empty()) compare_file(certificate, corpus::sha256_of(statement_text(computed)), lines);
  const auto& predicate = computed["predicate"];
  for (const auto& failure : predicate["failures"])
    compare_file(folder / failure["file"].get<std::string>(), failure["sha256"], lines);
  compare_file(folder / "junit.xml", corpus::sha256_of(junit_text(predicate)), lines);
  compare_file(folder / "summary.md", corpus::sha256_of(summary_text(predicate)), lines);
}

std::string difference_of(const Json& a, const Json& b) {
  for (const char* digest : {"program", "worker", "plugin", "generator"}) {
    if (a["digests"][digest] != b["digests"][digest])
      return fmt::format("their digests of the {} differ", digest);
  }
  if (a["detector"] != b["detector"]) return "they are of different detectors";
  if (a["confidence"]["bounds"] != b["confidence"]["bounds"])
    return "they state different numbers of bounds";
  const auto families = [](const Json& p) {
    Json list = Json::array();
    for (const auto& stratum : p["strata"]) list.push_back(stratum["family"]);
    return list;
  };
  return families(a) == families(b) ? "" : "they have different strata";
}

}  // namespace

std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(file_or_folder, ignored)
             ? properties::certificate_file(file_or_folder)
             : file_or_folder;
}

std::string sent_alone(const std::filesystem::path& certificate) {
  Verification read;
  if (!read_certificate(certificate, read)) return "";
  std::error_code ignored;
  const auto folder = folder_of(certificate);
  const bool has_stores = properties::stored_shards(folder).has_value() ||
                          std::filesystem::exists(properties::checks_file(folder), ignored);
  return has_stores ? ""
                    : fmt::format(
                          "{}: the stores that it rests on (*.sqlite) are not beside it: ask "
                          "its issuer for the whole folder",
                          certificate.string());
}

Verification verify_certificate(const std::filesystem::path& certificate) {
  Verification result;
  if (read_certificate(certificate, result))
    compare(certificate, make_statement(folder_of(certificate)), result);
  return result;
}

Verification verify_certificate(const std::filesystem::path& certificate,
                                const properties::Expected<Json>& computed) {
  Verification result;
  if (read_certificate(certificate, result)) compare(certificate, computed, result);
  return result;
}

properties::Expected<Json> pool(const std::vector<Json>& predicates) {
  using properties::Problem;
  std::set<std::pair<std::string, std::uint64_t>> nights;
  for (const auto& p : predicates) {
    const auto difference = difference_of(predicates[0], p);
    const auto& campaign = p["campaign"];
    if (!difference.empty()) {
      return Problem{fmt::format("these nights cannot be pooled: {}", difference)};
    }
    if (!nights.emplace(campaign["name"], campaign["seed"]).second) {
      return Problem{
          fmt::format("these nights cannot be pooled: campaign {} with seed {} is there "
                      "twice",
                      campaign["name"].get<std::string>(), campaign["seed"].get<std::uint64_t>())};
    }
  }
  Json list = Json::array();
  if (predicates.empty()) return list;
  const double risk = predicates[0]["confidence"]["risk_of_each"].get<double>();
  for (std::size_t s = 0; s < predicates[0]["strata"].size(); ++s) {
    const auto& first = predicates[0]["strata"][s];
    for (std::size_t c = 0; c < first["bounds"].size(); ++c) {
      std::uint64_t n = 0, holds = 0;
      for (const auto& p : predicates) {
        const auto& bound = p["strata"][s]["bounds"][c];
        n += bound["n"].get<std::uint64_t>();
        holds += bound["holds"].get<std::uint64_t>();
      }
      list.push_back({{"family", first["family"]},
                      {"configuration", first["bounds"][c]["configuration"]},
                      {"n", n},
                      {"holds", holds},
                      {"bound", properties::upper_bound(n - holds, n, risk)}});
    }
  }
  return list;
}

}  // namespace assay::reports
