# libargand.so: the sum of the modules.  The tests link the same objects statically,
# so that they can reach what is not public.
set(modules base image scene bake gpu render trace)
list(TRANSFORM modules PREPEND argand_ OUTPUT_VARIABLE targets)

add_library(argand SHARED)
add_library(argand::argand ALIAS argand) # as those who find it installed call it
add_library(argand_static STATIC EXCLUDE_FROM_ALL)
foreach(target ${targets})
    target_sources(argand PRIVATE $<TARGET_OBJECTS:${target}>)
    target_sources(argand_static PRIVATE $<TARGET_OBJECTS:${target}>)
endforeach()
target_link_libraries(argand PRIVATE ${targets})
target_link_libraries(argand_static PUBLIC ${targets} m)
target_link_libraries(argand PRIVATE m)
target_link_options(argand PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/argand.map)
set_property(TARGET argand APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/argand.map)
target_include_directories(argand INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
set_target_properties(argand PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION 0
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
