# Writes OUT: a C++ file whose function FUNCTION returns every text of FILES by its path under ROOT, as a list of the
# TYPE that HEADER declares.
set(text "#include \"${HEADER}\"\n\nnamespace wrinkle {\n\n"
         "std::vector<${TYPE}> ${FUNCTION}() {\n    return {\n")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${ROOT} ${file})
  file(READ ${file} content)
  # A string literal may hold 64 KiB; no file comes near that.
  string(APPEND text "        {\"${name}\", R\"~wrinkle~(${content})~wrinkle~\"},\n")
endforeach()
string(APPEND text "    };\n}\n\n}  // namespace wrinkle\n")
file(WRITE ${OUT} "${text}")
