# cmake -DMODULES=<folder Modules> -DOUT=<header> -P SourceDigest.cmake
# Writes the digest of all that results are made by, names and contents of the modules' sources, as a macro. By it a
# cohort
# that is started again knows whether another state of the program made what lies there, also between two versions and
# where there is no git.
file(GLOB_RECURSE files RELATIVE "${MODULES}" "${MODULES}/*/*/include/*" "${MODULES}/*/*/inner/*"
  "${MODULES}/*/*/src/*" "${MODULES}/*/*/tables/*" "${MODULES}/*/*/job/*" "${MODULES}/*/*/itk/*")
list(SORT files)
set(all "")
foreach(file ${files})
  file(SHA256 "${MODULES}/${file}" digest)
  string(APPEND all "${digest} ${file}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING "${digest}" 0 16 digest)
file(CONFIGURE OUTPUT "${OUT}" CONTENT "#define VOXELCORE_SOURCE_DIGEST \"${digest}\"\n")
