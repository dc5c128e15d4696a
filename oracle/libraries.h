// The libraries that the oracle's verdicts rest on: their versions, and the end of the program when
// their exact numbers find no memory.
#pragma once

#include <string>

namespace assay::oracle {

// Returns, for example, "CGAL 5.5.1, GMP 6.2.1, MPFR 4.2.0, MPFI 1.5.3". CGAL's version is that of
// its headers, the others are those of the libraries as loaded.
std::string library_versions();

// Registers the function that ends the program: from now on `end` is called when GMP finds no
// memory, in place of GMP's abort. `end` must not return, and it must not throw because an
// exception cannot leave GMP's code. REQUIRES that no exact number has been made yet.
void end_without_memory(void (*end)());

}  // namespace assay::oracle
