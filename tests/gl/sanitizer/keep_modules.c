// Linked into the programs of sanitizer builds: modules stay mapped, so that a leak inside a
// driver is reported under the driver's name, and tests/lsan.supp can tell it from ours.
// After a real dlclose its addresses have no name, or that of what was mapped there next.
#include <dlfcn.h>

int dlclose(void *handle)
{
    (void)handle;
    return 0;
}
