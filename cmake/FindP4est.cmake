# p4est, a forest of octrees, with the MPI that it was built with: target P4est::p8est. It is GPL, so that tests
# and benchmarks alone may use it.
include(FindPackageHandleStandardArgs)
find_path(P4EST_INCLUDE p8est.h)
find_library(P4EST_LIBRARY p4est)
find_library(SC_LIBRARY sc)
find_package(MPI QUIET COMPONENTS CXX)
find_package_handle_standard_args(P4est REQUIRED_VARS P4EST_LIBRARY SC_LIBRARY P4EST_INCLUDE MPI_CXX_FOUND)
mark_as_advanced(P4EST_INCLUDE P4EST_LIBRARY SC_LIBRARY)
if(P4est_FOUND AND NOT TARGET P4est::p8est)
  add_library(P4est::p8est INTERFACE IMPORTED)
  target_include_directories(P4est::p8est SYSTEM INTERFACE ${P4EST_INCLUDE})
  target_link_libraries(P4est::p8est INTERFACE ${P4EST_LIBRARY} ${SC_LIBRARY} MPI::MPI_CXX)
endif()
