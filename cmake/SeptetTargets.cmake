# Four functions make every target of the project, so that a folder's CMakeLists.txt is a few lines.

# The headers that most files include, precompiled once for all targets.
set(SEPTET_COMMON_HEADERS <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional>
    <set> <span> <sstream> <string> <variant> <vector> <fmt/format.h> <glm/glm.hpp> <glm/gtc/matrix_transform.hpp>
    <glm/gtc/quaternion.hpp> <tl/expected.hpp>)
set(SEPTET_WARNINGS -Wall -Wextra -Wno-missing-field-initializers)
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND SEPTET_WARNINGS -Wno-unknown-pragmas)  # Some speak to gcc's vectoriser alone.
endif()
if(CMAKE_UNITY_BUILD)
  # In a lump every file looks like a header to gcc, and the names of one file like those that the next one hides.
  list(APPEND SEPTET_WARNINGS $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
else()
  list(APPEND SEPTET_WARNINGS -Wshadow)
endif()
# Hot libraries are worth the vectoriser's full effort, and its blends instead of branches; none of these flags changes a result.
if(SEPTET_SANITIZE)
  set(SEPTET_HOT_OPTIONS -O2)
else()
  set(SEPTET_HOT_OPTIONS $<$<CONFIG:Release>:-O3>)
  # Small objects are cleared and copied by plain stores: `rep stos` takes longer to begin than they take.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND SEPTET_HOT_OPTIONS -mmemset-strategy=vector_loop:512:noalign,libcall:-1:noalign
         -mmemcpy-strategy=vector_loop:512:noalign,libcall:-1:noalign)
  endif()
endif()
list(APPEND SEPTET_HOT_OPTIONS -fno-math-errno -fno-trapping-math)
# For what is compiled more often than it runs, as tests are: a third less of the compiler's time than with -O2. Where a sanitizer watches,
# optimising a test takes as long again as all the rest.
if(SEPTET_SANITIZE)
  set(SEPTET_COLD_OPTIONS -O0)
  # Half of the compiler's time goes: 25.8 s became 11.3 for a lump of logging. Where tests reckon, they would take twice as long.
  set(SEPTET_COLD_LIBRARY_OPTIONS -O0)
else()
  set(SEPTET_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)
endif()
# What was precompiled with other options crashes the compiler, so hot libraries and tests have their own.
if(SEPTET_PRECOMPILE)
  file(WRITE ${CMAKE_BINARY_DIR}/precompiled.cpp "")
  foreach(precompiled IN ITEMS septet_precompiled septet_precompiled_hot septet_precompiled_cold septet_precompiled_test)
    add_library(${precompiled} STATIC EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(${precompiled} PUBLIC fmt::fmt tl::expected)
    target_precompile_headers(${precompiled} PRIVATE ${SEPTET_COMMON_HEADERS})
  endforeach()
  target_compile_options(septet_precompiled_hot PRIVATE ${SEPTET_HOT_OPTIONS})
  target_compile_options(septet_precompiled_cold PRIVATE ${SEPTET_COLD_LIBRARY_OPTIONS})
  target_compile_options(septet_precompiled_test PRIVATE ${SEPTET_COLD_OPTIONS})
  target_precompile_headers(septet_precompiled_test PRIVATE <doctest/doctest.h>)
endif()
function(septet_precompile target from)
  if(SEPTET_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()

# Every FILE.toml of the target's folder becomes build/…/generated/FOLDER/FILE.toml.inc.
function(septet_sourced_entries target)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.toml)
  foreach(file IN LISTS files)
    set(entries ${CMAKE_BINARY_DIR}/generated/${file}.inc)
    set(script ${CMAKE_SOURCE_DIR}/cmake/sourced_entries.py)
    add_custom_command(OUTPUT ${entries} COMMAND Python3::Interpreter ${script} ${CMAKE_SOURCE_DIR}/${file} ${entries}
                       DEPENDS ${script} ${CMAKE_SOURCE_DIR}/${file} VERBATIM)
    target_sources(${target} PRIVATE ${entries})
    target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
  endforeach()
endfunction()

# Each of these text files of the target's folder becomes build/…/generated/FOLDER/FILE.inc, string literals of C++.
function(septet_embedded_texts target)
  foreach(name IN LISTS ARGN)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE folder)
    set(literals ${CMAKE_BINARY_DIR}/generated/${folder}/${name}.inc)
    set(script ${CMAKE_SOURCE_DIR}/cmake/embedded_text.py)
    add_custom_command(OUTPUT ${literals} COMMAND Python3::Interpreter ${script} ${CMAKE_CURRENT_SOURCE_DIR}/${name} ${literals}
                       DEPENDS ${script} ${CMAKE_CURRENT_SOURCE_DIR}/${name} VERBATIM)
    target_sources(${target} PRIVATE ${literals})
    target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
  endforeach()
