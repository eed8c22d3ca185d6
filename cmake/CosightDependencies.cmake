# Debian 12's packages only. Each library is linked by the rooms that may include it (tests/style/include_rules.txt).
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs videoio features2d calib3d video)
find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_package(GTest REQUIRED)

# OpenCV's own targets do not mark their headers as system headers.
foreach(component core imgproc imgcodecs videoio features2d calib3d video)
  set_target_properties(opencv_${component} PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIRS}")
endforeach()

# libpcl-dev's own config takes 5 s and links VTK and Qt (30 MB of every process); clustering needs no more than these.
find_path(PCL_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.13 REQUIRED)
add_library(cosight_pcl INTERFACE)
target_include_directories(cosight_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
foreach(component common kdtree search segmentation)
  find_library(PCL_${component}_LIBRARY pcl_${component} REQUIRED)
  target_link_libraries(cosight_pcl INTERFACE ${PCL_${component}_LIBRARY})
endforeach()
target_link_libraries(cosight_pcl INTERFACE Eigen3::Eigen)

# GeographicLib's own config sets a name of its own version for the target; one library needs no more than this.
find_path(GEOGRAPHICLIB_INCLUDE_DIR GeographicLib/MagneticModel.hpp REQUIRED)
find_library(GEOGRAPHICLIB_LIBRARY GeographicLib REQUIRED)
add_library(cosight_geographic INTERFACE)
target_include_directories(cosight_geographic SYSTEM INTERFACE ${GEOGRAPHICLIB_INCLUDE_DIR})
target_link_libraries(cosight_geographic INTERFACE ${GEOGRAPHICLIB_LIBRARY})
