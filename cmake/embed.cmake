# argand_embed(TARGET FILE...): make <name>.inc of a text file, a C initialiser list of its bytes
# and a zero, on TARGET's include path.  As a script: one file, INPUT to OUTPUT.
if(CMAKE_SCRIPT_MODE_FILE)
    file(READ ${INPUT} bytes HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    file(WRITE ${OUTPUT} "${bytes}0\n")
    return()
endif()

function(argand_embed target)
    set(directory ${PROJECT_BINARY_DIR}/embedded)
    file(MAKE_DIRECTORY ${directory})
    foreach(file ${ARGN})
        set(output ${directory}/${file}.inc)
        add_custom_command(
            OUTPUT ${output}
            COMMAND ${CMAKE_COMMAND} -DINPUT=${CMAKE_CURRENT_SOURCE_DIR}/${file} -DOUTPUT=${output}
                    -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
            DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
            COMMENT "Embedding ${file}" VERBATIM)
        list(APPEND outputs ${output})
    endforeach()
    target_sources(${target} PRIVATE ${outputs})
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
