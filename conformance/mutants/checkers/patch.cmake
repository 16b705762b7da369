# Writes OUTPUT, a source file with the mistake of that INDEX in the list JSON; INDEX "none" copies FILE as it is. SOURCE is the source tree.
# A passage that does not stand in its file exactly once is an error: a mistake must not become the truth unseen.
cmake_minimum_required(VERSION 3.25)

file(READ "${SOURCE}/${FILE}" text)
if(NOT INDEX STREQUAL "none")
  file(READ "${JSON}" list)
  string(JSON passage GET "${list}" ${INDEX} passage)
  string(JSON instead GET "${list}" ${INDEX} instead)
  string(FIND "${text}" "${passage}" first)
  string(FIND "${text}" "${passage}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "this does not stand in ${FILE} exactly once: ${passage}")
  endif()
  string(REPLACE "${passage}" "${instead}" text "${text}")
endif()
file(WRITE "${OUTPUT}" "${text}")