endfunction()

# Each of these shaders becomes build/…/generated/FOLDER/FILE.inc, comma-separated words of SPIR-V. Shaders include what lies beside them, and
# engine/light by its path from the root; a change of either makes them anew.
find_program(SEPTET_GLSLC glslc REQUIRED)
function(septet_shaders target)
  foreach(shader IN LISTS ARGN)
    cmake_path(RELATIVE_PATH shader BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE path)
    set(words ${CMAKE_BINARY_DIR}/generated/${path}.inc)
    cmake_path(GET words PARENT_PATH folder)
    file(MAKE_DIRECTORY ${folder})
    add_custom_command(OUTPUT ${words}
      COMMAND ${SEPTET_GLSLC} --target-env=vulkan1.3 -O -mfmt=num -I ${CMAKE_SOURCE_DIR} -MD -MF ${words}.d -o ${words} ${shader}
      DEPENDS ${shader} DEPFILE ${words}.d COMMENT "Shader ${path}" VERBATIM)
    target_sources(${target} PRIVATE ${words})
  endforeach()
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()

# Each header includes what it needs: a file of the same name includes it first (tests/architecture), and those that have no such file become
# files of their own, which .ci/alone reads.
function(septet_lone_headers library headers)
  if(CMAKE_UNITY_BUILD)
    return()
  endif()
  set(lone)
  foreach(header IN LISTS headers)
    cmake_path(REPLACE_EXTENSION header LAST_ONLY .cpp OUTPUT_VARIABLE source)
    if(NOT EXISTS ${source})
      cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE path)
      set(alone ${CMAKE_BINARY_DIR}/lone_headers/${path}.cpp)
      file(CONFIGURE OUTPUT ${alone} CONTENT "#include \"${path}\"\n")
      list(APPEND lone ${alone})
    endif()
  endforeach()
  if(lone)
    add_library(${library}_headers OBJECT EXCLUDE_FROM_ALL ${lone})
    target_compile_options(${library}_headers PRIVATE ${SEPTET_WARNINGS})
    target_link_libraries(${library}_headers PRIVATE ${library})
    septet_precompile(${library}_headers septet_precompiled)
  endif()
endfunction()

