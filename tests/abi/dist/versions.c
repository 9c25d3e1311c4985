/* The installed header and the installed library are of one version. */
#include <ptlib/ptlib.h>

#include <stdio.h>
#include <string.h>

int main(void) {
  char version[32];
  sprintf(version, "%d.%d.%d", PTL_VERSION_MAJOR, PTL_VERSION_MINOR, PTL_VERSION_PATCH);
  if (strcmp(version, ptl_version_string()) != 0) {
    fprintf(stderr, "the header is %s, the library %s\n", version, ptl_version_string());
    return 1;
  }
  if (ptl_version_number() != PTL_VERSION_NUMBER || ptl_abi_version() != PTL_ABI_VERSION) {
    fprintf(stderr, "the numbers of header and library differ\n");
    return 1;
  }
  return 0;
}
