// Files that a verb writes: whole, or not at all.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/terminal/work.h"

namespace assay::reports {

// Whether a file can be written at each of these paths (empty: no file is wanted). Fails for a
// folder, a device, one of the inputs, a file that is named twice, and a place without permission.
// Called before the work, so that no work is lost.
Expected<void> may_write(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs = {});

// Makes the folder if it is not there (empty: no folder is wanted), and looks whether these files
// of it can be written. Called before the work in the same way.
Expected<void> may_fill(const std::string& folder, const std::vector<std::string>& files = {});

// Writes the whole file, or leaves the old one as it is.
Expected<void> write_text_file(const std::string& path, const std::string& text);
// Writes JSON in the same way, indented by one; bytes that are no UTF-8 are replaced.
Expected<void> write_json_file(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace assay::reports
