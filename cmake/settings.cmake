# Compiler settings shared by every target, and morsel_add_module / morsel_add_test.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)  # no program holds the folder that it was built in

option(MORSEL_WARNINGS_AS_ERRORS "Fail on compiler warnings" OFF)
set(MORSEL_SANITIZE "" CACHE STRING "Sanitizers for every target, e.g. address,undefined")
# Seconds that a test of many programs may take.
set(MORSEL_LONG_TEST 1800)
if(MORSEL_SANITIZE)
  set(MORSEL_LONG_TEST 7200)
endif()

add_library(morsel_settings INTERFACE)
# -Wno-restrict: GCC 12 warns falsely about std::string (GCC bug 105651); clang does not know it.
# -ffp-contract=off: the rounding error bounds of the geometric filters, and equal bytes on every
# machine, rest on each operation being rounded once.
target_compile_options(morsel_settings INTERFACE -Wall -Wextra -Wshadow -Wconversion
                       -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                       -ffp-contract=off
                       $<$<BOOL:${MORSEL_WARNINGS_AS_ERRORS}>:-Werror>)
if(MORSEL_SANITIZE)
  target_compile_options(morsel_settings INTERFACE -fsanitize=${MORSEL_SANITIZE}
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(morsel_settings INTERFACE -fsanitize=${MORSEL_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# morsel_add_module(NAME SOURCES … [LIBRARIES …]): compiles one folder of src/ into the library and
# builds the *_test.cpp files beside the sources into one test program, NAME_test.
function(morsel_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(morsel_${name} OBJECT ${ARG_SOURCES})
  target_include_directories(morsel_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include
                             ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(morsel_${name} PRIVATE morsel_settings ${ARG_LIBRARIES})
  target_sources(morsel PRIVATE $<TARGET_OBJECTS:morsel_${name}>)
  target_link_libraries(morsel PRIVATE ${ARG_LIBRARIES})
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  if(MORSEL_BUILD_TESTS AND tests)
    add_executable(${name}_test ${tests})
    target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${name}_test PRIVATE morsel morsel_settings ${ARG_LIBRARIES}
                          GTest::gtest_main)
    include(GoogleTest)
    # Those for a database server share one: tests/CMakeLists.txt.
    gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 TEST_FILTER "-Server/*")
  endif()
endfunction()
