// Versions of the libraries that the oracle's verdicts rest on.
#pragma once

#include <string>

namespace assay::oracle {

// For example "CGAL 5.5.1, GMP 6.2.1, MPFR 4.2.0, MPFI 1.5.3". CGAL's version is that of its
// headers, the others are those of the libraries as loaded.
std::string library_versions();

}  // namespace assay::oracle
