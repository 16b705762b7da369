# Every case of a suite passes on one kind of context: none fails, none is left out. Arguments: PROGRAM, SUITE, CONTEXT, FOLDER (emptied first).
cmake_minimum_required(VERSION 3.25)

set(report ${FOLDER}/${SUITE}-${CONTEXT})
file(REMOVE_RECURSE ${report})
execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=GTEST_FILTER XDG_CACHE_HOME=${FOLDER}/cache
  ${PROGRAM} run --suite ${SUITE} --context ${CONTEXT} --strict --report ${report} RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the run of ${SUITE} on ${CONTEXT} ends with ${code}: see ${report}/index.html")
endif()
file(READ ${report}/results.json results)
string(JSON cases LENGTH "${results}" cases)
string(JSON passed GET "${results}" summary pass)
if(NOT passed EQUAL cases OR cases EQUAL 0)
  message(FATAL_ERROR "${passed} of ${cases} cases of ${SUITE} pass on ${CONTEXT}: see ${report}/index.html")
endif()
