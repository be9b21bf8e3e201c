# One set of flags for every target: `argand_flags`.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(argand_flags INTERFACE)
target_compile_options(argand_flags INTERFACE
    -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Werror
    -Wno-psabi             # 16-byte vectors are passed by value between our own files only
    -fno-math-errno -fno-trapping-math)
target_compile_definitions(argand_flags INTERFACE _POSIX_C_SOURCE=200809L)
target_include_directories(argand_flags INTERFACE
    ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/shaders)

# argand_module(NAME SOURCES ... LIBRARIES ...): one module of src/.
function(argand_module name)
    cmake_parse_arguments(PARSE_ARGV 1 M "" "" "SOURCES;LIBRARIES")
    if(NOT M_SOURCES) # nothing there yet
        file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/empty.c "typedef int empty_${name};\n")
        set(M_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/empty.c)
    endif()
    add_library(argand_${name} OBJECT ${M_SOURCES})
    target_link_libraries(argand_${name} PUBLIC argand_flags ${M_LIBRARIES})
endfunction()
