// Names of status codes and of this version.
#include <argand/base.h>

const char *ag_status_name(ag_status status)
{
    switch (status) {
    case AG_OK: return "done";
    case AG_ERROR_ARGUMENT: return "bad argument";
    case AG_ERROR_MEMORY: return "out of memory";
    case AG_ERROR_FILE: return "file error";
    case AG_ERROR_FORMAT: return "format error";
    case AG_ERROR_UNSUPPORTED: return "unsupported";
    case AG_ERROR_DEVICE: return "device error";
    case AG_ERROR_CANCELLED: return "cancelled";
    }
    return "unknown status";
}

#define TEXT(x) #x
#define VERSION(a, b, c) TEXT(a) "." TEXT(b) "." TEXT(c)

const char *ag_version(void)
{
    return VERSION(AG_VERSION_MAJOR, AG_VERSION_MINOR, AG_VERSION_PATCH);
}
