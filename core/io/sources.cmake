# Mesh files and the winding they are read with; paths relative to core/.
set(KINEMESH_IO_SOURCES
  orient.cpp
  io/assembler.cpp
  io/atomic_file.cpp
  io/gmsh_read.cpp
  io/gmsh_write.cpp
  io/mesh_io.cpp
  io/obj.cpp
  io/off.cpp
  io/ply.cpp
  io/scanner.cpp
  io/su2.cpp
  io/svg.cpp
  io/vtu_array.cpp
  io/vtu_read.cpp
  io/vtu_write.cpp
  io/writable.cpp)
