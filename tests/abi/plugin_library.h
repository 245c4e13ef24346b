// The plugin as a host has it: a file that is opened, and a table of functions.
#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "rainglass/rainglass.h"

namespace rg::test {

class PluginLibrary {
 public:
  static std::string path() { return std::string(RG_BIN_DIR) + "/librainglass.so"; }

  PluginLibrary() : handle_(dlopen(path().c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) throw std::runtime_error(dlerror());
    entry = reinterpret_cast<const rg_api* (*)(uint32_t)>(dlsym(handle_, "rg_get_entry"));
    if (entry == nullptr) throw std::runtime_error("no rg_get_entry");
    api = entry(RG_ABI_VERSION);
    if (api == nullptr) throw std::runtime_error("no table");
  }
  ~PluginLibrary() { dlclose(handle_); }
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  void* symbol(const char* name) const { return dlsym(handle_, name); }
  static bool isLoaded() {
    void* again = dlopen(path().c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (again != nullptr) dlclose(again);
    return again != nullptr;
  }

  const rg_api* (*entry)(uint32_t) = nullptr;
  const rg_api* api = nullptr;  // for this header

 private:
  void* handle_;
};

}  // namespace rg::test
