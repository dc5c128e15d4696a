// The programs that an export writes beside the arrays of a case, as text: what asks a detector,
// and what is asked of its answers. They know the case by the names that case_export.cpp gives it.
#pragma once

namespace assay::reports {

// Behind the arrays, FOLDER/case.cpp: what an answer breaks of what is claimed, and a program with
// one function to fill in.
extern const char* const judging_program;
// FOLDER/case_plugin.cpp asks a library: how its answers are read; the case's own question, a mesh
// or a query; the program.
extern const char *const reading_program, *const mesh_program, *const query_program;
extern const char* const plugin_program;
// FOLDER/case_test.cpp asks the built-in detector: what stands above its options, and the test.
extern const char *const test_head, *const test_program;

}  // namespace assay::reports
