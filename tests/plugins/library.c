/* A library that is no plug-in; perhaps one that misses a symbol. */
int nobody_has_this(void);

__attribute__((visibility("default"))) int answer(void)
{
#ifdef UNRESOLVED
    return nobody_has_this();
#else
    return 42;
#endif
}
