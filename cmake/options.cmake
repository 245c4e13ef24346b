# rg_options: the warnings (without -Wnull-dereference, -Warray-bounds, -Wrestrict and -Wstringop-overflow: GCC 12 sees false ones inside std::string, its bug 105651) and sanitizers every target of ours is built with. rg_system marks headers that are not ours.
add_library(rg_options INTERFACE)
target_compile_options(rg_options INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion -Wformat=2 -Wundef -Wcast-align=strict -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
  $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wduplicated-cond -Wlogical-op>)
# The same state whatever the optimiser fuses: falling rain is to be identical across builds and machines. -fno-gnu-unique: dlclose really unloads.
target_compile_options(rg_options INTERFACE -ffp-contract=off $<$<COMPILE_LANGUAGE:CXX>:-fno-gnu-unique>)
# Nobody reads errno after maths, and as long as it must be set no loop with a square root is vectorised.
target_compile_options(rg_options INTERFACE -fno-math-errno)
# Names and lines for back traces and profiles; all of the debugger's rest, which doubles the time of a build, only in the preset `debug`.
if(RG_SANITIZE OR NOT CMAKE_BUILD_TYPE STREQUAL Debug)
  target_compile_options(rg_options INTERFACE -g1)
endif()
if(RG_SANITIZE)
  # GCC 12 reports false uninitialised values in sanitized builds of the standard library.
  target_compile_options(rg_options INTERFACE -fsanitize=${RG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -O1
    -Wno-maybe-uninitialized)
  target_link_options(rg_options INTERFACE -fsanitize=${RG_SANITIZE})
  # Not what another check finds at a third of the compile time: a null pointer ends the program at its first use, unaligned casts are refused when
  # compiled (-Wcast-align=strict), sizes of objects are what the address sanitizer knows, and virtual calls are few.
  if(RG_SANITIZE MATCHES undefined)
    target_compile_options(rg_options INTERFACE -fno-sanitize=null,alignment,object-size,vptr)
  endif()
  # Targets with RG_TEST_CODE are not looked at for undefined behaviour themselves, only what they call, nor optimised: it doubles the time of
  # compiling them.
  target_compile_options(rg_options INTERFACE $<$<BOOL:$<TARGET_PROPERTY:RG_TEST_CODE>>:-fno-sanitize=undefined;-O0>)
endif()
# What tests do themselves is soon done and slow to optimise, a quarter of the time of compiling it. (Those without precompiled headers
# have -O0 of their own.)
if(NOT RG_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
  target_compile_options(rg_options INTERFACE $<$<AND:$<BOOL:$<TARGET_PROPERTY:RG_TEST_CODE>>,$<NOT:$<BOOL:$<TARGET_PROPERTY:DISABLE_PRECOMPILE_HEADERS>>>>:-O1>)
endif()
target_compile_definitions(rg_options INTERFACE GLM_FORCE_XYZW_ONLY GLM_FORCE_EXPLICIT_CTOR)
find_package(glm REQUIRED)
find_package(Threads REQUIRED)
