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
