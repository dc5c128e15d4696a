// The versions of the libraries that the oracle's verdicts rest on, and what ends the program when
// an exact number of these libraries finds no memory.
#pragma once

#include <string>

namespace assay::oracle {

// Returns, for example, "CGAL 5.5.1, GMP 6.2.1, MPFR 4.2.0, MPFI 1.5.3". CGAL's version is read
// from its headers, the other versions from the loaded libraries.
std::string library_versions();

// Registers the function that ends the program: GMP calls `end`, in place of abort, from now on
// when it finds no memory. `end` must not return, and it must not throw because an exception cannot
// leave GMP's code. REQUIRES that no exact number has been made yet.
void end_without_memory(void (*end)());

}  // namespace assay::oracle
