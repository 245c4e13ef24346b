// How a refused call travels to the ABI's edge, where it becomes a code and the instance's last error.
#pragma once

#include <stdexcept>
#include <string>

#include "rainglass/rainglass.h"

namespace rg {

class ApiError : public std::runtime_error {
 public:
  ApiError(rg_result code, const std::string& text) : std::runtime_error(text), code_(code) {}
  rg_result code() const { return code_; }

 private:
  rg_result code_;
};

[[noreturn]] inline void refuse(const std::string& text, rg_result code = RG_ERROR_BAD_ARGUMENT) {
  throw ApiError(code, text);
}

}  // namespace rg
