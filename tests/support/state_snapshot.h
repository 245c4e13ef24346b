// All of a context's state that GL tells, as numbers with names: for tests that it comes back as it was.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl_context.h"

namespace rg::test {

using Snapshot = std::map<std::string, std::vector<double>>;

// Takes no error flag and leaves all as it is (ACTIVE_TEXTURE is moved and put back).
Snapshot takeSnapshot(const GladGLContext& gl, Profile profile);

// One line for each item that differs, "name: 1 2 -> 3 4"; empty when there is none.
std::string difference(const Snapshot& before, const Snapshot& after);

}  // namespace rg::test
