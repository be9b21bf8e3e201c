# Debian's packages (packages.txt), found by pkg-config.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(spng REQUIRED IMPORTED_TARGET spng)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
pkg_check_modules(webp REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(jansson REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(freetype REQUIRED IMPORTED_TARGET freetype2)
pkg_check_modules(glfw REQUIRED IMPORTED_TARGET glfw3)
pkg_check_modules(vulkan REQUIRED IMPORTED_TARGET vulkan)
find_package(embree 3 REQUIRED)
find_program(GLSLC glslc REQUIRED)
# cglm is headers only (its Debian package has no pkg-config file that needs linking).

# The folder of the viewer's letters; it runs without, and says so.
find_path(ARGAND_FONTS DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu
          /usr/share/fonts/dejavu /usr/share/fonts/TTF NO_DEFAULT_PATH)
if(NOT ARGAND_FONTS)
    message(STATUS "DejaVuSans.ttf is not there: the viewer will show no text")
    set(ARGAND_FONTS /usr/share/fonts/truetype/dejavu)
endif()
