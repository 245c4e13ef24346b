#pragma once

#include <atomic>
#include <cstdint>

namespace rg::rain::test {
extern std::atomic<uint64_t> allocations;  // by operator new, since the program began
}
