// What every call of the ABI does around its work: checks the instance, catches everything, keeps the error's
// text.
#pragma once

#include <cstring>
#include <new>
#include <string>
#include <type_traits>

#include "checks.h"
#include "frame.h"

struct rg_instance {
  rg::Frame frame;
  rg_log_fn log;
  void* log_user;
  bool told_of_near_volumes = false;  // too many of them: told once
};

namespace rg {

void say(const rg_instance& instance, rg_log_level level, uint32_t message, const std::string& text);
// Keeps the text as the instance's last error (for null: as that of this thread's last failed create), and
// logs it.
rg_result failed(rg_instance* instance, rg_result code, const char* text);
const char* createError();  // of this thread's last failed create
rg_result codeOf(gl::Error::Kind kind);

// Runs a call; whatever is thrown becomes a code and the instance's last error.
template <typename Call>
rg_result guarded(rg_instance* instance, Call&& call) {
  if (instance == nullptr) return failed(nullptr, RG_ERROR_BAD_ARGUMENT, "the instance is null");
  try {
    if constexpr (std::is_void_v<decltype(call(instance->frame))>) {
      call(instance->frame);
      return RG_OK;
    } else {
      return call(instance->frame);
    }
  } catch (const ApiError& e) {
    return failed(instance, e.code(), e.what());
  } catch (const gl::Error& e) {
    return failed(instance, codeOf(e.kind()), e.what());
  } catch (const std::invalid_argument& e) {
    return failed(instance, RG_ERROR_BAD_ARGUMENT, e.what());
  } catch (const std::bad_alloc&) {
    return failed(instance, RG_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    return failed(instance, RG_ERROR_INTERNAL, e.what());
  } catch (...) {
    return failed(instance, RG_ERROR_INTERNAL, "unknown failure");
  }
}

void checkId(uint32_t id, const char* what);

template <typename T>
T* checkOut(T* out, const char* name) {
  if (out == nullptr) refuse(std::string(name) + " is null");
  return out;
}

// An out struct says its size, so that a host compiled against an older header gets no more than it has room
// for.
template <typename T>
void writeStruct(T* out, T value, const char* name) {
  checkOut(out, name);
  const size_t size = knownSize<T>(out->struct_size, name);
  value.struct_size = out->struct_size;
  std::memcpy(out, &value, size);
}

glm::dvec3 finiteVector(const double v[3], const char* name);

}  // namespace rg
