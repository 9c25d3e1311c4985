/* The sizes that this compiler sees are those that the library was built with. */
#include "check.h"

int main(void)
{
    CHECK(ptl_abi_version() == PTL_ABI_VERSION);
    CHECK(ptl_version_number() == PTL_VERSION_NUMBER);
    CHECK(ptl_abi_sizeof(PTL_STRUCT_PROGRESS) == sizeof(ptl_progress));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_ENGINE_OPTIONS) == sizeof(ptl_engine_options));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_COMPUTE_OPTIONS) == sizeof(ptl_compute_options));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_IMAGE_INFO) == sizeof(ptl_image_info));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_GRAPH_INFO) == sizeof(ptl_graph_info));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_PARAM_INFO) == sizeof(ptl_param_info));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_PORT_INFO) == sizeof(ptl_port_info));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_FAULT) == sizeof(ptl_fault));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_STREAM) == sizeof(ptl_stream));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_MESH_DATA) == sizeof(ptl_mesh_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_POINTS_DATA) == sizeof(ptl_points_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_STRANDS_DATA) == sizeof(ptl_strands_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_GRADIENT_DATA) == sizeof(ptl_gradient_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_TEXT_DATA) == sizeof(ptl_text_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_IMAGE_DATA) == sizeof(ptl_image_data));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_SCAN_REPORT) == sizeof(ptl_scan_report));
    CHECK(ptl_abi_sizeof(PTL_STRUCT_BAND) == sizeof(ptl_band));
    CHECK(ptl_abi_sizeof(0) == 0 && ptl_abi_sizeof(18) == 0);
    return 0;
}
