# Installs the build tree BUILD into a folder inside it and runs the program from there: it must find all it needs beside itself.
cmake_minimum_required(VERSION 3.25)

function(expect_success)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${code}\n${out}${err}")
  endif()
endfunction()

set(prefix ${BUILD}/installed)
file(REMOVE_RECURSE ${prefix})
expect_success(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
set(program ${prefix}/${BINDIR}/sheen-cts)

# One triangle before the camera, lit from the front.
set(scene ${prefix}/triangle.gltf)
file(WRITE ${scene} [=[{
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_materials_sheen"],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
  "materials": [{"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.5}}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "nodes": [{"mesh": 0}],
  "scenes": [{"nodes": [0]}],
  "scene": 0
}]=])

expect_success(${program} --help)
expect_success(${program} render ${scene} -o ${prefix}/triangle.exr --width 32 --height 32 --light directional:0,0,1:3 --verify)
expect_success(${program} compare ${prefix}/triangle.exr ${prefix}/triangle.exr)
expect_success(${program} list --json)
if(NOT EXISTS ${prefix}/triangle.exr)
  message(FATAL_ERROR "render said it wrote ${prefix}/triangle.exr and did not")
endif()
file(REMOVE_RECURSE ${prefix})
