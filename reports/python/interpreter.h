// The interpreter that a detector in Python runs in, inside of the plug-in that serves it.
#pragma once

namespace assay::python {

// Starts the interpreter once and leaves it free; it is never ended. ASSAY_PYTHON names its
// executable, which says where its modules are; else it is the one that the plug-in was built for.
// `package`: the folder in which the package assay lies. Throws std::runtime_error.
void start_interpreter(const char* package);

}  // namespace assay::python
