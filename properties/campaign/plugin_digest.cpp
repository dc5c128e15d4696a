#include "properties/campaign/plugin_digest.h"

#include "corpus/digest.h"
#include "properties/worker/plugin/python_word.h"

namespace assay::properties {

corpus::Expected<std::string> digest_of_plugin(const std::filesystem::path& plugin,
                                               const std::filesystem::path& worker) {
  if (!names_python(plugin.string())) return corpus::sha256_of_file(plugin);
  std::string digests;
  for (const auto& file :
       {python_plugin(plugin.string(), worker), python_module_file(plugin.string())}) {
    if (!file) return corpus::Problem{corpus::FileProblem::cannot_open, file.error().message};
    const auto digest = corpus::sha256_of_file(file.value());
    if (!digest) return digest.error();
    digests += digest.value();
  }
  return corpus::sha256_of(digests);
}

}  // namespace assay::properties
