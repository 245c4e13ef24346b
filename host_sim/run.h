// The ways a run goes. Each returns the exit code.
#pragma once

#include "options.h"

namespace host {

int runHeadless(const Options& options);
int runWindow(const Options& options);
int runDrops(const Options& options);

}  // namespace host
