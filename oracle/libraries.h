// Tells the versions of the libraries on which the oracle's verdicts rest, and registers a function
// that ends the program when these libraries find no memory.
#pragma once

#include <string>

namespace assay::oracle {

// Returns, for example, "CGAL 5.5.1, GMP 6.2.1, MPFR 4.2.0, MPFI 1.5.3". CGAL's version is read
// from its headers, the other versions from the loaded libraries.
std::string library_versions();

// Registers the function that ends the program: from now on, when GMP finds no memory, GMP calls
// `end` instead of abort. `end` must not return, and it must not throw because an exception cannot
// leave GMP's code. REQUIRES that no exact number has been made yet.
void end_without_memory(void (*end)());

}  // namespace assay::oracle