# septet_library(NAME [HOT|COLD] [DEPENDS library…] [PRIVATE library…])
# A static library `septet_NAME` of all .cpp files below this folder, which may include its FILE.toml as FILE.toml.inc (sourced_entries.py), and of
# its headers, which are included by their path from the root. HOT: a server's tick is spent there. COLD: no test spends
# its time there, so a sanitizer's build does not optimise it. DEPENDS names other Septet libraries without their prefix; PRIVATE
# names third-party targets, whose headers stay in the .cpp files.
function(septet_library name)
  cmake_parse_arguments(arg "HOT;COLD" "" "DEPENDS;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  list(FILTER sources EXCLUDE REGEX "(_main|/main)\\.cpp$")
  # A folder below with a CMakeLists.txt of its own is another target.
  file(GLOB_RECURSE others CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*/CMakeLists.txt)
  foreach(other IN LISTS others)
    get_filename_component(folder ${other} DIRECTORY)
    list(FILTER sources EXCLUDE REGEX "^${folder}/")
    list(FILTER headers EXCLUDE REGEX "^${folder}/")
  endforeach()
  if(sources)
    add_library(septet_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_compile_options(septet_${name} PRIVATE ${SEPTET_WARNINGS})
    target_link_libraries(septet_${name} PRIVATE ${arg_PRIVATE})
    if(arg_HOT)
      target_compile_options(septet_${name} PRIVATE ${SEPTET_HOT_OPTIONS})
      septet_precompile(septet_${name} septet_precompiled_hot)
    elseif(arg_COLD)
      target_compile_options(septet_${name} PRIVATE ${SEPTET_COLD_LIBRARY_OPTIONS})
      septet_precompile(septet_${name} septet_precompiled_cold)
    else()
      septet_precompile(septet_${name} septet_precompiled)
    endif()
  else()
    add_library(septet_${name} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(septet_${name} INTERFACE ${arg_PRIVATE})
  endif()
  target_sources(septet_${name} ${scope} FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR} FILES ${headers})
  septet_lone_headers(septet_${name} "${headers}")
  septet_sourced_entries(septet_${name})
  list(TRANSFORM arg_DEPENDS PREPEND septet_)
  target_link_libraries(septet_${name} ${scope} ${arg_DEPENDS})
endfunction()

# septet_program(NAME [THIN] SOURCE main.cpp [DEPENDS library…] [PRIVATE library…])
# THIN: main.cpp only reads options and calls a library. It is not optimised: the option parser's templates take twice as long to
# compile if they are.
function(septet_program name)
  cmake_parse_arguments(arg "THIN" "" "SOURCE;DEPENDS;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCE})
  target_compile_options(${name} PRIVATE ${SEPTET_WARNINGS})
  list(TRANSFORM arg_DEPENDS PREPEND septet_)
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS} ${arg_PRIVATE})
  if(arg_THIN)
    target_compile_options(${name} PRIVATE -O0 -U_FORTIFY_SOURCE)
  else()
    septet_precompile(${name} septet_precompiled)
  endif()
endfunction()

# septet_verdict(VARIABLE [READS path…] [STARTS program…] [WRITES folder…] [MOUNTS case…])
# The beginning of a test's command, to which its program and arguments are added: a test that takes anything of the checkout but what is declared
# here fails; one that this machine has seen pass with all of it as it is is not run again (.ci/verdict).
# READS: what it reads of the checkout, from its root. STARTS: programs and modules of the build that it starts or loads, from the build folder.
# WRITES: folders of the build where it reads again what it has written. MOUNTS: a part of the name of a case that mounts a file system, which is
# run always.
function(septet_verdict variable)
  cmake_parse_arguments(arg "" "" "READS;STARTS;WRITES;MOUNTS" ${ARGN})
  set(command ${CMAKE_SOURCE_DIR}/.ci/verdict --build=${CMAKE_BINARY_DIR})
  foreach(list IN ITEMS READS STARTS WRITES MOUNTS)
    list(JOIN arg_${list} "," paths)
    string(TOLOWER ${list} option)
    list(APPEND command --${option}=${paths})
  endforeach()
  set(${variable} ${command} -- PARENT_SCOPE)
endfunction()

# septet_script_test(FACT LABEL COMMAND program argument… [READS path…] [STARTS program…] [WRITES folder…])
# A test that is a script or a program of another's, with a verdict as above; it is skipped with status 77. The folder that calls this is among what
# it reads.
function(septet_script_test fact label)
  cmake_parse_arguments(arg "" "" "COMMAND;READS;STARTS;WRITES" ${ARGN})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE own)
  set(verdict)
  if(NOT label STREQUAL "long")
    septet_verdict(verdict READS ${own} ${arg_READS} STARTS ${arg_STARTS} WRITES ${arg_WRITES})
  endif()
  add_test(NAME ${fact} COMMAND ${verdict} ${arg_COMMAND})
  set_tests_properties(${fact} PROPERTIES LABELS ${label} TIMEOUT 7200 SKIP_RETURN_CODE 77)
