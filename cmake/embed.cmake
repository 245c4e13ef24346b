# Writes a C++ file that holds the text of FILES (a list), found by their path below ROOT.
set(text "#include <string_view>\n\nnamespace ${NAMESPACE} {\nstd::string_view shaderSource(std::string_view path);\n")
string(APPEND text "std::string_view shaderSource([[maybe_unused]] std::string_view path) {\n")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${ROOT} ${file})
  file(READ ${file} source)
  # A raw string literal may not be longer than 64 KiB on every compiler; ours are far shorter.
  string(APPEND text "  if (path == \"${name}\") return R\"RGGLSL(${source})RGGLSL\";\n")
endforeach()
string(APPEND text "  return {};\n}\n}  // namespace ${NAMESPACE}\n")
file(WRITE ${OUT} "${text}")
