# Compiler settings shared by every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_LINK_LIBRARIES_ONLY_TARGETS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

set(SEPTET_SANITIZE "" CACHE STRING "Sanitizers to build with, such as address,undefined")
option(SEPTET_FUZZERS "Build the fuzzers too; needs clang and its libFuzzer" OFF)
set(SEPTET_ARCHITECTURE "x86-64-v3" CACHE STRING "Instruction set (-march); empty for the compiler's default")

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND SEPTET_ARCHITECTURE)
  add_compile_options(-march=${SEPTET_ARCHITECTURE})
endif()
# Which products and sums are fused differs between compilers; without it the state hash is the same on all of them. gcc 12 fuses
# alternating sums and differences (vfmaddsub) although contraction is off, so it is given no such instruction.
add_compile_options(-ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-mno-fma)
  # For what only draws, where the instruction set has it.
  if(SEPTET_ARCHITECTURE MATCHES "^x86-64-v[34]$")
    set(SEPTET_FUSED_OPTION -mfma)
  endif()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc 12 sees bounds broken within std::string's own operator+ (where a text is so long that it knows its end, as a path may be) and within
  # std::vector as it grows, and an empty std::optional read within its own destructor.
  add_compile_options(-Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict -Wno-maybe-uninitialized)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_C_FLAGS_RELEASE "-O2")
# A slip in reading what comes from outside is to stop a program, not to be used (tests/hardening looks at the programs). Checked copies need an
# optimising compiler; sanitizers have guards of their own.
if(NOT SEPTET_SANITIZE)
  set(module $<STREQUAL:$<TARGET_PROPERTY:TYPE>,MODULE_LIBRARY>)
  add_compile_options($<$<NOT:${module}>:-fPIE> -fstack-protector-strong -fstack-clash-protection $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=3>
                      -D_GLIBCXX_ASSERTIONS)  # Each index of a std::vector, std::span and the like is looked at.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options(-fcf-protection)
  endif()
  add_link_options($<$<NOT:${module}>:-pie> -Wl,-z,relro,-z,now,-z,noexecstack)
endif()
if(SEPTET_SANITIZE)
  add_compile_options(-fsanitize=${SEPTET_SANITIZE} -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${SEPTET_SANITIZE})
  if(SEPTET_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)  # What is only told fails no test.
    # Checks at every access, a third of the compiler's time: the address sanitizer sees what they lead to, but for alignment, which x86 does not ask for.
    add_compile_options(-fno-sanitize=null,object-size,vptr,alignment)
  endif()
  set(CMAKE_CXX_FLAGS_RELEASE "-O1")
endif()

# A build from nothing takes half the time with one precompiled header. Without it every file must include what it uses.
option(SEPTET_PRECOMPILE "Precompile the headers that most files include" ON)

# A machine compiles once what its checkouts have in common: paths below a checkout count from its root, in what is compiled too, and a precompiled
# header is known by its bytes (gcc is told to name it, clang to leave the time out of it).
find_program(SEPTET_CCACHE ccache)
if(SEPTET_CCACHE)
  foreach(language IN ITEMS C CXX)
    set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime CCACHE_MAXSIZE=20G ${SEPTET_CCACHE})
  endforeach()
endif()
add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
else()
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

find_package(PkgConfig REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(tl-expected REQUIRED)
find_package(CLI11 REQUIRED)
