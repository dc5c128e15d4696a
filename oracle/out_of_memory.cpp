#include "oracle/out_of_memory.h"

#include <gmp.h>

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

}  // namespace assay::oracle
