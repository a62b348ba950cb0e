# cmake --install: libraries, headers, and lib/cmake/Manzana. A program outside asks for what it needs:
#   find_package(Manzana 0.1 REQUIRED COMPONENTS culling)
#   target_link_libraries(host PRIVATE manzana::culling)
# Each component has an export of its own, so that one that needs little asks for little.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/manzana-${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Manzana)

function(install_component name)
  foreach(target IN LISTS ARGN)
    string(REGEX REPLACE "^manzana_" "" short ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${short})
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${headers}>)
    install(TARGETS ${target} EXPORT manzana_${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endforeach()
  install(EXPORT manzana_${name} NAMESPACE manzana:: FILE ${name}.cmake DESTINATION ${package})
endfunction()

install_component(culling manzana_culling manzana_highway)
install_component(foliage manzana_files manzana_foliage manzana_plant_import)
install_component(scenegraph manzana_scenegraph)
install_component(import manzana_import)
install_component(export manzana_export)
install_component(draw manzana_glad manzana_gl manzana_foliage_gl manzana_draw)
install_component(view manzana_view)

install(TARGETS manzana_c LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})

install(DIRECTORY culling files foliage gl scenegraph manzana DESTINATION ${headers}
  FILES_MATCHING PATTERN "*.h" PATTERN "*_layout.glsl" PATTERN baselines EXCLUDE)
install(DIRECTORY $<TARGET_PROPERTY:manzana_glad,glad_headers>/ DESTINATION ${headers})
find_package(PROJ CONFIG QUIET)  # as scenegraph/import has it
set(with_proj ${PROJ_FOUND})
find_package(GDAL CONFIG QUIET)
set(with_gdal ${GDAL_FOUND})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/ManzanaConfig.cmake.in
  ${PROJECT_BINARY_DIR}/ManzanaConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ManzanaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ManzanaConfig.cmake ${PROJECT_BINARY_DIR}/ManzanaConfigVersion.cmake
  DESTINATION ${package})
# The same for pkg-config; our libraries are static, so theirs are named too.
function(install_pc name description)
  list(TRANSFORM ARGN PREPEND "-l")
  list(JOIN ARGN " " libraries)
  file(RELATIVE_PATH up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/manzana.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
install_pc(manzana-culling "Frustum culling of cities by a BqR-Tree" manzana_culling hwy tbb)
if(with_proj)
  set(proj proj)
endif()
if(with_gdal)
  set(gdal gdal)
endif()
install_pc(manzana-export "Cities to 3D Tiles and GeoPackage"
  manzana_export manzana_import manzana_plant_import manzana_scenegraph manzana_foliage manzana_files manzana_culling
  sqlite3 tinygltf meshoptimizer GeographicLib geos_c expat bz2 z lz4 xxhash stb ${proj} ${gdal} hwy tbb pthread)
install_pc(manzana "Cities and forests, drawn in another program's window"
  manzana_view manzana_draw manzana_foliage_gl manzana_gl manzana_glad manzana_import manzana_plant_import
  manzana_scenegraph manzana_foliage manzana_files manzana_culling tinygltf meshoptimizer GeographicLib geos_c expat bz2 z
  lz4 xxhash stb ${proj} ${gdal} hwy tbb EGL pthread)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
