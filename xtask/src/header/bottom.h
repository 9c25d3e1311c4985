
/* Initialise a struct with the size that this program was built with. */
#define PTL_ENGINE_OPTIONS_INIT(p) ptl_engine_options_init((p), sizeof *(p))
#define PTL_COMPUTE_OPTIONS_INIT(p) ptl_compute_options_init((p), sizeof *(p))

#ifdef __cplusplus
}
#endif

#endif /* PTLIB_H */
