# argand_shaders(TARGET FILE...): compile shaders/passes/FILE (or a file of an absolute path)
# to <name>.inc, a C initialiser list of SPIR-V words, on TARGET's include path.
function(argand_shaders target)
    set(directory ${PROJECT_BINARY_DIR}/spirv)
    file(MAKE_DIRECTORY ${directory})
    foreach(file ${ARGN})
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/passes
                   OUTPUT_VARIABLE source)
        cmake_path(GET source FILENAME name)
        set(output ${directory}/${name}.inc)
        add_custom_command(
            OUTPUT ${output}
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O -Werror -mfmt=c -MD -MF ${output}.d
                    -MT ${output} -I ${PROJECT_SOURCE_DIR}/shaders -o ${output} ${source}
            DEPENDS ${source}
            DEPFILE ${output}.d
            COMMENT "SPIR-V ${name}" VERBATIM)
        list(APPEND outputs ${output})
    endforeach()
    target_sources(${target} PRIVATE ${outputs})
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
