// SHA-256 against the examples in print.
#include "corpus/digest.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/problem_words.h"

namespace assay::corpus {
namespace {

// NIST, "SHA-256 examples" (FIPS 180-4): no byte, one block, two blocks, a million times 'a'.
constexpr const char* of_nothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* of_two_blocks =
    "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
constexpr const char* of_a_million =
    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Digest, AgreesWithValuesInPrint) {
  EXPECT_EQ(sha256_of(""), of_nothing);
  EXPECT_EQ(sha256_of("abc"), of_abc);
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"), of_two_blocks);
  EXPECT_EQ(sha256_of(std::string(1'000'000, 'a')), of_a_million);
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const auto path = std::filesystem::temp_directory_path() / "assay-digest-test";
  std::ofstream(path, std::ios::binary) << std::string(1'000'000, 'a');
  const auto digest = sha256_of_file(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(digest) << digest.error().message;
  EXPECT_EQ(digest.value(), of_a_million);
  const auto none = sha256_of_file(path);
  ASSERT_FALSE(none);
  EXPECT_TRUE(says(none.error(), "assay-digest-test: No such file"));
}

}  // namespace
}  // namespace assay::corpus
