// Memory on its way to the cache before it is wanted.
//
// The empty statement is for GCC 12, which takes a function that only fetches for one that does nothing and
// leaves out calls of it.
#pragma once

namespace rg::rain {

inline void fetchToRead(const void* at) {
  __builtin_prefetch(at);
  asm volatile("");
}

inline void fetchToWrite(const void* at) {
  __builtin_prefetch(at, 1);
  asm volatile("");
}

}  // namespace rg::rain
