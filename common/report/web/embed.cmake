# Writes OUTPUT, a C++ source that holds the FILES as character arrays:
#   cmake -DOUTPUT=web_files.cpp -DNAMES=a,b -DFILES=a.css,b.js -P embed.cmake
# An array, not a string literal: compilers limit the length of literals.
string(REPLACE "," ";" names "${NAMES}")
string(REPLACE "," ";" files "${FILES}")
set(code "// Made by embed.cmake.\n#include \"report/web_files.h\"\n\nnamespace carlo::web {\n")
foreach(name file IN ZIP_LISTS names files)
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
