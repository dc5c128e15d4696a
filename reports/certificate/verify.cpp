#include "reports/certificate/verify.h"

#include <fmt/format.h>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "reports/certificate/junit.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;

// A leaf that only one side has, or that differs. Objects and lists without anything are leaves.
void compare_fields(const Json& stated, const Json& computed, Lines& lines) {
  const Json one = stated.flatten(), other = computed.flatten();
  for (const auto& [place, value] : one.items()) {
    if (!other.contains(place)) {
      lines.push_back(
          fmt::format("{}: {} is stated, nothing of it is stored", place, value.dump()));
    } else if (other[place] != value) {
      lines.push_back(fmt::format("{}: {} is stated, {} is computed", place, value.dump(),
                                  other[place].dump()));
    }
  }
  for (const auto& [place, value] : other.items()) {
    if (!one.contains(place))
      lines.push_back(fmt::format("{}: is not stated, {} is computed", place, value.dump()));
  }
}

void compare_file(const std::filesystem::path& file, const std::string& sha256, Lines& lines) {
  const auto digest = corpus::sha256_of_file(file);
  if (!digest) {
    lines.push_back(digest.error().message);
  } else if (digest.value() != sha256) {
    lines.push_back(fmt::format("{}: its bytes are not those that were certified", file.string()));
  }
}

// The schema that a certificate of another version names.
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

}  // namespace

Verification verify_certificate(const std::filesystem::path& certificate) {
  Verification result;
  auto& lines = result.differences;
  const auto folder = certificate.has_parent_path() ? certificate.parent_path() : ".";
  const auto bytes = corpus::read_bytes(certificate);
  if (!bytes) {
    lines.push_back(bytes.error().message);
    return result;
  }
  result.statement = Json::parse(bytes.value(), nullptr, false);
  if (!result.statement.is_object()) {
    lines.push_back(fmt::format("{}: is no JSON object", certificate.string()));
    result.statement = nullptr;
    return result;
  }
  if (const auto older = other_schema(result.statement)) {
    lines.push_back(
        fmt::format("{}: of schema {}, this assay verifies {}: verify it with the assay "
                    "that issued it",
                    certificate.string(), *older, certificate_schema));
    return result;
  }
  const auto made = make_statement(folder);
  if (!made) {
    lines.push_back(made.error().message);
    return result;
  }
  const Json& computed = made.value();
  compare_fields(result.statement, computed, lines);
  if (lines.empty() && bytes.value() != statement_text(computed))
    lines.push_back(fmt::format("{}: not written as assay writes it", certificate.string()));
  const auto& predicate = computed["predicate"];
  for (const auto& failure : predicate["failures"])
    compare_file(folder / failure["file"].get<std::string>(), failure["sha256"], lines);
  compare_file(folder / "junit.xml", corpus::sha256_of(junit_text(predicate)), lines);
  compare_file(folder / "summary.md", corpus::sha256_of(summary_text(predicate)), lines);
  return result;
}

}  // namespace assay::reports
