// Counts what is allocated, in a file of its own so that the compiler sees the operators as ordinary ones.
#include "allocations.h"

#include <cstdlib>
#include <new>

namespace rg::rain::test {
std::atomic<uint64_t> allocations{0};
}

void* operator new(std::size_t bytes) {
  ++rg::rain::test::allocations;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++rg::rain::test::allocations;
  return std::malloc(bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
