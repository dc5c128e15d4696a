// The interpreter in which a detector in Python runs, inside of the plug-in that serves it.
#pragma once

namespace assay::python {

// Starts the interpreter once and does not hold its lock afterwards; it is never ended.
// ASSAY_PYTHON names its executable, which tells where its modules are; without it, it is the
// interpreter that the plug-in was built for. `package` is the folder in which the package assay
// lies. Throws std::runtime_error.
void start_interpreter(const char* package);

}  // namespace assay::python
