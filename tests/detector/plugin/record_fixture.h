// Logs that the recorder writes, read back record by record.
#pragma once

#include <zlib.h>

#include <nlohmann/json.hpp>

#include "detector/plugin/assay_record.h"
#include "tests/test.h"

namespace assay::tests {

using nlohmann::json;

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char c : bytes) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

// The bodies of all records. Each frame has just the bytes that it has to have.
inline std::vector<json> records_of(const std::string& path) {
  const std::string all = bytes_of(path);
  std::vector<json> out;
  for (std::size_t at = 0; at < all.size();) {
    if (all.substr(at, 9) !=
        "\x83\x44"
        "ASR1\xD8\x18\x5B") {
      ADD_FAILURE() << "no record at " << at << " of " << path;
      break;
    }
    const auto size = big_endian(std::string_view(all).substr(at + 9, 8));
    const std::string body = all.substr(at + 17, size), trailer = all.substr(at + 17 + size, 5);
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    EXPECT_EQ(trailer.substr(0, 1), "\x1A");
    EXPECT_EQ(big_endian(trailer.substr(1)), sum) << "record at " << at;
    out.push_back(json::from_cbor(body, true, true, json::cbor_tag_handler_t::store));
    at += 17 + size + 5;
  }
  return out;
}

// The numbers of a typed array, whose tag has to be this one.
template <class T>
std::vector<T> numbers(const json& array, unsigned tag) {
  if (!array.is_binary()) {
    ADD_FAILURE() << "no array: " << array;
    return {};
  }
  const auto& bytes = array.get_binary();
  EXPECT_EQ(bytes.subtype(), tag);
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}
inline std::vector<std::int32_t> int32s(const json& array) {
  return numbers<std::int32_t>(array, 78);
}
inline std::vector<float> floats(const json& array) { return numbers<float>(array, 85); }
inline std::vector<double> doubles(const json& array) { return numbers<double>(array, 86); }

// A mesh of two triangles, and a file in a folder of the test's own.
class Recording : public testing::Test {
 protected:
  Recording() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    description.name = "mine";
    description.version = "1.5";
  }
  ~Recording() override {
    if (recorder.is_begun) assay_record_end(&recorder);
    std::filesystem::remove_all(folder);
  }

  std::int32_t begin(const assay_counted_pairs* counted = nullptr) {
    return assay_record_begin(&recorder, &settings, &description, triangles.data(), 2,
                              {rest.data(), 0}, 4, counted);
  }
  std::string error() const { return assay_record_error(&recorder); }
  // A step to where all coordinates are this number.
  std::vector<double> all(double value) const { return std::vector<double>(12, value); }
  std::int32_t step_to(double value) {
    const auto x1 = all(value);
    return assay_record_step(&recorder, step({}, {x1.data(), 0}));
  }
  const assay_record_step_data* step(assay_record_array x0, assay_record_array x1,
                                     assay_record_array committed = {}) {
    data = {};
    data.x0 = x0;
    data.x1 = x1;
    data.committed = committed;
    return &data;
  }
  // The first step says where it starts.
  void first_step() {
    const auto x1 = all(0);
    ASSERT_EQ(assay_record_step(&recorder, step({rest.data(), 0}, {x1.data(), 0})), ASSAY_OK);
  }
  std::vector<json> end() {
    EXPECT_EQ(assay_record_end(&recorder), ASSAY_OK) << error();
    return records_of(path);
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("assay_record_" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  const std::string path = folder / "steps.log";
  const std::vector<std::int32_t> triangles = {0, 1, 2, 2, 1, 3};
  const std::vector<double> rest = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.1};
  assay_record_settings settings = {path.c_str(), 1, 0};
  assay_description description = {};
  assay_recorder recorder = {};
  assay_record_step_data data = {};
};

}  // namespace assay::tests
