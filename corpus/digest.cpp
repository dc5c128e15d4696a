#include "corpus/digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "corpus/files.h"

namespace assay::corpus {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void add(const void* bytes, std::size_t size) { EVP_DigestUpdate(context_.get(), bytes, size); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hex();
}

Expected<std::string> sha256_of_file(const std::filesystem::path& path) {
  const OpenFile file(std::fopen(path.c_str(), "rb"));
  const auto failed = [&] { return problem_in(path, std::strerror(errno)); };
  if (!file) return failed();
  Sha256 digest;
  std::array<char, 1 << 16> piece;
  while (const auto size = std::fread(piece.data(), 1, piece.size(), file.get())) {
    digest.add(piece.data(), size);
  }
  if (std::ferror(file.get())) return failed();
  return digest.hex();
}

}  // namespace assay::corpus
