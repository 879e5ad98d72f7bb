# cmake -D COMPILER=... -D FLAGS=file -D OPTIMIZE=-O1 -D PRECOMPILED=header -D SOURCE=file.cpp -P must_not_compile.cmake
# Passes if the compiler refuses SOURCE with a message that holds what its first line expects.
cmake_minimum_required(VERSION 3.25)
file(STRINGS ${SOURCE} first_line LIMIT_COUNT 1)
file(STRINGS ${SOURCE} flags_line LIMIT_COUNT 2 REGEX "^// flags: ")
if(NOT first_line MATCHES "^// expect: (.*[^ ])")
    message(FATAL_ERROR "\n  ${SOURCE}: the first line must be\n  // expect: part of the message")
endif()
string(REPLACE "\\;" ";" expected "${CMAKE_MATCH_1}")

# Flags of its own mean that headers parsed before, without them, are of no use.
set(more ${OPTIMIZE} -include ${PRECOMPILED})
if(flags_line MATCHES "^// flags: (.*)")
    separate_arguments(more UNIX_COMMAND "${CMAKE_MATCH_1}")
endif()

set(ENV{LC_ALL} C)
execute_process(COMMAND ${COMPILER} @${FLAGS} ${more} -fsyntax-only ${SOURCE}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0)
    message(FATAL_ERROR "\n  ${SOURCE} compiles, but must not")
endif()
string(FIND "${output}" "${expected}" place)
if(place EQUAL -1)
    string(SUBSTRING "${output}" 0 6000 output)
    message("${output}")
    message(FATAL_ERROR "\n  ${SOURCE}: the compiler does not say\n  ${expected}")
endif()
