# rg_embed_shaders(TARGET NAMESPACE FILES...): compiles GLSL files into TARGET as `NAMESPACE::shaderSource("path/in/shaders")`, so that a plugin is
# one file. `#include "x"` is resolved against shaders/ when the program is built (see plugin/src/gl/program.cpp).
function(rg_embed_shaders target namespace)
  set(out ${CMAKE_BINARY_DIR}/shaders/${target}_shaders.cpp)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAMESPACE=${namespace} -DROOT=${CMAKE_SOURCE_DIR}/shaders "-DFILES=${ARGN}"
            -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${ARGN} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()
