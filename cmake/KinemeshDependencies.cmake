# Everything the libraries link. All are Debian packages; scripts/install_packages.sh names them.
find_package(OpenMesh CONFIG REQUIRED)  # CONFIG: CGAL's own FindOpenMesh module would take over
find_package(glm CONFIG REQUIRED)
find_package(CGAL CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(pugixml CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(muparser CONFIG REQUIRED)
find_package(tomlplusplus CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(CHOLMOD MODULE REQUIRED)  # cmake/FindCHOLMOD.cmake
