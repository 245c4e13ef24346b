# What nearly every file of ours includes, compiled once for the plugin, once for the host and once for the tests: a build from scratch takes half as
# long. Files still include what they use themselves (clang-tidy reads them without this).
set(RG_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <optional> <random> <span> <string> <vector> <glm/glm.hpp>
    <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp>)

# rg_precompile(TARGET [OWNER] [HEADERS ...]): with the headers of OWNER, or as an owner with the common ones and HEADERS.
function(rg_precompile target)
  cmake_parse_arguments(P "" "OWNER" "HEADERS" ${ARGN})
  if(P_OWNER)
    target_precompile_headers(${target} REUSE_FROM ${P_OWNER})
  else()
    target_precompile_headers(${target} PRIVATE ${RG_COMMON_HEADERS} ${P_HEADERS})
  endif()
endfunction()

# rg_compile_together(TARGET): several files at a time, in builds that are made from scratch more often than edited: what their headers instantiate
# is then compiled once for them all, which halves the time. The preset `debug` compiles file by file, so that an edit costs one.
function(rg_compile_together target)
  if(RG_SANITIZE OR NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # GCC takes the files, which are included, for headers
  endif()
endfunction()
