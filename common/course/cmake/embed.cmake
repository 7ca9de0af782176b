# Writes OUTPUT, a C++ source that holds the FILES as character arrays: carlo::web::page_css() is page.css.
#   cmake -DOUTPUT=web_files.cpp -DFILES=a.css,b.js -P embed.cmake
# Arrays, not string literals: compilers limit the length of literals.
string(REPLACE "," ";" files "${FILES}")
set(code "// Made by embed.cmake.\n#include <string_view>\n\nnamespace carlo::web {\n")
foreach(file IN LISTS files)
  cmake_path(GET file FILENAME name)
  string(REPLACE "." "_" name "${name}")
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(................................................................................)"
         "\\1\n" bytes "${bytes}")
  string(APPEND code
         "namespace {\nconst unsigned char ${name}_bytes[] = {\n${bytes}\n};\n}  // namespace\n"
         "std::string_view ${name}() {\n"
         "  return {reinterpret_cast<const char*>(${name}_bytes), sizeof(${name}_bytes)};\n}\n")
endforeach()
string(APPEND code "}  // namespace carlo::web\n")
file(WRITE "${OUTPUT}" "${code}")
