# project_warnings: how our own code is compiled. Linked PRIVATE, so that nothing reaches a user of the libraries.
add_library(project_warnings INTERFACE)
target_compile_options(project_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual -Wunused -Woverloaded-virtual
  -Wdouble-promotion -Wimplicit-fallthrough -Werror -ffp-contract=off)

# Sanitizers and fuzzing are for the whole build, so that containers agree about their layout.
if(MANZANA_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(MANZANA_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# manzana_library(name SOURCES...): the target manzana_name, known as manzana::name, headers under the project's root.
function(manzana_library name)
  add_library(manzana_${name} STATIC ${ARGN})
  add_library(manzana::${name} ALIAS manzana_${name})
  target_include_directories(manzana_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(manzana_${name} PRIVATE $<BUILD_INTERFACE:project_warnings>)
endfunction()
