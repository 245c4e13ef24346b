#pragma once
// The ways a model file is broken in by the tests of the loader and of the program.

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "gltf_files.h"

namespace files {

struct Break {
  const char* name;
  std::function<void(Gltf&)> apply;  ///< to a wholeCar()
  const char* expected;              ///< element, and what is wrong with it
};

void PrintTo(const Break& b, std::ostream* out);
extern const std::vector<Break> kBreaks;

/// Whether only a .glb can be broken so.
inline bool onlyBinary(const Break& b) {
  return std::string(b.expected).find("has no uri") != std::string::npos;
}

}  // namespace files
