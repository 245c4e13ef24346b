#include "api_call.h"

#include <cstdio>

namespace rg {
namespace {

constexpr double kMaxDouble = 1.7e308;  // any finite number

// Plain bytes: a thread-local with a destructor would keep the library from being unloaded while its thread
// lives.
thread_local char create_error[256];

}  // namespace

void say(const rg_instance& instance, rg_log_level level, uint32_t message, const std::string& text) {
  if (instance.log != nullptr) instance.log(instance.log_user, level, message, text.c_str());
}

rg_result failed(rg_instance* instance, rg_result code, const char* text) {
  try {
    if (instance != nullptr)
      instance->frame.last_error.set(text);
    else
      std::snprintf(create_error, sizeof create_error, "%s", text);
    if (instance != nullptr) say(*instance, RG_LOG_ERROR, static_cast<uint32_t>(-code), text);
  } catch (...) {
    return RG_ERROR_OUT_OF_MEMORY;
  }
  return code;
}

rg_result codeOf(gl::Error::Kind kind) {
  switch (kind) {
    case gl::Error::Kind::kVersion:
      return RG_ERROR_GL_VERSION;
    case gl::Error::Kind::kDriver:
      return RG_ERROR_GL;
    case gl::Error::Kind::kOutOfMemory:
      return RG_ERROR_OUT_OF_MEMORY;
    case gl::Error::Kind::kWrongOrder:
      return RG_ERROR_WRONG_ORDER;
  }
  return RG_ERROR_INTERNAL;
}

const char* createError() { return create_error; }

void checkId(uint32_t id, const char* what) {
  if (id == 0) refuse(std::string(what) + " id is 0; ids begin at 1");
}

glm::dvec3 finiteVector(const double v[3], const char* name) {
  for (int i = 0; i < 3; ++i) checkRange(v[i], -kMaxDouble, kMaxDouble, name);
  return {v[0], v[1], v[2]};
}

}  // namespace rg