endfunction()

# septet_test(NAME [HOT] [DRAWS] [THREADS] [DEPENDS library…] [PRIVATE library…] [READS path…] [STARTS program…] [MOUNTS case…])
# One doctest program, label fast, of this folder's *_test.cpp files, one, label slow, of its *_slow_test.cpp files (a slow test starts processes,
# draws frames or runs for more than a second), and one, label long, of its *_long_test.cpp files (proofs that drive for hours; `./test --long`).
# HOT: its tests reckon long themselves and are optimised as the product is. DRAWS: its slow tests draw within the program; the address sanitizer's
# build has these slow ones and no others (label slow-drawn). THREADS: its fast tests start threads; the thread sanitizer's build has these and no
# others. Every test case is one CTest test. The limits are for a hang, however busy the machine. Fast and slow ones have a verdict (above); STARTS
# is for slow ones.
function(septet_test name)
  file(GLOB fast_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  file(GLOB slow_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_slow_test.cpp)
  file(GLOB long_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_long_test.cpp)
  list(REMOVE_ITEM fast_sources ${slow_sources} ${long_sources} "")
  septet_test_program(${name}_test fast 1800 "${fast_sources}" ${ARGN})
  set(slow slow)
  if("DRAWS" IN_LIST ARGN)
    set(slow slow-drawn)
  endif()
  septet_test_program(${name}_slow_test ${slow} 7200 "${slow_sources}" ${ARGN})
  septet_test_program(${name}_long_test long 14400 "${long_sources}" ${ARGN})
endfunction()

function(septet_test_program name label timeout_s sources)
  cmake_parse_arguments(arg "HOT;DRAWS;THREADS" "" "DEPENDS;PRIVATE;READS;STARTS;MOUNTS" ${ARGN})
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_compile_options(${name} PRIVATE ${SEPTET_WARNINGS})
  if(arg_HOT)
    septet_precompile(${name} septet_precompiled)
  else()
    target_compile_options(${name} PRIVATE ${SEPTET_COLD_OPTIONS})
    septet_precompile(${name} septet_precompiled_test)
  endif()
  list(TRANSFORM arg_DEPENDS PREPEND septet_)
  target_link_libraries(${name} PRIVATE septet_test_main ${arg_DEPENDS} ${arg_PRIVATE})
  if(SEPTET_SANITIZE STREQUAL "thread" AND NOT (arg_THREADS AND label STREQUAL "fast"))
    return()
  endif()
  add_dependencies(${label}_tests ${name})  # So that a sanitizer build makes only what it runs.
  set(environment)
  if(SEPTET_SANITIZE MATCHES "address" AND label STREQUAL "slow-drawn")
    set(environment ENVIRONMENT LD_PRELOAD=libvulkan_lvp.so)  # .ci/leaks-of-others.txt says why.
  endif()
  if(label STREQUAL "fast")
    set(arg_STARTS)
  endif()
  foreach(started IN LISTS arg_STARTS)
    cmake_path(REMOVE_EXTENSION started OUTPUT_VARIABLE target)
    if(TARGET ${target})
      add_dependencies(${name} ${target})
    else()
      list(REMOVE_ITEM arg_STARTS ${started})  # Its library is not installed.
    endif()
  endforeach()
  if(NOT label STREQUAL "long")
    septet_verdict(verdict READS ${arg_READS} STARTS ${arg_STARTS} WRITES images MOUNTS ${arg_MOUNTS})
    set_target_properties(${name} PROPERTIES CROSSCOMPILING_EMULATOR "${verdict}")  # Put before each of its cases.
  endif()
  doctest_discover_tests(${name} TEST_PREFIX "${name}: " PROPERTIES LABELS ${label} TIMEOUT ${timeout_s} ${environment})
endfunction()
