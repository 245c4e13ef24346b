// host_sim: see options.cpp for what it does, run.h for how.
#include <cstdio>
#include <exception>

#include "image/hdr.h"
#include "options.h"
#include "run.h"
#include "scenario.h"
#include "scene/scene.h"
#include "window/context.h"

int main(int argc, char** argv) {
  enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2, kNoGl45 = 3 };
  try {
    bool done = false;
    const host::Options options = host::parseOptions(argc, argv, done);
    if (done) return kDone;
    if (!options.drops.empty()) return host::runDrops(options);
    return options.headless ? host::runHeadless(options) : host::runWindow(options);
  } catch (const host::InputError& e) {
    std::fprintf(stderr, "host_sim: %s\n", e.what());
    return kBadInput;
  } catch (const host::SceneError& e) {
    std::fprintf(stderr, "host_sim: %s\n", e.what());
    return kBadInput;
  } catch (const host::HdrError& e) {
    std::fprintf(stderr, "host_sim: %s\n", e.what());
    return kBadInput;
  } catch (const host::NoGl45& e) {
    std::fprintf(stderr, "host_sim: %s\n", e.what());
    return kNoGl45;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "host_sim: %s\n", e.what());
    return kFailed;
  }
}
