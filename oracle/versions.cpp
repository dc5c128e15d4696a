#include "oracle/versions.h"

#include <gmp.h>
#include <mpfi.h>
#include <mpfr.h>

namespace assay::oracle {

std::string library_versions() {
  return std::string("CGAL ") + ASSAY_CGAL_VERSION + ", GMP " + gmp_version + ", MPFR " +
         mpfr_get_version() + ", MPFI " + mpfi_get_version();
}

}  // namespace assay::oracle
