/* The header alone, under every standard: nothing is included before it, and every macro works. */
#include <ptlib/ptlib.h>

#if PTL_VERSION_NUMBER != PTL_VERSION_MAJOR * 1000000 + PTL_VERSION_MINOR * 1000 + PTL_VERSION_PATCH
#error "PTL_VERSION_NUMBER is not made of its parts"
#endif
#if PTL_ABI_VERSION < 0 || PTL_OK != 0 || PTL_PENDING != 1
#error "numbers that never change have changed"
#endif

/* Compile-time assertions that C89 knows: arrays of a negative size are refused. */
#define ASSERT(name, condition) typedef char assert_##name[(condition) ? 1 : -1]
#define ASSERT_USED(name) (void)sizeof(assert_##name)

/* The layout of 64-bit platforms, which nobody may change. */
#if UINTPTR_MAX > 0xffffffffu
ASSERT(progress, sizeof(ptl_progress) == 40);
ASSERT(engine_options, sizeof(ptl_engine_options) == 96);
ASSERT(compute_options, sizeof(ptl_compute_options) == 120);
ASSERT(image_info, sizeof(ptl_image_info) == 48);
ASSERT(graph_info, sizeof(ptl_graph_info) == 32);
ASSERT(param_info, sizeof(ptl_param_info) == 152);
ASSERT(port_info, sizeof(ptl_port_info) == 32);
ASSERT(fault, sizeof(ptl_fault) == 40);
ASSERT(band, sizeof(ptl_band) == 40);
ASSERT(cancel_offset, offsetof(ptl_compute_options, cancel) == 88);
ASSERT(region_offset, offsetof(ptl_compute_options, region) == 40);
ASSERT(ids_offset, offsetof(ptl_param_info, enum_ids) == 128);
ASSERT(row_stride_offset, offsetof(ptl_image_info, row_stride) == 32);
#endif

/* What programs write most often. */
int uses_everything(void);
int uses_everything(void)
{
    ptl_engine_options engine;
    ptl_compute_options compute;
    ptl_engine *handle = NULL;
    ptl_error *error = NULL;
    ptl_status status;
    PTL_ENGINE_OPTIONS_INIT(&engine);
    PTL_COMPUTE_OPTIONS_INIT(&compute);
    compute.format = PTL_FORMAT_RGBA_F32;
    status = ptl_engine_create(&engine, &handle, &error);
    ptl_error_release(error);
    ptl_engine_release(handle);
    return status == PTL_OK;
}
