#include "oracle/libraries.h"

#include <gmp.h>
#include <mpfi.h>
#include <mpfr.h>

#include <cstdlib>

namespace assay::oracle {
namespace {

void (*end_of_process)() = std::abort;

void* checked(void* memory) {
  if (!memory) end_of_process();
  return memory;
}
void* allocate(std::size_t size) { return checked(std::malloc(size)); }
void* reallocate(void* memory, std::size_t, std::size_t size) {
  return checked(std::realloc(memory, size));
}
void release(void* memory, std::size_t) { std::free(memory); }

}  // namespace

void end_without_memory(void (*end)()) {
  end_of_process = end;
  mp_set_memory_functions(allocate, reallocate, release);
}

std::string library_versions() {
  return std::string("CGAL ") + ASSAY_CGAL_VERSION + ", GMP " + gmp_version + ", MPFR " +
         mpfr_get_version() + ", MPFI " + mpfi_get_version();
}

}  // namespace assay::oracle
