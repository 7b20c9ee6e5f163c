# SPDX-License-Identifier: Apache-2.0
# Compile options that every target of the project shares, and the way a library is declared.

function(ehm_target_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wdouble-promotion
                                           $<$<BOOL:${EHM_WERROR}>:-Werror>)
endfunction()

if(EHM_SANITIZE)
  add_compile_options(-fsanitize=${EHM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${EHM_SANITIZE})
endif()

# Sanitizers that make a broken promise visible, and clang's coverage for libFuzzer: one build for tests and fuzzers.
if(EHM_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

# ehm_library(name SOURCES a.cpp ... DEPENDS lib ...): a static library whose headers are included from the project's root.
function(ehm_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS})
  ehm_target_options(${name})
endfunction()
