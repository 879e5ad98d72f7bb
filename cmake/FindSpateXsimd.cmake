# Finds xsimd by its header and defines spate::xsimd. Debian's own xsimdConfig.cmake asks to link a library "xtl" that
# xsimd does not need and that is not installed with it, so it is not used.
find_path(SpateXsimd_INCLUDE_DIR xsimd/xsimd.hpp)
mark_as_advanced(SpateXsimd_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SpateXsimd REQUIRED_VARS SpateXsimd_INCLUDE_DIR
    REASON_FAILURE_MESSAGE "xsimd/xsimd.hpp was not found (Debian package libxsimd-dev)")
if(SpateXsimd_FOUND AND NOT TARGET spate::xsimd)
    add_library(spate::xsimd INTERFACE IMPORTED)
    set_target_properties(spate::xsimd PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SpateXsimd_INCLUDE_DIR})
endif()
