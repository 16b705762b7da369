# tools/drivers.sh: what it refuses, a driver that is not there, and a run on the two drivers that need no further package. Arguments: SCRIPT,
# PROGRAM, FOLDER (emptied first).
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${FOLDER})
set(one_case --suite core --filter defaults.sheen_empty --report ${FOLDER})

set(program ${PROGRAM})
# expect(CODE TEXT ARGUMENTS...): the script ends with that code and says that text.
function(expect code text)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=GTEST_FILTER XDG_CACHE_HOME=${FOLDER}/cache
    ${SCRIPT} --program ${program} ${ARGN} RESULT_VARIABLE ended OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT ended STREQUAL code)
    message(FATAL_ERROR "${ARGN}: ends with ${ended}, not with ${code}: ${said}")
  endif()
  string(FIND "${said}" "${text}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "${ARGN}: does not say '${text}': ${said}")
  endif()
endfunction()

expect(2 "usage:" --nonsense 1)
expect(2 "usage:" --driver)
expect(2 "usage:" --driver nouveau)
expect(2 "unknown suite 'none'" --driver softpipe --suite none)
expect(2 "no case" --driver softpipe --filter no_such_case)

# Without a Vulkan driver Mesa gives no zink: nothing may run under its name.
set(ENV{VK_ICD_FILENAMES} ${FOLDER}/none.json)
expect(4 "apt-get install mesa-vulkan-drivers" --driver zink ${one_case})
if(EXISTS ${FOLDER}/zink)
  message(FATAL_ERROR "a run has begun on a driver that is not there")
endif()

# Nor may llvmpipe run as softpipe, from the beginning or later on.
foreach(always true false)
  set(program ${FOLDER}/falls_back.sh)
  file(WRITE ${program} "#!/bin/sh\n${always} || [ \"$1\" != serve ] && export GALLIUM_DRIVER=llvmpipe\nexec '${PROGRAM}' \"$@\"\n")
  file(CHMOD ${program} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  expect(4 "llvmpipe" --driver softpipe ${one_case})
  if(EXISTS ${FOLDER}/index.html)
    message(FATAL_ERROR "the report calls llvmpipe softpipe")
  endif()
endforeach()

set(program ${PROGRAM})
expect(0 "report: " --driver llvmpipe-egl --driver softpipe ${one_case})
file(READ ${FOLDER}/drivers.json joined)
foreach(index 0 1)
  string(JSON name GET "${joined}" drivers ${index} name)
  string(JSON renderer GET "${joined}" drivers ${index} renderer)
  string(JSON passed GET "${joined}" drivers ${index} summary pass)
  string(REPLACE "-egl" "" driver ${name})
  if(NOT renderer MATCHES "^${driver}" OR NOT passed EQUAL 1)
    message(FATAL_ERROR "${name}: ${passed} passed on ${renderer}")
  endif()
endforeach()
