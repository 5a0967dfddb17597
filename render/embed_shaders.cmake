# Writes a C table of the shader files: {name without .glsl, text}. Bytes as numbers, so that no
# character of GLSL needs escaping.
set(arrays "")
set(rows "")
set(index 0)
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  string(REGEX REPLACE "\\.glsl$" "" name ${name})
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "static const char text_${index}[] = {${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", text_${index}},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT}
     "#include \"shaders.h\"\n\n${arrays}\nconst ShaderFile shader_files[] = {\n${rows}};\nconst int shader_file_count = ${index};\n")
