/* Stands for a library of another version: the tests of loading want it refused. */
#include <stdint.h>

uint32_t ptl_abi_version(void);

uint32_t ptl_abi_version(void)
{
    return 999;
}
