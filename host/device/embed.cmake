# Writes OUT: a C++ file holding every kernel source of FILES by its path under ROOT.
set(text "#include \"device/kernel_sources.h\"\n\nnamespace wrinkle {\n\n"
         "std::vector<KernelSource> embedded_kernel_sources() {\n    return {\n")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${ROOT} ${file})
  file(READ ${file} content)
  # A string literal may hold 64 KiB; no kernel file comes near that.
  string(APPEND text "        {\"${name}\", R\"~wrinkle~(${content})~wrinkle~\"},\n")
endforeach()
string(APPEND text "    };\n}\n\n}  // namespace wrinkle\n")
file(WRITE ${OUT} "${text}")
